"""Dances whose server is killed in the middle, to compare with undisturbed ones. $CHOREO_SERVER names a choreod, $CHOREOD the program of it."""

import os
import threading

from choreo_client import Client
from servers import Server

OTHER = os.environ["CHOREO_SERVER"]


def told(answers):
    """All that a caller hears, but for how frames are packed and how quick they were."""
    frames = [answer.frames for answer in answers if answer.HasField("frames")]
    report = answers[-1].summary.report
    return {
        "root_positions": [number for block in frames for number in block.root_positions],
        "rotations": [number for block in frames for number in block.rotations],
        "contacts": [number for block in frames for number in block.contacts],
        # A rejection comes at once, before or after the frames that are being made.
        "events": sorted(answer.event.SerializeToString() for answer in answers if answer.HasField("event")),
        "continuations": [answer.continuation for answer in answers if answer.HasField("continuation")],
        "headers": [answer.header for answer in answers if answer.HasField("header")],
        "reached": [(key.id, key.frame, key.errors) for key in report.keyframes],
        "frames": (report.first_frame, report.frames),
    }


def dance_and_kill(source, is_time, heir=OTHER, **options):
    """Dances, and kills the server once `is_time(answers)`, in the middle of the dance: what came, and what was told of the resume."""
    go_on, killed, resumes, answers = threading.Event(), False, [], []
    with Server() as one, Client([one.address, heir], **options) as client:
        requests = source(client.info().models[0].skeleton, go_on=go_on)
        for answer in client.stream_dance(requests, on_resume=resumes.append):
            answers.append(answer)
            if not killed and is_time(answers):
                killed = True
                one.kill()
                go_on.set()
    return answers, resumes


def undisturbed(source):
    with Client(OTHER) as client:
        return list(client.stream_dance(source(client.info().models[0].skeleton)))
