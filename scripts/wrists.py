#!/usr/bin/python3
"""Prints by how many degrees wrists are turned against the forearms in motions on SMPL's skeleton.

  wrists.py MOTION.npz...        needs python3-numpy
"""

import sys

import numpy as np

WRISTS = {"left": 20, "right": 21}  # joints

for path in sys.argv[1:]:
    poses = np.load(path)["poses"]
    for side, joint in WRISTS.items():
        turn = np.degrees(np.linalg.norm(poses[:, 3 * joint : 3 * joint + 3], axis=1))
        turn = np.minimum(turn, 360 - turn)
        print(f"{path} {side}: median {np.median(turn):.1f}, 95 % of frames at most {np.percentile(turn, 95):.1f}")
