from . import choreography


def pose(skeleton, rotations=None, x=0.0, z=0.0):
    """The body of `skeleton` at rest, but for `rotations`: {joint name: [x, y, z] in radians}."""
    rotations = rotations or {}
    return choreography.Pose(
        root_position=choreography.Vector3(x=x, y=skeleton.pelvis_height, z=z),
        rotations=[number for joint in skeleton.joint_names for number in rotations.get(joint, [0, 0, 0])],
    )
