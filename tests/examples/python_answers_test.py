"""client/python, the package: keys get their answers once, also where their server is killed. python_test.py runs it; $CHOREO_SERVER names a
choreod, $CHOREOD the program of it."""

import unittest

from choreo_client import choreography, pose
from killed_dance import dance_and_kill, told, undisturbed

INVALID, TOO_LATE, FROZEN = choreography.REJECTION_CODE_INVALID, choreography.REJECTION_CODE_TOO_LATE, choreography.REJECTION_CODE_FROZEN
REJECTED_BEFORE, ALREADY_DANCED = choreography.REJECTION_CODE_REJECTED_BEFORE, choreography.REJECTION_CODE_ALREADY_DANCED


def rejections(answers):
    events = [answer.event for answer in answers if answer.event.HasField("keyframe_rejected")]
    return [(event.keyframe_rejected.id, event.frame, event.keyframe_rejected.code) for event in events]


def after(count):
    """For dance_and_kill: once there is a continuation and so many keys are rejected."""
    return lambda answers: any(answer.HasField("continuation") for answer in answers) and len(rejections(answers)) == count


def rejected(skeleton, go_on=None):
    def key(name, **fields):
        return {"keyframe": {"id": name, "pose": pose(skeleton), **fields}}

    yield {"config": {"seed": 5, "frames": 150, "generate_until": 0, "reject_invalid_keys": True}}
    yield key("stays", frame=40)
    yield key("moves", frame=30)
    yield key("moves", frame=80)
    yield {"generate_until": {"frame": 70}}
    yield key("here", frame=37, hands="FLAT")  # the package refuses it
    yield {"keyframe": {"id": "here", "frame": 53}}
    yield {"remove_keyframe": {"id": "here"}}
    yield key("near", frame=3)
    yield key("near", interval_after_previous=1)  # does not count
    yield key("beyond", interval_after_previous=107_999)  # nor does this
    yield key("stays", interval_after_previous=37)
    yield key("here", frame=41, hit=9)
    if go_on:
        go_on.wait()
    yield key("near", frame=3)
    yield key("beyond", frame=108_001)
    yield key("stays", interval_after_previous=37)
    yield key("late", interval_after_previous=10)
    yield key("here", frame=41, hit=9)
    for name in ("late", "here", "stays", "nobody"):
        yield {"remove_keyframe": {"id": name}}
    yield {"generate_until": {"frame": 150}}


class AnswersTest(unittest.TestCase):
    def test_every_key_is_answered_once_before_and_after_its_server_is_killed(self):
        whole = undisturbed(rejected)
        before = [
            ("here", 37, INVALID),
            ("here", 53, INVALID),
            ("here", 53, REJECTED_BEFORE),
            ("near", 3, TOO_LATE),
            ("near", -1, INVALID),
            ("beyond", -1, INVALID),
            ("stays", 40, FROZEN),
            ("here", 41, INVALID),
        ]
        self.assertEqual(
            rejections(whole),
            [
                *before,
                ("near", 3, TOO_LATE),
                ("beyond", -1, INVALID),
                ("stays", 40, FROZEN),
                ("late", 50, TOO_LATE),
                ("here", 41, INVALID),
                ("late", 50, REJECTED_BEFORE),
                ("here", 41, REJECTED_BEFORE),
                ("stays", 40, FROZEN),
                ("nobody", -1, INVALID),
            ],
        )
        answers, resumes = dance_and_kill(rejected, after(len(before)))
        self.assertEqual(len(resumes), 1)
        self.assertEqual(told(answers), told(whole))

    def test_keys_before_the_continuation_from_which_a_caller_goes_on_are_answered_once_too(self):
        continuation = next(answer.continuation for answer in undisturbed(rejected) if answer.HasField("continuation"))

        def going_on(skeleton, go_on=None):
            def key(name, frame):
                return {"keyframe": {"id": name, "frame": frame, "pose": pose(skeleton)}}

            yield {"config": {"continuation": continuation, "frames": 240, "generate_until": 0}}
            yield key("danced", 10)
            yield key("moves", 90)
            yield key("stops", 120)
            yield key("moves", 200)
            yield {"generate_until": {"frame": 150}}
            if go_on:
                go_on.wait()
            yield key("moves", 90)
            yield {"generate_until": {"frame": 240}}

        whole = undisturbed(going_on)
        self.assertEqual(rejections(whole), [("danced", 10, ALREADY_DANCED), ("moves", 90, TOO_LATE)])
        answers, resumes = dance_and_kill(going_on, after(1))
        self.assertEqual(len(resumes), 1)
        self.assertEqual(told(answers), told(whole))
