"""The add-on of examples/blender in a Blender that nobody sees, against the studio that $CHOREO_STUDIO names.

    blender -b --factory-startup --python-exit-code 1 -P addon_test.py -- ADDON.zip SONG.wav
"""

import math
import os
import sys

import bpy
from mathutils import Euler, Matrix, Quaternion, Vector

ADDON, SONG = sys.argv[sys.argv.index("--") + 1 :]
STUDIO = os.environ["CHOREO_STUDIO"]
LIMBS = [(side + a, side + b) for side in ("left_", "right_") for a, b in (("hip", "knee"), ("knee", "ankle"), ("shoulder", "elbow"), ("elbow", "wrist"))]
passed = 0


def check(what, holds, said=""):
    global passed
    assert holds, f"{what}: {said}"
    passed += 1
    print(f"ok: {what} {said}")


def refused(act):
    """What an operator says that cannot do it."""
    try:
        act()
    except RuntimeError as error:
        return str(error)
    return "nothing was refused"


def turns(thing):
    bpy.context.view_layer.update()
    return {bone.name: bone.matrix.to_quaternion() for bone in thing.pose.bones}


def degrees_between(a, b):
    return max(math.degrees((a[name].inverted() @ b[name]).angle) % 360 for name in a)


def turn(thing, bone, degrees):
    posed = thing.pose.bones[bone]
    posed.rotation_mode = "QUATERNION"
    posed.rotation_quaternion = Euler([math.radians(angle) for angle in degrees]).to_quaternion()


def stranger(dancer, names):
    """The same body as others make it: their names, in centimetres, Y up, turned by 30 degrees, arms lowered, any roll."""
    data = bpy.data.armatures.new("Stranger")
    thing = bpy.data.objects.new("Stranger", data)
    bpy.context.collection.objects.link(thing)
    bpy.context.view_layer.objects.active = thing
    thing.matrix_world = Matrix.Translation((2, 1, 0)) @ Matrix.Rotation(math.radians(30), 4, "Z") @ Matrix.Rotation(math.radians(90), 4, "X") @ Matrix.Scale(0.01, 4)
    inside = Matrix.Scale(100, 4) @ Matrix.Rotation(math.radians(-90), 4, "X")
    bpy.ops.object.mode_set(mode="EDIT")
    lowered = {}
    for i, bone in enumerate(dancer.data.bones):
        turned = lowered.get(bone.parent.name if bone.parent else "", Matrix.Identity(3))
        if bone.name.endswith("_shoulder"):
            turned = Matrix.Rotation(math.radians(40 if bone.name.startswith("left") else -40), 3, "Y")
        lowered[bone.name] = turned
        made = data.edit_bones.new(names[bone.name])
        along = bone.tail_local - bone.head_local
        made.head = inside @ bone.head_local
        if bone.parent:
            made.parent = data.edit_bones[names[bone.parent.name]]
            above = lowered.get(bone.parent.name)
            start = Vector(starts[bone.parent.name]) + above @ (bone.head_local - bone.parent.head_local)
        else:
            start = bone.head_local
        starts[bone.name] = start
        made.head, made.tail = inside @ start, inside @ (start + turned @ along)
        made.roll = 0.7 * i
    bpy.ops.object.mode_set(mode="POSE")
    return thing


starts = {}


def direction(thing, a, b):
    bones = thing.pose.bones
    return (thing.matrix_world @ bones[b].head - thing.matrix_world @ bones[a].head).normalized()


