"""Choreo for Blender 3.4 and later: pose an armature, mark keys, choose a song, and the dance appears as an action.

The panel is in the 3D view's sidebar (N), under Choreo. It speaks to `choreo studio`, which has to run on this machine.
"""

import json
import os

import bpy
from bpy.props import CollectionProperty, FloatProperty, IntProperty, PointerProperty, StringProperty

from .rig import Rig, add_dancer, make_action
from .studio import ask, song

bl_info = {
    "name": "Choreo",
    "description": "Dances between key poses, to a song",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "View3D > Sidebar > Choreo",
    "category": "Animation",
}


class ChoreoKey(bpy.types.PropertyGroup):
    frame: IntProperty()
    pose: StringProperty()  # JSON: root position and rotations


class ChoreoSettings(bpy.types.PropertyGroup):
    address: StringProperty(name="Studio", default="http://127.0.0.1:8765", description="Where `choreo studio` says that it is open")
    song: StringProperty(name="Song", subtype="FILE_PATH", description="WAV, FLAC, Ogg or MP3. Without one the dance is silent")
    style: StringProperty(name="Style", description="A style of the model's, as happy or tired. Empty: none in particular")
    seed: IntProperty(name="Seed", min=0, default=1, description="Another seed, another dance")
    seconds: FloatProperty(name="Seconds", min=0, max=3600, description="Length of the dance. 0: the song's, or up to a second after the last key")


class Operator(bpy.types.Operator):
    """One that tells in words what went wrong."""

    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context):
        try:
            self.act(context, context.scene.choreo)
        except RuntimeError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}


class OnArmature(Operator):
    @classmethod
    def poll(cls, context):
        return context.object is not None and context.object.type == "ARMATURE"


class AddDancer(Operator):
    bl_idname = "choreo.add_dancer"
    bl_label = "Add a dancer"
    bl_description = "An armature with the joints that Choreo dances with"

    def act(self, context, settings):
        add_dancer(ask(settings.address, "/model"))


class MarkKey(OnArmature):
    bl_idname = "choreo.mark_key"
    bl_label = "Mark a key"
    bl_description = "The dance is to hit the pose of now at the current frame"

    def act(self, context, settings):
        scene, thing = context.scene, context.object
        rig = Rig(thing, ask(settings.address, "/model"))
        context.view_layer.update()
        at = [key.frame for key in thing.choreo_keys]
        key = thing.choreo_keys[at.index(scene.frame_current)] if scene.frame_current in at else thing.choreo_keys.add()
        key.frame = scene.frame_current
        key.name = f"key {scene.frame_current}"
        key.pose = json.dumps(rig.read())


class RemoveKeys(OnArmature):
    bl_idname = "choreo.remove_keys"
    bl_label = "Remove the key of this frame"
    bl_description = "The one that is marked at the current frame"

    def act(self, context, settings):
        keys = context.object.choreo_keys
        for index in reversed([i for i, key in enumerate(keys) if key.frame == context.scene.frame_current]):
            keys.remove(index)


class Dance(OnArmature):
    bl_idname = "choreo.dance"
    bl_label = "Dance"
    bl_description = "Dance through the keys, as a new action. Blender waits meanwhile"

    def act(self, context, settings):
        scene, thing = context.scene, context.object
        rate = scene.render.fps / scene.render.fps_base
        keys = sorted(thing.choreo_keys, key=lambda key: key.frame)
        if not keys:
            raise RuntimeError("Mark a key first: pose the armature and press Mark a key")
        if keys[0].frame < scene.frame_start:
            raise RuntimeError(f"The key at frame {keys[0].frame} lies before the scene's first frame, {scene.frame_start}, where the dance begins")
        keyframes = []
        for key in keys:
            root, rotations = json.loads(key.pose)
            keyframes.append({"id": key.name, "time": (key.frame - scene.frame_start) / rate, "root_position": root, "rotations": rotations})
        project = {"studio": 1, "seed": settings.seed, "style": settings.style, "keyframes": keyframes}
        path = bpy.path.abspath(settings.song)
        if path:
            project.update(song(path))
        if settings.seconds > 0 or not path:
            project["seconds"] = settings.seconds or keyframes[-1]["time"] + 1
        rig = Rig(thing, ask(settings.address, "/model"))
        dance = ask(settings.address, "/dance", project)
        make_action(rig, dance, scene, "Dance to " + os.path.basename(path) if path else "Dance")
        for warning in dance["warnings"]:
            self.report({"WARNING"}, f"{warning['frame'] / dance['frame_rate']:.1f} s: {warning['message']}")
        self.report({"INFO"}, f"{len(dance['rotations']) / dance['frame_rate']:.1f} s of dance")


class Panel(bpy.types.Panel):
    bl_idname = "VIEW3D_PT_choreo"
    bl_label = "Choreo"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Choreo"

    def draw(self, context):
        layout, settings = self.layout, context.scene.choreo
        layout.operator(AddDancer.bl_idname, icon="ARMATURE_DATA")
        column = layout.column(align=True)
        column.operator(MarkKey.bl_idname, icon="KEYFRAME_HLT")
        column.operator(RemoveKeys.bl_idname, icon="KEYFRAME")
        if OnArmature.poll(context) and context.object.choreo_keys:
            layout.label(text="Keys: " + ", ".join(str(frame) for frame in sorted(key.frame for key in context.object.choreo_keys)))
        for name in ("song", "style", "seed", "seconds", "address"):
            layout.prop(settings, name)
        layout.operator(Dance.bl_idname, icon="PLAY")


CLASSES = (ChoreoKey, ChoreoSettings, AddDancer, MarkKey, RemoveKeys, Dance, Panel)


def register():
    for one in CLASSES:
        bpy.utils.register_class(one)
    bpy.types.Object.choreo_keys = CollectionProperty(type=ChoreoKey)
    bpy.types.Scene.choreo = PointerProperty(type=ChoreoSettings)


def unregister():
    del bpy.types.Scene.choreo
    del bpy.types.Object.choreo_keys
    for one in reversed(CLASSES):
        bpy.utils.unregister_class(one)
