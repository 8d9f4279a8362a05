"""Characters that dance, in Blender: their limbs, hips and shoulders point where those of the dance itself do.

    blender -b --factory-startup --python-exit-code 1 -P check_characters.py -- FOLDER

FOLDER has dance.glb, the dance by SMPL's names, and the same dance by mixamo, child, long, basic and human, as in mixamo-dances.glb.
"""

import math
import pathlib
import sys

import bpy
import numpy

sys.path.append(str(pathlib.Path(__file__).resolve().parents[3] / "examples/blender/choreo"))
from rig import HUMANIK, SMPL, UNREAL  # noqa: E402: a folder of Blender's add-ons, no package here

numpy.bool = bool  # Debian 12's Blender 3.4 is older than its NumPy
FOLDER = pathlib.Path(sys.argv[sys.argv.index("--") + 1])
RIGIFY = (
    "spine thigh.L thigh.R spine.001 shin.L shin.R spine.002 foot.L foot.R spine.003 toe.L toe.R spine.004 "
    "shoulder.L shoulder.R spine.006 upper_arm.L upper_arm.R forearm.L forearm.R hand.L hand.R"
).split()
# Whose names, and by how many degrees a limb may point elsewhere: feet stand where they belong, whatever the width of the hips.
CHARACTERS = {
    "mixamo": (["mixamorig:" + name for name in HUMANIK], 3),
    "child": (UNREAL, 10),
    "long": (["DEF-" + name for name in RIGIFY], 10),
    "basic": (RIGIFY, 15),
    "human": (RIGIFY, 15),
}
BONES = [("hip", "knee"), ("knee", "ankle"), ("shoulder", "elbow"), ("elbow", "wrist")]
FRAMES = range(0, 60, 6)


def places(path, names):
    """Of SMPL's joints, by what the file calls them, in the world, in each of FRAMES."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.context.scene.render.fps = 30
    bpy.ops.import_scene.gltf(filepath=str(path))
    bones = {bone.name: (thing, bone) for thing in bpy.data.objects if thing.type == "ARMATURE" for bone in thing.pose.bones}
    out = []
    for frame in FRAMES:
        bpy.context.scene.frame_set(frame)
        there = {}
        for joint, name in zip(SMPL, names):
            if name in bones:
                thing, bone = bones[name]
                there[joint] = thing.matrix_world @ bone.head
            elif name in bpy.data.objects:  # a rig without a skin is no armature
                there[joint] = bpy.data.objects[name].matrix_world.translation.copy()
        out.append(there)
    return out


def ways(there):
    sides = [(f"{side}_{a}", f"{side}_{b}") for side in ("left", "right") for a, b in BONES]
    return {b: there[b] - there[a] for a, b in [*sides, ("right_hip", "left_hip"), ("right_shoulder", "left_shoulder")]}


def main():
    dance = [ways(there) for there in places(FOLDER / "dance.glb", SMPL)]
    for name, (names, most) in CHARACTERS.items():
        worst = ("", 0.0)
        lowest = []
        for there, wanted in zip(places(FOLDER / f"{name}-dances.glb", names), dance, strict=True):
            lowest.append(min(there["left_foot"].z, there["right_foot"].z) if "left_foot" in there else 0)
            for bone, way in ways(there).items():
                off = math.degrees(way.angle(wanted[bone]))
                worst = max(worst, (bone, off), key=lambda one: one[1])
        assert worst[1] < most, f"{name}: {worst[0]} points {worst[1]:.1f} degrees elsewhere"
        assert min(lowest) > -0.05, f"{name}: toes are {min(lowest)} m high"
        print(f"ok: {name}: {worst[0]} points {worst[1]:.1f} degrees elsewhere at most")


main()
