"""Rigify's metarigs as glTF: characters that are not of our making.

    blender -b --factory-startup --python-exit-code 1 -P metarigs.py -- FOLDER
"""

import pathlib
import sys

import addon_utils
import bpy
import numpy

numpy.bool = bool  # Debian 12's Blender 3.4 is older than its NumPy
addon_utils.enable("rigify", default_set=True)
FOLDER = pathlib.Path(sys.argv[sys.argv.index("--") + 1])

for name, add in {"basic": bpy.ops.object.armature_basic_human_metarig_add, "human": bpy.ops.object.armature_human_metarig_add}.items():
    bpy.ops.object.select_all(action="SELECT")
    bpy.ops.object.delete()
    add()
    bpy.ops.export_scene.gltf(filepath=str(FOLDER / f"{name}.glb"), export_format="GLB")
