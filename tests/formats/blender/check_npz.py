"""What Blender sees of our glTF and BVH is what our npz says: every joint in every tenth frame. Then Blender writes the same dance as its own
BVH and glTF.

    blender -b --factory-startup --python-exit-code 1 -P check_npz.py -- FOLDER

FOLDER has dance.npz, dance.glb and smpl-m.bvh of one dance, and gets blender.bvh and blender.glb.
"""

import pathlib
import sys

import bpy
import io_anim_bvh.import_bvh
import mathutils
import numpy

sys.path.append(str(pathlib.Path(__file__).resolve().parents[3] / "examples/blender/choreo"))
from rig import SMPL  # noqa: E402: a folder of Blender's add-ons, no package here

# Debian 12's Blender 3.4 is older than its NumPy and its Python: its importers use names that these have no more.
numpy.bool = bool
io_anim_bvh.import_bvh.open = lambda path, mode: open(path, mode.replace("U", ""))

FOLDER = pathlib.Path(sys.argv[sys.argv.index("--") + 1])
TO_BLENDER = mathutils.Matrix(((1, 0, 0), (0, 0, -1), (0, 1, 0)))  # from Y up


def turn(vector):
    return mathutils.Quaternion(vector, vector.length).to_matrix() if vector.length > 0 else mathutils.Matrix.Identity(3)


def places(dance, parents, offsets, frame):
    """Of the npz's joints, in Blender's axes."""
    at, turns = [], []
    for joint, parent in enumerate(parents):
        local = turn(mathutils.Vector(dance["rotations"][frame][joint]))
        if parent < 0:
            at.append(mathutils.Vector(dance["root_positions"][frame]))
            turns.append(local)
        else:
            at.append(at[parent] + turns[parent] @ offsets[joint])
            turns.append(turns[parent] @ local)
    return [TO_BLENDER @ place for place in at]


def main():
    dance = numpy.load(FOLDER / "dance.npz")
    scene = bpy.context.scene
    for name, read, first in (("smpl-m.bvh", bpy.ops.import_anim.bvh, 1), ("dance.glb", bpy.ops.import_scene.gltf, 0)):
        bpy.ops.object.select_all(action="SELECT")
        bpy.ops.object.delete()
        scene.render.fps = 30
        read(filepath=str(FOLDER / name))
        (armature,) = [thing for thing in scene.objects if thing.type == "ARMATURE"]
        bones = [armature.pose.bones[joint] for joint in SMPL]
        rest = [armature.matrix_world @ bone.bone.head_local for bone in bones]
        parents = [SMPL.index(bone.parent.name) if bone.parent and bone.parent.name in SMPL else -1 for bone in bones]
        offsets = [TO_BLENDER.transposed() @ (rest[i] - rest[parent]) if parent >= 0 else None for i, parent in enumerate(parents)]
        worst = 0.0
        for frame in range(0, len(dance["rotations"]), 10):
            scene.frame_set(frame + first)
            here = [armature.matrix_world @ bone.head for bone in bones]
            there = places(dance, parents, offsets, frame)
            worst = max([worst] + [(a - b).length for a, b in zip(here, there)])
        assert worst < 1e-3, f"{name}: a joint is {worst} m off what the npz says"
        print(f"ok: {name}: joints within {1000 * worst:.3f} mm of the npz's")
    scene.frame_start, scene.frame_end = 0, len(dance["rotations"]) - 1
    bpy.ops.export_scene.gltf(filepath=str(FOLDER / "blender.glb"), export_format="GLB")
    bpy.ops.object.select_all(action="DESELECT")
    bpy.context.view_layer.objects.active = armature
    armature.select_set(True)
    bpy.ops.export_anim.bvh(filepath=str(FOLDER / "blender.bvh"), frame_start=0, frame_end=scene.frame_end, root_transform_only=True)


main()
