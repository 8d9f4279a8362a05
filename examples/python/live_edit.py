#!/usr/bin/python3
"""Edits a dance while its music plays: each pose is asked for 1.5 s ahead and changed 0.8 s ahead, and half way limbs get livelier. What is
nearer than 0.3 s is settled: with --change-ahead 0.1 each change is refused. With --lose-at the connection is lost on the way, and another one
goes on from the last continuation, bit for bit."""

import argparse
import json
import os

from choreo_client import Requests, choreography, connect, pose, positive, run, seed
from music import PCM, RATE, clicks, live

LOOK_AHEAD = 0.3  # seconds


def edits(options, model):
    """[(second at which it is said, request)]"""
    said = []
    for second in range(2, int(options.seconds), 2):
        left, both = {"left_shoulder": [0, 0, 1]}, {"left_shoulder": [0, 0, 1], "right_shoulder": [0, 0, -1]}
        for ahead, rotations in ((1.5, left), (options.change_ahead, both)):
            wanted = pose(model.skeleton, rotations)
            wanted.ClearField("root_position")  # wherever the dancer is then
            said.append((second - ahead, {"keyframe": choreography.Keyframe(id=f"second {second}", time=second, pose=wanted)}))
    if choreography.CONTROL_VELOCITY_FACTORS in model.controls:
        livelier = choreography.VelocityFactors(factors=[1.5])
        said.append((options.seconds / 2, {"controls": choreography.Controls(velocity_factors=livelier)}))
    return sorted(said, key=lambda edit: edit[0])


def requests(options, model):
    frames = round(options.seconds * model.model_frame_rate)
    # Without generate_until here each key would settle the frames up to itself.
    yield {"config": choreography.DanceConfig(seed=options.seed, frames=frames, audio_format=PCM, generate_until=0)}
    waiting = edits(options, model)
    for piece in live(clicks(options.seconds), options.speed):
        played = (piece.first_sample + len(piece.data) // 2) / RATE
        while waiting and waiting[0][0] <= played:
            yield waiting.pop(0)[1]
        # What is nearer than this is settled; what lies behind may still change.
        yield {"generate_until": choreography.GenerateUntil(frame=round((played + LOOK_AHEAD) * model.model_frame_rate))}
        yield {"audio": piece}
    yield {"end_of_audio": choreography.EndOfAudio()}
    yield {"keyframes_complete": choreography.KeyframesComplete()}


class Dance:
    """What came."""

    def __init__(self, options, joints):
        self.options, self.joints = options, joints
        self.root_positions, self.rotations = [], []
        self.continuation = None
        self.told, self.known = set(), set()  # (key, whether it was reached); those told before the connection was lost

    def frames(self):
        return len(self.root_positions) // 3

    def take(self, answers):
        """False: the connection was lost."""
        lose_at = self.options.lose_at
        for answer in answers:
            if answer.HasField("frames"):
                self.root_positions += answer.frames.root_positions
                self.rotations += answer.frames.rotations
                if lose_at and self.continuation and self.frames() > lose_at * self.frame_rate:
                    return False
            elif answer.HasField("header"):
                self.frame_rate = answer.header.frame_rate
            elif answer.HasField("continuation"):
                self.continuation = answer.continuation
            elif answer.event.HasField("keyframe_reached"):
                self.tell(answer.event.keyframe_reached.id, True, "reached")
            elif answer.event.HasField("keyframe_rejected"):
                self.tell(answer.event.keyframe_rejected.id, False, answer.event.keyframe_rejected.reason)
        return True

    def tell(self, key, reached, what):
        """Keys are sent again where the dance goes on: that they were reached, or are too late now, was told."""
        self.told.add((key, reached))
        if (key, True) not in self.known and (key, reached) not in self.known:
            print(f"{key}: {what}")

    def forget_behind_continuation(self):
        """Frames behind it are made again, equal."""
        self.known = set(self.told)
        frame = self.continuation.frame if self.continuation else 0
        del self.root_positions[3 * frame :], self.rotations[3 * self.joints * frame :]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--server", default=os.environ.get("CHOREO_SERVER", "127.0.0.1:50051"), help="HOST:PORT")
    parser.add_argument("--seconds", type=positive, default=8)
    parser.add_argument("--seed", type=seed, default=1)
    parser.add_argument("--speed", type=positive, default=1, help="of the clicks; 2 plays them twice as fast")
    parser.add_argument("--change-ahead", type=positive, default=0.8, help="seconds before a pose at which it is changed")
    parser.add_argument("--lose-at", type=positive, help="second of the dance at which the connection is lost")
    parser.add_argument("--out", help="JSON file for the dance")
    options = parser.parse_args()

    server = connect(options.server)
    model = server.GetServerInfo(choreography.GetServerInfoRequest()).models[0]
    said = Requests(requests(options, model))
    dance = Dance(options, len(model.skeleton.joint_names))
    call = server.StreamDance(said.all())
    try:
        while not dance.take(call):
            call.cancel()
            options.lose_at = None
            dance.forget_behind_continuation()
            print(f"goes on from frame {dance.continuation.frame}")
            call = server.StreamDance(said.since(dance.continuation))
    finally:
        call.cancel()
    print(f"{dance.frames()} frames")
    if options.out:
        with open(options.out, "w", encoding="utf-8") as out:
            json.dump({"frame_rate": dance.frame_rate, "root_positions": dance.root_positions, "rotations": dance.rotations}, out)


run(main)
