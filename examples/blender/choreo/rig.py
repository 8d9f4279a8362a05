"""Armatures as SMPL's body: poses are read from them, dances are put onto them."""

import bpy
from mathutils import Matrix, Quaternion, Vector

SMPL = (
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
NEEDED = [joint for joint in SMPL if joint.split("_")[-1] in ("pelvis", "hip", "knee", "ankle", "shoulder", "elbow", "wrist")]
# Limbs may rest otherwise than SMPL's: these follow the direction to the next joint.
LIMBS = {"hip": "knee", "knee": "ankle", "shoulder": "elbow", "elbow": "wrist"}


class Rig:
    """An armature as SMPL's body. Choreo's world (Y up, left is +X) is turned to where the armature faces, stands where its origin is, and
    is as large as its legs are long."""

    def __init__(self, thing, model):
        self.thing = thing
        self.joints = model["joints"]
        self.parents = model["parents"]
        bones = thing.data.bones
        tables = ({a: a for a in SMPL}, dict(zip(SMPL, ("mixamorig:" + name for name in HUMANIK))), dict(zip(SMPL, HUMANIK)), dict(zip(SMPL, UNREAL)))
        fits = [{joint: name for joint, name in table.items() if name in bones} for table in tables]
        self.bones = max(fits, key=len)
        missing = [joint for joint in NEEDED if joint not in self.bones]
        if missing:
            raise RuntimeError(f"{thing.name} has no bone for {', '.join(missing)}: bones must have SMPL's, Mixamo's, HumanIK's or Unreal's names")
        self.turned = thing.matrix_world.to_3x3().normalized()
        self.origin = thing.matrix_world.translation.copy()
        rest = {joint: thing.matrix_world @ bones[name].head_local for joint, name in self.bones.items()}
        left = rest["left_hip"] - rest["right_hip"]
        left.z = 0
        left.normalize()
        up = Vector((0, 0, 1))
        self.axes = Matrix((left, up, left.cross(up))).transposed()  # from Choreo's world to this one
        self.scale = (rest["pelvis"].z - self.origin.z) / model["pelvis_height"]
        if not (left.length > 0.5 and self.scale > 1e-4):
            raise RuntimeError(f"{thing.name} does not stand upright at rest")
        self.rest = {joint: self.turned @ bones[name].matrix_local.to_3x3() for joint, name in self.bones.items()}
        self.offset = {joint: self._offset(joint, rest, model) for joint in self.bones}

    def _offset(self, joint, rest, model):
        """Turns a limb as it rests here to how SMPL's rests."""
        side, _, part = joint.partition("_")
        if part == "wrist":
            return self._offset(side + "_elbow", rest, model)
        if part not in LIMBS:
            return Matrix.Identity(3)
        end = f"{side}_{LIMBS[part]}"
        theirs = self.axes @ Vector(model["offsets"][self.joints.index(end)])
        return (rest[end] - rest[joint]).rotation_difference(theirs).to_matrix()

    def _above(self, joint):
        """The next joint above that has a bone here; none above the pelvis."""
        parent = self.parents[self.joints.index(joint)]
        while parent >= 0 and self.joints[parent] not in self.bones:
            parent = self.parents[parent]
        return self.joints[parent] if parent >= 0 else None

    def read(self):
        """The pose as it is now: root position, and an axis-angle vector a joint."""
        posed = self.thing.pose.bones
        here = {}
        for joint, name in self.bones.items():
            world = self.turned @ posed[name].matrix.to_3x3().normalized() @ self.rest[joint].transposed()
            here[joint] = world @ self.offset[joint].transposed()
        rotations = []
        for joint in self.joints:
            turn = Matrix.Identity(3)
            if joint in here:
                above = self._above(joint)
                turn = (here[above].transposed() if above else Matrix.Identity(3)) @ here[joint]
            axis, angle = (self.axes.transposed() @ turn @ self.axes).to_quaternion().to_axis_angle()
            rotations.append([round(value * angle, 6) for value in axis])
        place = self.thing.matrix_world @ posed[self.bones["pelvis"]].head - self.origin
        return [round(value, 6) for value in self.axes.transposed() @ place / self.scale], rotations

    def locals(self, rotations):
        """Of one frame's rotations: each bone's own, a quaternion."""
        world = []
        for joint, parent, vector in zip(self.joints, self.parents, rotations):
            vector = Vector(vector)
            turn = self.axes @ Quaternion(vector, vector.length).to_matrix() @ self.axes.transposed()
            world.append(turn if parent < 0 else world[parent] @ turn)
        here = {joint: turn @ self.offset[joint] for joint, turn in zip(self.joints, world) if joint in self.bones}
        for joint in here:
            above = self._above(joint)
            turn = (here[above].transposed() if above else Matrix.Identity(3)) @ here[joint]
            yield joint, (self.rest[joint].transposed() @ turn @ self.rest[joint]).to_quaternion()

    def location(self, root):
        """The pelvis bone's own location for a root position."""
        bone = self.thing.data.bones[self.bones["pelvis"]]
        place = self.axes @ Vector(root) * self.scale + self.origin
        return bone.matrix_local.to_3x3().transposed() @ (self.thing.matrix_world.inverted() @ place - bone.head_local)


def add_dancer(model):
    """An armature with SMPL's joints, in the rest pose."""
    data = bpy.data.armatures.new("Dancer")
    thing = bpy.data.objects.new("Dancer", data)
    bpy.context.collection.objects.link(thing)
    bpy.context.view_layer.objects.active = thing
    bpy.ops.object.mode_set(mode="EDIT")
    heads = []
    for joint, parent, (x, y, z) in zip(model["joints"], model["parents"], model["offsets"]):
        heads.append(Vector((0, 0, model["pelvis_height"])) if parent < 0 else heads[parent] + Vector((x, -z, y)))
        bone = data.edit_bones.new(joint)
        bone.head = heads[-1]
        children = [i for i, above in enumerate(model["parents"]) if model["joints"][above] == joint and above >= 0]
        middle = [i for i in children if "_" not in model["joints"][i]] or children
        if middle:
            x, y, z = model["offsets"][middle[0]]
            bone.tail = heads[-1] + Vector((x, -z, y))
        else:
            bone.tail = heads[-1] + (heads[-1] - heads[parent]) / 2
        if parent >= 0:
            bone.parent = data.edit_bones[model["joints"][parent]]
    bpy.ops.object.mode_set(mode="POSE")
    return thing


def make_action(rig, dance, scene, name):
    """The dance as an action of the armature, which keeps the one that it had."""
    step = scene.render.fps / scene.render.fps_base / dance["frame_rate"]
    times = [scene.frame_start + i * step for i in range(len(dance["rotations"]))]
    curves = {}

    def add(bone, channel, values):
        for index, value in enumerate(values):
            curves.setdefault((f'pose.bones["{bone}"].{channel}', index, bone), []).append(value)

    last = {}
    for root, rotations in zip(dance["root_positions"], dance["rotations"]):
        add(rig.bones["pelvis"], "location", rig.location(root))
        for joint, turn in rig.locals(rotations):
            if joint in last:
                turn.make_compatible(last[joint])
            last[joint] = turn
            add(rig.bones[joint], "rotation_quaternion", turn)
    thing = rig.thing
    thing.animation_data_create()
    if thing.animation_data.action:
        thing.animation_data.action.use_fake_user = True
    action = bpy.data.actions.new(name)
    for (path, index, bone), values in curves.items():
        curve = action.fcurves.new(path, index=index, action_group=bone)
        curve.keyframe_points.add(len(values))
        curve.keyframe_points.foreach_set("co", [number for pair in zip(times, values) for number in pair])
        curve.keyframe_points.foreach_set("interpolation", [1] * len(values))  # linear
        curve.update()
    for bone in rig.bones.values():
        thing.pose.bones[bone].rotation_mode = "QUATERNION"
    thing.animation_data.action = action
    scene.frame_end = max(scene.frame_end, round(times[-1]))
    return action
