#!/usr/bin/python3
"""examples/python, and client/python, against a real choreod, which $CHOREO_SERVER names; $CHOREOD names its program."""

import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time
import unittest
import wave

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDER = ROOT / "examples" / "python"
SERVER = os.environ["CHOREO_SERVER"]
sys.dont_write_bytecode = True
sys.path[:0] = [str(FOLDER), str(ROOT / "client" / "python")]

try:
    import grpc  # noqa: F401
except ImportError:
    print("skipped: there is no grpcio here (scripts/install_packages.sh test)")
    sys.exit(int(os.environ.get("CHOREO_SKIP_CODE", 77)))

from choreo_client import ChoreoError, Client, choreography, pose
from music import PCM, RATE, clicks
from python_answers_test import AnswersTest  # noqa: F401  (its tests are run here)
from python_check_test import CheckTest  # noqa: F401
from python_client_test import ClientTest  # noqa: F401
from python_keys_test import KeysTest  # noqa: F401
from python_package_test import PackageTest  # noqa: F401
from servers import Server


def program(name, *flags):
    command = [sys.executable, "-B", str(FOLDER / name), "--server", SERVER, *map(str, flags)]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def silence():
    """A dance to silence that goes on until somebody ends it."""
    yield {"config": {"audio_format": PCM}}
    yield {"keyframes_complete": {}}
    first_sample = 0
    while True:
        time.sleep(0.005)
        yield {"audio": {"data": bytes(2 * 735), "first_sample": first_sample}}
        first_sample += 735


