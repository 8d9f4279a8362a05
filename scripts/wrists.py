#!/usr/bin/python3
"""Prints how wrists turn against the forearms in motions on SMPL's skeleton: by how many degrees, how far about each axis
(WristOptions in model/plan/plan_options.h), and for how long, in radians by which shoulder and elbow turn meanwhile.

  wrists.py MOTION.npz...        needs python3-numpy
"""

import sys

import numpy as np

ARMS = {"left": (16, 18, 20), "right": (17, 19, 21)}  # shoulder, elbow, wrist
AXES = ("twist", "deviation", "flexion")
WAYS = np.arange(0.5, 6, 0.5)  # radians
LAGS = (1, 2, 3, 5, 8, 12, 18, 25, 40, 60)  # frames
STILL = np.radians(2)  # wrists that were not recorded do not turn


def matrices(vectors):
    angle = np.linalg.norm(vectors, axis=-1, keepdims=True)
    x, y, z = np.moveaxis(vectors / np.maximum(angle, 1e-9), -1, 0)
    zero = np.zeros_like(x)
    cross = np.stack([zero, -z, y, z, zero, -x, -y, x, zero], -1).reshape(*x.shape, 3, 3)
    angle = angle[..., None]
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


def steps(vectors):
    """The angle from each frame to the next, radians."""
    turned = matrices(vectors)
    trace = np.einsum("tij,tij->t", turned[:-1], turned[1:])
    return np.arccos(np.clip((trace - 1) / 2, -1, 1))


def short(vectors):
    """The same rotations by at most half a turn."""
    angle = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return vectors * (1 - 2 * np.pi * np.round(angle / (2 * np.pi)) / np.maximum(angle, 1e-9))


turns, spreads, products = [], [], []
for path in sys.argv[1:]:
    poses = np.load(path)["poses"].astype(float)
    for shoulder, elbow, wrist in ARMS.values():
        turn, *arm = (poses[:, 3 * joint : 3 * joint + 3] for joint in (wrist, shoulder, elbow))
        turn = short(turn)
        deviation = turn - turn.mean(axis=0)
        spread = deviation.std(axis=0)
        if spread.max() < STILL:
            continue
        turns.append(np.linalg.norm(turn, axis=1))
        spreads.append(spread)
        way = np.concatenate([[0], np.cumsum(sum(steps(joint) for joint in arm))])
        for lag in (lag for lag in LAGS if lag < len(way)):
            product = (deviation[lag:] * deviation[:-lag] / spread**2)[:, 1:].mean(axis=1)
            products.append(np.stack([way[lag:] - way[:-lag], product], 1))
if not turns:
    sys.exit("no wrist turns")
turns = np.degrees(np.concatenate(turns))
print(f"median {np.median(turns):.0f} degrees, 95 % of frames at most {np.percentile(turns, 95):.0f}")
print("spread in a motion, radians:", ", ".join(f"{name} {s:.2f}" for name, s in zip(AXES, np.mean(spreads, axis=0))))
way, product = np.concatenate(products).T
correlation = np.array([product[abs(way - w) < 0.25].mean() for w in WAYS])
memories = np.arange(0.2, 6, 0.05)
fading = (1 + WAYS / memories[:, None]) * np.exp(-WAYS / memories[:, None])
share = (fading * correlation).sum(axis=1) / (fading**2).sum(axis=1)  # the rest trembles
error = ((share[:, None] * fading - correlation) ** 2).sum(axis=1)
best = error.argmin()
print(f"memory {memories[best]:.2f} radians of {share[best]:.2f} of the variance")
