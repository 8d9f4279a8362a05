#!/usr/bin/python3
"""Dances through two key poses to music that is still being played, or to a song."""

import json
import sys

from program import arguments, connect, json_file, positive, run, seed, tell_resume

from choreo_client import choreography, pose
from music import PCM, clicks, file, live


def requests(options, model, music):
    audio_format = choreography.AudioFormat(encoding=choreography.AUDIO_ENCODING_FILE) if options.song else PCM
    frames = round(options.seconds * model.model_frame_rate)
    yield {"config": choreography.DanceConfig(seed=options.seed, frames=frames, audio_format=audio_format)}
    arms_up = pose(model.skeleton, {"left_shoulder": [0, 0, 1], "right_shoulder": [0, 0, -1]}, place=[0, 0.3])
    yield {"keyframe": choreography.Keyframe(id="arms up", time=options.seconds * 0.4, pose=arms_up)}
    yield {"keyframe": choreography.Keyframe(id="rest", time=options.seconds * 0.8, pose=pose(model.skeleton))}
    yield {"keyframes_complete": choreography.KeyframesComplete()}
    for piece in music:
        yield {"audio": piece}
    yield {"end_of_audio": choreography.EndOfAudio()}


def main():
    parser = arguments(__doc__)
    parser.add_argument("--song", help="file to dance to; default: clicks, played meanwhile")
    parser.add_argument("--seconds", type=positive, default=6)
    parser.add_argument("--seed", type=seed, default=1)
    parser.add_argument("--speed", type=positive, default=1, help="of the clicks; 2 plays them twice as fast")
    parser.add_argument("--out", type=json_file, help="JSON file for the dance")
    options = parser.parse_args()

    music = file(options.song) if options.song else live(clicks(options.seconds), options.speed)
    client = connect(options)
    model = client.info().models[0]
    dance = {"root_positions": [], "rotations": []}
    frames = 0
    with client.stream_dance(requests(options, model, music), on_resume=tell_resume) as answers:
        for answer in answers:
            if answer.HasField("header"):
                dance["frame_rate"] = answer.header.frame_rate
                print(f"{answer.header.model} dances with seed {answer.header.seed}")
            elif answer.HasField("frames"):  # a back end would send these on to the browser
                frames += answer.frames.count
                dance["root_positions"] += answer.frames.root_positions
                dance["rotations"] += answer.frames.rotations
                print(f"\r{frames / dance['frame_rate']:.1f} s of {options.seconds} s", end="", file=sys.stderr)
            elif answer.HasField("event") and answer.event.HasField("keyframe_reached"):
                reached = answer.event.keyframe_reached
                print(f"\n{reached.id}: reached to {1e3 * reached.errors.final_error_m:.3f} mm")
            elif answer.HasField("event") and answer.event.HasField("warning"):
                print(f"\nwarning: {answer.event.warning.message}", file=sys.stderr)
            elif answer.HasField("summary"):
                print(f"\n{frames} frames, {answer.summary.timing.real_time_factor:.1f} times as fast as danced")
    if options.out:
        with open(options.out, "w", encoding="utf-8") as out:
            json.dump(dance, out)


run(main)