def main():
    bpy.ops.preferences.addon_install(filepath=ADDON)
    bpy.ops.preferences.addon_enable(module="choreo")
    import choreo.rig

    scene = bpy.context.scene
    scene.render.fps, scene.frame_start = 30, 11
    settings = scene.choreo
    settings.address = "http://127.0.0.1:1"
    check("a studio that is not there is named", "No studio answers at http://127.0.0.1:1" in refused(bpy.ops.choreo.add_dancer))
    settings.address = STUDIO
    bpy.ops.choreo.add_dancer()
    dancer = bpy.context.object
    lowest = min(bone.head_local.z for bone in dancer.data.bones)
    check("a dancer stands on the floor", len(dancer.data.bones) == 24 and 0 <= lowest < 0.04, f"{lowest:.3f} m")

    check("without keys it says so", "Mark a key first" in refused(bpy.ops.choreo.dance))
    poses = {}
    for frame, arm, step in ((41, 60, 0.0), (101, -50, 0.4)):
        scene.frame_set(frame)
        turn(dancer, "left_shoulder", (10, arm, 20))
        turn(dancer, "right_elbow", (0, -arm, 5))
        turn(dancer, "pelvis", (0, 0, arm / 3))
        dancer.pose.bones["pelvis"].location = (step, 0, 0)
        bpy.ops.choreo.mark_key()
        poses[frame] = turns(dancer), dancer.pose.bones["pelvis"].head.copy()
    check("keys are marked", [key.frame for key in dancer.choreo_keys] == [41, 101])
    bpy.ops.choreo.mark_key()
    check("a frame has one key", len(dancer.choreo_keys) == 2)

    settings.song = SONG
    bpy.ops.choreo.dance()
    action = dancer.animation_data.action
    check("the dance is an action as long as the song", tuple(action.frame_range) == (11, 190), f"{tuple(action.frame_range)}")
    for frame, (asked, place) in poses.items():
        scene.frame_set(frame)
        off = degrees_between(asked, turns(dancer))
        away = (dancer.pose.bones["pelvis"].head - place).length
        check(f"the key of frame {frame} is hit", off < 1 and away < 0.01, f"{off:.2f} degrees, {1000 * away:.1f} mm")
    scene.frame_set(71)
    between = turns(dancer)
    check("between them it dances", min(degrees_between(between, asked) for asked, _ in poses.values()) > 1)

    settings.style = "wild"
    bpy.ops.choreo.dance()
    scene.frame_set(71)
    check("another style, another dance", degrees_between(between, turns(dancer)) > 0.1 and dancer.animation_data.action != action)
    check("the action before it is kept", action.use_fake_user)
    settings.style = "foxtrot"
    check("a style that is none is named", "foxtrot" in refused(bpy.ops.choreo.dance))
    settings.style = ""
    settings.song = SONG + ".none"
    check("a song that is not there is named", "is not a file" in refused(bpy.ops.choreo.dance))
    settings.song = ""

    # Silent, at another rate: the keys stay where they are marked.
    scene.render.fps = 60
    settings.seconds = 3
    bpy.ops.choreo.dance()
    check("a silent dance at 60 frames a second", abs(dancer.animation_data.action.frame_range[1] - 11 - 178) < 1e-3, f"{tuple(dancer.animation_data.action.frame_range)}")
    scene.frame_set(41)
    off = degrees_between(poses[41][0], turns(dancer))
    check("hits its keys, too", off < 1, f"{off:.2f} degrees")
    scene.frame_start = 60
    check("a key before the scene is named", "The key at frame 41 lies before" in refused(bpy.ops.choreo.dance))
    scene.frame_start, scene.render.fps = 11, 30
    scene.frame_set(41)
    bpy.ops.choreo.remove_keys()
    check("a key is removed", [key.frame for key in dancer.choreo_keys] == [101])

    # A dance on armatures of others.
    model = choreo.studio.ask(STUDIO, "/model")
    keys = [{"id": "a", "time": 1, "pose": "kick", "place": [0, 0], "facing": 0}]
    dance = choreo.studio.ask(STUDIO, "/dance", {"studio": 1, "seconds": 2, "keyframes": keys})
    choreo.rig.make_action(choreo.rig.Rig(dancer, model), dance, scene, "ours")
    for table in (choreo.rig.HUMANIK, choreo.rig.UNREAL, ["mixamorig:" + name for name in choreo.rig.HUMANIK]):
        names = dict(zip(choreo.rig.SMPL, table))
        other = stranger(dancer, names)
        rig = choreo.rig.Rig(other, model)
        choreo.rig.make_action(rig, dance, scene, "theirs")
        worst = back = 0.0
        turned = Quaternion((0, 0, 1), math.radians(30))
        for i in range(0, 60, 7):
            scene.frame_set(11 + i)
            for a, b in LIMBS:
                worst = max(worst, math.degrees((turned @ direction(dancer, a, b)).angle(direction(other, names[a], names[b]))))
            _, rotations = rig.read()
            for here, there in zip(rotations, dance["rotations"][i]):
                here, there = (Quaternion(Vector(v), Vector(v).length) for v in (here, there))
                apart = math.degrees((here.inverted() @ there).angle)
                back = max(back, min(apart, 360 - apart))
        check(f"limbs point the same way with bones as {table[1]}", worst < 0.1, f"{worst:.3f} degrees")
        check("and the pose that is read is the one that was danced", back < 0.1, f"{back:.3f} degrees")
        bpy.data.objects.remove(other)
    empty = bpy.data.objects.new("Snake", bpy.data.armatures.new("Snake"))
    bpy.context.collection.objects.link(empty)
    bpy.context.view_layer.objects.active = empty
    check("bones of other names are named", "Snake has no bone for pelvis" in refused(bpy.ops.choreo.mark_key))
    bpy.ops.preferences.addon_disable(module="choreo")
    print(f"{passed} passed, 0 failed")


main()
