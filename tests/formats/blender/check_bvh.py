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

sys.path.append(str(pathlib.Path(__file__).resolve().parents[3] / "examples/blender/choreo"))
from rig import HUMANIK, SMPL, UNREAL  # noqa: E402: a folder of Blender's add-ons, no package here

# Debian 12's Blender 3.4 is older than its NumPy and its Python: its importers use names that these have no more.
numpy.bool = bool
io_anim_bvh.import_bvh.open = lambda path, mode: open(path, mode.replace("U", ""))

FOLDER = pathlib.Path(sys.argv[sys.argv.index("--") + 1])
NAMES = {"smpl": SMPL, "mixamo": ["mixamorig:" + name for name in HUMANIK], "humanik": HUMANIK, "ue": UNREAL}
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
            there = places(reference, SMPL, frame)
            here = places(armature, NAMES[names], frame + 1)
            worst = max([worst] + [(a - b).length for a, b in zip(here, there)])
        assert worst < 1e-3, f"{path}: a joint is {worst} m off"
        print(f"ok: {path.name}: hips at {rest[0]:.3f} m, joints within {1000 * worst:.3f} mm")
        bpy.data.objects.remove(armature)


main()
