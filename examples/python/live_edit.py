#!/usr/bin/python3
"""Edits a dance while its music plays: each pose is asked for 1.5 s ahead and changed 0.8 s ahead, and half way limbs get livelier. What is
nearer than 0.3 s is settled: with --change-ahead 0.1 each change is refused. With several --server the dance outlives the one that it is
danced by, and goes on at another one, bit for bit."""

import json

from program import arguments, connect, json_file, positive, run, seed, tell_resume

from choreo_client import choreography, pose
from music import PCM, RATE, clicks, live

LOOK_AHEAD = 0.3  # seconds


def edits(options, model):
    """[(second at which it is said, request)]"""
    said = []
    for second in range(2, int(options.seconds), 2):
        left, both = {"left_shoulder": [0, 0, 1]}, {"left_shoulder": [0, 0, 1], "right_shoulder": [0, 0, -1]}
        for ahead, rotations in ((1.5, left), (options.change_ahead, both)):
            wanted = pose(model.skeleton, rotations)  # wherever the dancer is then
            said.append((second - ahead, {"keyframe": choreography.Keyframe(id=f"second {second}", time=second, pose=wanted)}))
    if choreography.CONTROL_VELOCITY_FACTORS in model.controls:
        livelier = choreography.VelocityFactors(factors=[1.5])
        said.append((options.seconds / 2, {"controls": choreography.Controls(velocity_factors=livelier)}))
    return sorted(said, key=lambda edit: edit[0])


def requests(options, model):
    frames = round(options.seconds * model.model_frame_rate)
    # Without generate_until here each key would settle the frames up to itself.
    yield {"config": choreography.DanceConfig(seed=options.seed, frames=frames, audio_format=PCM, generate_until=0, reject_invalid_keys=True)}
    waiting = edits(options, model)
    for piece in live(clicks(options.seconds), options.speed):
        played = (piece.first_sample + len(piece.data) // 2) / RATE
        while waiting and waiting[0][0] <= played:
            yield waiting.pop(0)[1]
        # What is nearer than this is settled; what is after may still change.
        yield {"generate_until": choreography.GenerateUntil(frame=round((played + LOOK_AHEAD) * model.model_frame_rate))}
        yield {"audio": piece}
    yield {"end_of_audio": choreography.EndOfAudio()}
    yield {"keyframes_complete": choreography.KeyframesComplete()}


def tell_rejected(rejected):
    print(f"{rejected.id}: {rejected.reason}")


def main():
    parser = arguments(__doc__)
    parser.add_argument("--seconds", type=positive, default=8)
    parser.add_argument("--seed", type=seed, default=1)
    parser.add_argument("--speed", type=positive, default=1, help="of the clicks; 2 plays them twice as fast")
    parser.add_argument("--change-ahead", type=positive, default=0.8, help="seconds before a pose at which it is changed")
    parser.add_argument("--out", type=json_file, help="JSON file for the dance")
    options = parser.parse_args()

    client = connect(options)
    model = client.info().models[0]
    dance = {"root_positions": [], "rotations": []}
    with client.stream_dance(requests(options, model), on_resume=tell_resume, on_rejected=tell_rejected) as answers:
        for answer in answers:
            if answer.HasField("frames"):  # a back end would send these on to the browser
                dance["root_positions"] += answer.frames.root_positions
                dance["rotations"] += answer.frames.rotations
            elif answer.HasField("header"):
                dance["frame_rate"] = answer.header.frame_rate
            elif answer.event.HasField("keyframe_reached"):
                print(f"{answer.event.keyframe_reached.id}: reached")
    print(f"{len(dance['root_positions']) // 3} frames")
    if options.out:
        with open(options.out, "w", encoding="utf-8") as out:
            json.dump(dance, out)


run(main)
