"""The cost of late keys: the third table of live.py.

A minute of each held-out dance, and its own poses each 2 s as keys: where the dancer stood, or, as `choreo live` has them, wherever ours is then.
Each comes so long before its frame as the table says ("all": before the dance); what is nearer is danced already. Until a key comes the dance
goes on without one, and what is left is the way to it. L2P is the mean distance of the joints to what was really danced, both on one place where
keys are on none; "speed" is the median over frames of the joints' mean speed, "rush" its 99th percentile, both over the real dancer's. Medians
over the dances; "gone" are those whose rush is five times the real dancer's.
"""
import json

import numpy

from choreo_client import choreography

FPS = 30
HISTORY = 10  # frames that are given
KEY_EACH = 60  # frames
GRANT_EACH = 3  # frames
LONGEST = 1800  # frames of a clip


def read_clip(path):
    """Root positions [frames, 3] and rotations [frames, joints, 3] of a clip that choreo-lab prepared."""
    data = path.read_bytes()
    head = 8 + int.from_bytes(data[:8], "little")
    fields = json.loads(data[8:head])

    def read(name):
        begin, end = fields[name]["data_offsets"]
        return numpy.frombuffer(data[head + begin : head + end], "<f4").reshape(fields[name]["shape"])[:LONGEST]

    return read("root_positions"), within_pi(read("rotations"))


def within_pi(rotations):
    """The same rotations by the shorter way; recordings wind up."""
    angle = numpy.maximum(numpy.linalg.norm(rotations, axis=-1, keepdims=True), 1e-9)
    return rotations / angle * ((angle + numpy.pi) % (2 * numpy.pi) - numpy.pi)


def dance(server, clip, notice, placed, seed=1):
    """The dance through the clip's poses, [frames, joints, 3] places, from frame HISTORY on; `notice` in frames."""
    roots, rotations = clip
    frames = (len(roots) - HISTORY) // KEY_EACH * KEY_EACH + HISTORY

    def pose(frame, placed=True):
        made = choreography.Pose(rotations=rotations[frame].ravel().tolist())
        if placed:
            x, y, z = roots[frame].tolist()
            made.root_position.CopyFrom(choreography.Vector3(x=x, y=y, z=z))
        return made

    def requests():
        history = choreography.History(poses=[pose(frame) for frame in range(HISTORY)], first_frame=HISTORY)
        yield {"config": choreography.DanceConfig(seed=seed, frames=frames, history=history, generate_until=HISTORY)}
        waiting = list(range(HISTORY + KEY_EACH - 1, frames, KEY_EACH))
        for frame in range(HISTORY, frames + GRANT_EACH, GRANT_EACH):
            while waiting and waiting[0] - frame <= notice:
                key = waiting.pop(0)
                yield {"keyframe": choreography.Keyframe(id=str(key), frame=key, pose=pose(key, placed))}
            yield {"generate_until": choreography.GenerateUntil(frame=min(frame, frames))}
        yield {"keyframes_complete": choreography.KeyframesComplete()}

    danced_roots, danced = [], []
    for answer in server.client.stream_dance(requests()):
        assert not answer.event.HasField("keyframe_rejected"), answer
        danced_roots += answer.frames.root_positions
        danced += answer.frames.rotations
    return numpy.array(danced_roots).reshape(-1, 3), numpy.array(danced).reshape(-1, rotations.shape[1], 3)


def on_one_place(joints):
    return joints - joints[:, :1] * [1, 0, 1]


def speeds(joints):
    return numpy.linalg.norm(numpy.diff(joints, axis=0), axis=-1).mean(1)


def compare(danced, real, placed):
    """L2P in cm, speed and rush."""
    if not placed:
        danced, real = on_one_place(danced), on_one_place(real)
    of_danced, of_real = speeds(danced), speeds(real)
    ratios = [numpy.percentile(of_danced, share) / numpy.percentile(of_real, share) for share in (50, 99)]
    return (100 * numpy.linalg.norm(danced - real, axis=-1).mean(), *ratios)


def notice_table(server, places, folder, splits, split):
    """`places`: of joints, from roots and rotations."""
    names = json.loads(splits.read_text())[folder.name][split]
    clips = [read_clip(folder / f"{name}.clip") for name in names]
    print(f"\n{len(clips)} clips, {folder.name}, {split}")
    print("\n| keys | a key comes s ahead | L2P cm | speed ÷ real | rush ÷ real | gone |\n|---|---|---|---|---|---|")
    for placed in (False, True):
        for notice in (0.3, 0.5, 1, 2, None):
            rows = []
            for clip in clips:
                danced = places(server.skeleton, *dance(server, clip, 10**6 if notice is None else round(notice * FPS), placed))
                rows.append(compare(danced, places(server.skeleton, *clip)[HISTORY : HISTORY + len(danced)], placed))
            l2p, speed, rush = numpy.median(rows, 0)
            gone = sum(row[2] > 5 for row in rows)
            where = "where the dancer stood" if placed else "wherever the dancer is"
            print(f"| {where} | {notice or 'all'} | {l2p:.1f} | {speed:.2f} | {rush:.2f} | {gone} of {len(rows)} |", flush=True)
