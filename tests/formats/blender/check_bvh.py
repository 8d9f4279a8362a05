"""Our BVH files in Blender: names, the hips' height at rest, the floor, the rate, and where every joint is in every tenth frame, which
Blender's own reader of the same dance as glTF confirms.

    blender -b --factory-startup --python-exit-code 1 -P check_bvh.py -- FOLDER

FOLDER has dance.glb and NAMES-UNIT.bvh, as in mixamo-m.bvh.
"""

import pathlib
import sys

import bpy
import io_anim_bvh.import_bvh
import numpy

# Debian 12's Blender 3.4 is older than its NumPy and its Python: its importers use names that these have no more.
numpy.bool = bool
io_anim_bvh.import_bvh.open = lambda path, mode: open(path, mode.replace("U", ""))

FOLDER = pathlib.Path(sys.argv[sys.argv.index("--") + 1])
JOINTS = (
    "pelvis left_hip right_hip spine1 left_knee right_knee spine2 left_ankle right_ankle spine3 left_foot right_foot neck "
    "left_collar right_collar head left_shoulder right_shoulder left_elbow right_elbow left_wrist right_wrist left_hand right_hand"
).split()
HUMANIK = (
    "Hips LeftUpLeg RightUpLeg Spine LeftLeg RightLeg Spine1 LeftFoot RightFoot Spine2 LeftToeBase RightToeBase Neck "
    "LeftShoulder RightShoulder Head LeftArm RightArm LeftForeArm RightForeArm LeftHand RightHand LeftHandMiddle1 RightHandMiddle1"
).split()
UNREAL = (
    "pelvis thigh_l thigh_r spine_01 calf_l calf_r spine_02 foot_l foot_r spine_03 ball_l ball_r neck_01 "
    "clavicle_l clavicle_r head upperarm_l upperarm_r lowerarm_l lowerarm_r hand_l hand_r middle_01_l middle_01_r"
).split()
NAMES = {"smpl": JOINTS, "mixamo": ["mixamorig:" + name for name in HUMANIK], "humanik": HUMANIK, "ue": UNREAL}
METRES = {"m": 1.0, "cm": 0.01}
HIP_HEIGHT = 0.976  # metres, of the body as it stands at rest


def imported(operator, path, **options):
    """The armature that an importer makes."""
    bpy.ops.object.select_all(action="DESELECT")
    before = set(bpy.data.objects)
    operator(filepath=str(path), **options)
    (armature,) = [thing for thing in bpy.data.objects if thing not in before and thing.type == "ARMATURE"]
    return armature


def places(armature, names, frame):
    """Of the joints in the world, metres."""
    bpy.context.scene.frame_set(frame)
    return [armature.matrix_world @ armature.pose.bones[name].head for name in names]


def main():
    scene = bpy.context.scene
    scene.render.fps = 30
    reference = imported(bpy.ops.import_scene.gltf, FOLDER / "dance.glb")
    files = sorted(FOLDER.glob("*-*.bvh"))
    assert len(files) == len(NAMES) * len(METRES), files
    for path in files:
        names, unit = path.stem.split("-")
        scene.render.fps = 24
        armature = imported(bpy.ops.import_anim.bvh, path, global_scale=METRES[unit], update_scene_fps=True)
        assert sorted(bone.name for bone in armature.data.bones) == sorted(NAMES[names]), path
        assert scene.render.fps == 30, f"{path}: {scene.render.fps} frames a second"
        frames = round(armature.animation_data.action.frame_range[1])
        assert frames == 60, f"{path}: {frames} frames"
        rest = [(armature.matrix_world @ bone.head_local).z for bone in (armature.data.bones[name] for name in NAMES[names])]
        assert abs(rest[0] - HIP_HEIGHT) < 0.002, f"{path}: at rest the hips are {rest[0]} m high"
        assert 0 <= min(rest) < 0.04, f"{path}: at rest the lowest joint is {min(rest)} m high"
        worst = 0.0
        for frame in range(0, frames, 10):
            there = places(reference, JOINTS, frame)
            here = places(armature, NAMES[names], frame + 1)
            worst = max([worst] + [(a - b).length for a, b in zip(here, there)])
        assert worst < 1e-3, f"{path}: a joint is {worst} m off"
        print(f"ok: {path.name}: hips at {rest[0]:.3f} m, joints within {1000 * worst:.3f} mm")
        bpy.data.objects.remove(armature)


main()
