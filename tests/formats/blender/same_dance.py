"""Whether npz files hold one dance: how every joint is turned in the world, and where the pelvis is.

    same_dance.py DANCE.npz OTHER.npz...
"""

import sys

import numpy

PARENTS = [-1, 0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 9, 9, 12, 13, 14, 16, 17, 18, 19, 20, 21]  # SMPL's
MOST_DEGREES, MOST_METRES = 2, 0.01


def matrix(vector):
    angle = numpy.linalg.norm(vector)
    if angle == 0:
        return numpy.eye(3)
    x, y, z = vector / angle
    cross = numpy.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return numpy.eye(3) + numpy.sin(angle) * cross + (1 - numpy.cos(angle)) * cross @ cross


def turns(pose):
    """Of all joints in the world."""
    world = []
    for joint, parent in enumerate(PARENTS):
        world.append(matrix(pose[joint]) if parent < 0 else world[parent] @ matrix(pose[joint]))
    return world


dance = numpy.load(sys.argv[1])
for path in sys.argv[2:]:
    other = numpy.load(path)
    assert other["rotations"].shape == dance["rotations"].shape and other["fps"] == dance["fps"], path
    moved = numpy.linalg.norm(other["root_positions"] - dance["root_positions"], axis=1).max()
    angle = 0.0
    for here, there in zip(other["rotations"], dance["rotations"]):
        for a, b in zip(turns(here), turns(there)):
            angle = max(angle, numpy.degrees(numpy.arccos(numpy.clip((numpy.trace(a.T @ b) - 1) / 2, -1, 1))))
    assert angle < MOST_DEGREES and moved < MOST_METRES, f"{path}: {angle} degrees and {moved} m off"
    print(f"ok: {path}: joints within {angle:.2f} degrees, the pelvis within {1000 * moved:.1f} mm")
