#!/usr/bin/python3
"""Makes several ways from rest to a pose, best first, and says what they are ranked by."""

import collections
import sys

from program import arguments, connect, run, seed, whole

from choreo_client import choreography, pose
from music import PCM, clicks


def main():
    parser = arguments(__doc__)
    parser.add_argument("--frames", type=whole(1, 10**6), default=45)
    parser.add_argument("--candidates", type=whole(1, 10**6), default=3)
    parser.add_argument("--seed", type=seed, default=1)
    options = parser.parse_args()

    client = connect(options)
    model = client.info().models[0]
    request = choreography.GenerateTransitionRequest(
        config=choreography.DanceConfig(seed=options.seed, audio_format=PCM),
        frames=options.frames,
        candidates=options.candidates,
        target=pose(model.skeleton, {"left_shoulder": [0, 0, 1], "right_shoulder": [0, 0, -1]}),
        audio=choreography.Audio(data=clicks(options.frames / model.model_frame_rate)),
    )
    frames = collections.Counter()  # of each candidate, as they come
    with client.generate_transition(request) as answers:
        for answer in answers:
            if answer.HasField("frames"):
                frames[answer.frames.candidate] += answer.frames.count
                print("\r" + " + ".join(map(str, frames.values())) + " frames", end="", file=sys.stderr)
            elif answer.HasField("summary"):
                print()
                for ranked in answer.summary.candidates:
                    report = ranked.report
                    # What they are ranked by, in this order.
                    unsupported = f"{100 * (1 - report.support):.0f}" if report.HasField("support") else "?"
                    print(
                        f"candidate {ranked.candidate}: {frames[ranked.candidate]} frames, "
                        f"steered {100 * report.keyframes[0].errors.correction_m:.1f} cm, "
                        f"without support {unsupported} %, skating {100 * report.skate_ratio:.1f} %"
                    )


run(main)