class PythonTest(unittest.TestCase):
    def setUp(self):
        self.client = Client(SERVER)
        self.addCleanup(self.client.close)

    def test_stream_dance_dances_live(self):
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder, "dance.json")
            done = program("stream_dance.py", "--seconds", 3, "--speed", 50, "--out", out)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertRegex(done.stdout, r"arms up: reached to 0\.\d+ mm")
            self.assertIn("90 frames", done.stdout)
            self.assertIn("3.0 s of 3.0 s", done.stderr)
            self.assertEqual(len(json.loads(out.read_text())["root_positions"]), 3 * 90)

    def test_stream_dance_dances_to_a_song(self):
        with tempfile.TemporaryDirectory() as folder:
            song = str(pathlib.Path(folder, "song.wav"))
            with wave.open(song, "wb") as file:
                file.setnchannels(1)
                file.setsampwidth(2)
                file.setframerate(RATE)
                file.writeframes(clicks(2))
            done = program("stream_dance.py", "--seconds", 2, "--song", song)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("60 frames", done.stdout)
            self.assertNotIn("warning", done.stderr)
            pathlib.Path(song).write_bytes(pathlib.Path(song).read_bytes()[:40000])
            cut = program("stream_dance.py", "--seconds", 2, "--song", song)
            self.assertRegex(cut.stderr, "warning: the music's file: its header says 88200 bytes of samples, 39956 are there")

    def test_live_edit_changes_keys_on_the_way(self):
        done = program("live_edit.py", "--seconds", 5, "--speed", 50)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout, "second 2: reached\nsecond 4: reached\n150 frames\n")

    def test_live_edit_tells_of_each_change_that_comes_too_late(self):
        done = program("live_edit.py", "--seconds", 7, "--speed", 20, "--change-ahead", 0.1)
        self.assertEqual(done.returncode, 0, done.stderr)
        for second in (2, 4, 6):
            self.assertEqual(done.stdout.count(f"second {second}: reached\n"), 1, done.stdout)
            self.assertRegex(done.stdout, rf"second {second}: (?!reached)")

    def test_options_that_cannot_be_are_named(self):
        for name, flag, value in (
            ("live_edit.py", "--seed", -1),
            ("live_edit.py", "--seconds", "nan"),
            ("live_edit.py", "--change-ahead", "-inf"),
            ("stream_dance.py", "--seconds", "inf"),
            ("stream_dance.py", "--speed", 0),
            ("stream_dance.py", "--seed", 2**64),
            ("transition.py", "--frames", 1.5),
            ("transition.py", "--candidates", 0),
        ):
            done = program(name, f"{flag}={value}")
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(f"argument {flag}: {value} is not a ", done.stderr)

    def test_live_edit_survives_its_server(self):
        with tempfile.TemporaryDirectory() as folder, Server() as one:
            whole, resumed = pathlib.Path(folder, "whole.json"), pathlib.Path(folder, "resumed.json")
            undisturbed = program("live_edit.py", "--seconds", 6, "--speed", 50, "--out", whole)
            self.assertEqual(undisturbed.returncode, 0, undisturbed.stderr)
            command = [sys.executable, "-B", "-u", FOLDER / "live_edit.py", "--server", one.address, "--server", SERVER]
            command += ["--seconds", "6", "--speed", "4", "--out", resumed]
            with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as running:
                said = running.stdout.readline()  # the first key is reached, and two are to come
                one.kill()
                said += running.stdout.read()
            self.assertEqual(running.returncode, 0)
            self.assertRegex(said, rf"goes on at {SERVER} from frame \d+\n")
            self.assertEqual(re.sub(r"\ngoes on .*\n", "", said), undisturbed.stdout)
            self.assertEqual(json.loads(resumed.read_text()), json.loads(whole.read_text()))

    def test_a_dance_without_music_goes_on_from_a_continuation(self):
        wanted = pose(self.client.info().models[0].skeleton, {"left_shoulder": [0, 0, 1]})
        rest = [{"keyframe": choreography.Keyframe(id="up", frame=40, pose=wanted)}, {"keyframes_complete": {}}]
        answers = list(self.client.stream_dance([{"config": {"seed": 3, "frames": 90}}, *rest]))
        whole = [number for answer in answers for number in answer.frames.rotations]
        continuation = next(answer.continuation for answer in answers if answer.HasField("continuation"))
        again = self.client.stream_dance([{"config": {"frames": 90, "continuation": continuation}}, *rest])
        self.assertEqual([number for answer in again for number in answer.frames.rotations], whole[len(whole) * continuation.frame // 90 :])

    def test_a_dance_is_written_as_json_alone(self):
        for name in ("stream_dance.py", "live_edit.py"):
            done = program(name, "--out", "/absent/dance.npz")
            self.assertEqual(done.returncode, 2)
            self.assertIn("argument --out: /absent/dance.npz does not end with .json\n", done.stderr)

    def test_a_missing_song_is_named(self):
        done = program("stream_dance.py", "--song", "/absent/song.mp3")
        self.assertEqual((done.returncode, done.stderr), (1, "/absent/song.mp3: No such file or directory\n"))

    def test_transition_ranks_candidates_and_shows_the_field_of_an_error(self):
        good = program("transition.py", "--frames", 20, "--candidates", 4)
        self.assertEqual(good.returncode, 0, good.stderr)
        ranked = r"(?m)^candidate \d: 20 frames, steered \d+\.\d cm, without support \d+ %, skating \d+\.\d %$"
        self.assertEqual(len(re.findall(ranked, good.stdout)), 4, good.stdout)
        bad = program("transition.py", "--frames", 5000)
        self.assertEqual(bad.returncode, 1)
        self.assertIn("INVALID_ARGUMENT: frames: 5000", bad.stderr)
        self.assertIn("field: frames", bad.stderr)

    def test_errors_name_field_and_value(self):
        bad = pose(self.client.info().models[0].skeleton, {"pelvis": [1000, 0, 0]})
        requests = [{"config": {}}, {"keyframe": {"id": "a", "frame": 9, "pose": bad}}]
        with self.assertRaises(ChoreoError) as raised:
            list(self.client.stream_dance(requests))
        self.assertEqual(raised.exception.code, "INVALID_ARGUMENT")
        ((field, description),) = raised.exception.violations
        self.assertEqual(field, "keyframe.pose.rotations[0]")
        self.assertTrue(description.startswith("1000 rad"), description)

    def test_errors_count_the_numbers_that_were_sent(self):
        joints = self.client.info().models[0].skeleton.joint_names
        quaternions = [value for joint in range(len(joints)) for value in (0, 0, 0, 2 if joint == 5 else 1)]
        whole = {"root_position": {"y": 1}, "encoding": "ROTATION_ENCODING_QUATERNION", "rotations": quaternions}
        turned = pose(self.client.info().models[0].skeleton, {joints[5]: [0, 7, 0]})
        for wanted, at in ((turned, 15), (whole, 20)):
            key = {"keyframe": {"id": "a", "frame": 20, "pose": wanted}}
            with self.assertRaises(ChoreoError) as raised:
                list(self.client.stream_dance([{"config": {}}, key]))
            (violation,) = raised.exception.violations
            named = (violation.field, violation.keyframe_id, violation.joint)
            self.assertEqual(named, (f"keyframe.pose.rotations[{at}]", "a", 5))
            answers = list(self.client.stream_dance([{"config": {"frames": 30, "reject_invalid_keys": True}}, key]))
            (rejected,) = (one.event.keyframe_rejected for one in answers if one.event.HasField("keyframe_rejected"))
            self.assertEqual((rejected.id, rejected.field), ("a", named[0]))
            with self.assertRaises(ChoreoError) as raised:
                list(self.client.generate_transition({"config": {}, "frames": 9, "target": wanted}))
            self.assertEqual(raised.exception.violations[0].field, f"target.rotations[{at}]")
        with self.assertRaises(ChoreoError) as raised:
            list(self.client.stream_dance([{"config": {}}, {"keyframe": {"id": "c", "frame": "soon"}}]))
        self.assertEqual(raised.exception.violations[0].keyframe_id, "c")

    def test_a_pose_is_wherever_the_dancer_is_or_at_its_place(self):
        skeleton = self.client.info().models[0].skeleton
        self.assertFalse(pose(skeleton).HasField("root_position"))
        placed = pose(skeleton, {}, place=(3, 2)).root_position
        self.assertEqual((placed.x, placed.z), (3, 2))
        self.assertAlmostEqual(placed.y, skeleton.pelvis_height, 6)
        for place in ([1], 50, "ab", {"x": 1, "z": 2}, [float("nan"), 0]):
            with self.assertRaisesRegex(ChoreoError, r"^place: .* is not \[x, z\], two finite numbers in metres; leave it out, and the pose is taken wherever the dancer is$"):
                pose(skeleton, {}, place=place)

    def test_warnings_name_their_key(self):
        key = {"keyframe": {"id": "far", "frame": 10, "pose": pose(self.client.info().models[0].skeleton, {}, place=[50, 0])}}
        planned, danced = (one.event for one in self.client.stream_dance([{"config": {}}, key]) if one.event.HasField("warning"))
        self.assertEqual((planned.warning.keyframe_id, danced.warning.keyframe_id), ("far", "far"))
        self.assertEqual((planned.warning.code, planned.frame), (choreography.WARNING_CODE_INTERVAL_TOO_SHORT, 10))
        self.assertEqual(danced.warning.code, choreography.WARNING_CODE_JOINT_TOO_FAST)
        self.assertGreater(danced.warning.figure, danced.warning.limit)

    def test_cards_come_on_request(self):
        self.assertEqual({model.card for model in self.client.info().models}, {""})
        self.assertTrue(self.client.info(cards=True).models[0].card)

    def test_a_cancelled_call_ends_here_and_on_the_server(self):
        answers = self.client.stream_dance(silence())
        with self.assertRaises(ChoreoError) as raised:
            for answer in answers:
                if answer.HasField("frames"):
                    answers.cancel()
        self.assertEqual(raised.exception.code, "CANCELLED")
        # So does one that is no longer read, and one whose time is up.
        with self.client.stream_dance(silence()) as answers:
            next(answers)
        with self.assertRaises(ChoreoError) as raised:
            list(self.client.stream_dance(silence(), timeout=0.1))
        self.assertEqual(raised.exception.code, "DEADLINE_EXCEEDED")
        while self.client.info().active_streams > 0:
            time.sleep(0.005)


unittest.main()
