"""client/python reads key files as `choreo` does: read_keys.json has the keys of examples/, which KeyFileTest.PackagesReadTheSameKeys compares
with those of C++. python_test.py runs it; $CHOREO_SERVER names a choreod."""

import json
import os
import pathlib
import unittest
import warnings

from choreo_client import ChoreoError, Client, KeyRejectedWarning, choreography, library_pose, pose, poses, read_keys

ROOT = pathlib.Path(__file__).resolve().parents[2]
KNOWN = json.loads((ROOT / "tests/examples/read_keys.json").read_text())


class KeysTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with Client(os.environ["CHOREO_SERVER"]) as client:
            cls.skeleton = client.info().models[0].skeleton

    def assert_alike(self, one, other, path):
        if isinstance(other, dict):
            self.assertEqual(list(one), list(other), path)
            for name in other:
                self.assert_alike(one[name], other[name], f"{path}.{name}")
        elif isinstance(other, list):
            self.assertEqual(len(one), len(other), path)
            for at, (left, right) in enumerate(zip(one, other)):
                self.assert_alike(left, right, f"{path}[{at}]")
        elif isinstance(other, float):
            self.assertAlmostEqual(one, other, 5, path)
        else:
            self.assertEqual(one, other, path)

    def test_key_files_are_read_as_by_choreo(self):
        for name, keys in KNOWN.items():
            read = [request["keyframe"] for request in read_keys((ROOT / "examples" / name).read_text(), self.skeleton)]
            self.assertEqual([key["id"] for key in read], [key["id"] for key in keys])
            for key, known in zip(read, keys):
                self.assert_alike(key, known, key["id"])

    def test_any_pose_is_placed_and_turned_as_by_choreo(self):
        for placed in json.loads((ROOT / "tests/examples/placed_keys.json").read_text()):
            keyframe = read_keys(placed["file"], self.skeleton)[0]["keyframe"]
            pose, root = keyframe["pose"], placed.get("root")
            self.assertEqual("root_position" in pose, root is not None)
            for one, known in zip([*pose.get("root_position", {}).values(), *pose["rotations"][:3]], [*(root or []), *placed["pelvis"]]):
                self.assertAlmostEqual(one, known, 3)
            self.assertEqual(keyframe.get("mask", {}).get("joints", []), placed["joints"])

    def test_keys_of_a_file_are_danced(self):
        with Client(os.environ["CHOREO_SERVER"]) as client:
            requests = [{"config": {"frames": 360}}, *read_keys((ROOT / "examples/poses.json").read_text(), self.skeleton)]
            answers = list(client.stream_dance(requests))
        reached = [answer.event.keyframe_reached.id for answer in answers if answer.event.HasField("keyframe_reached")]
        self.assertEqual(reached, [key["id"] for key in KNOWN["poses.json"]])

    def test_poses_have_names_and_tags(self):
        names = [one.id for one in poses()]
        self.assertEqual(names, sorted(file.stem for file in (ROOT / "client/poses").glob("*.json")))
        self.assertTrue(all(one.description and one.tags and len(one.rotations) == 24 for one in poses()))

    def test_a_key_set_into_a_hold_ends_it_and_a_warning_says_so(self):
        keys = [{"time": 1, "pose": "stand", "hold": 2}, {"time": 2.5, "pose": "dab"}]
        with self.assertWarnsRegex(UserWarning, '^key "key1": it is held up to 2 s, not 3 s: the key "key2" comes at 2.5 s$'):
            read = read_keys({"keyframes": keys}, self.skeleton)
        times = [request["keyframe"]["time"] for request in read]
        self.assertEqual([round(time, 6) for time in times], [1, 1.2, 1.4, 1.6, 1.8, 2, 2.5])

    def test_what_is_no_file_and_no_skeleton_is_named(self):
        for path in ("keys/no.json", pathlib.Path("no.json")):
            with self.assertRaisesRegex(ChoreoError, "^file: .*no.json.* is a path: read it, and give its text"):
                read_keys(path, self.skeleton)
        for read in (lambda: library_pose("kick", None), lambda: read_keys({"keyframes": []}, None), lambda: pose(None)):
            with self.assertRaisesRegex(ChoreoError, "^skeleton: None is none, as in "):
                read()

    def test_a_pose_of_the_library_is_danced(self):
        for one in poses():
            (key,) = read_keys({"keyframes": [{"time": 1, "pose": one.id, "place": [1, 2], "facing": 90}]}, self.skeleton)
            pose = library_pose(one.id, self.skeleton, [1, 2], 90)
            self.assertEqual(pose, choreography.Pose(**key["keyframe"]["pose"]))
        kick = library_pose("kick", self.skeleton)
        self.assertFalse(kick.HasField("root_position"))
        with Client(os.environ["CHOREO_SERVER"]) as client:
            list(client.stream_dance([{"config": {"frames": 60}}, {"keyframe": {"id": "a", "time": 1, "pose": kick}}]))
        with self.assertRaisesRegex(ChoreoError, r"^library_pose\.pose: 'kik' is not a pose of the library; did you mean kick\?$"):
            library_pose("kik", self.skeleton)

    def test_a_jump_without_a_place_which_stands_is_warned_of_once_a_key(self):
        def said(make):
            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always")
                make()
            self.assertEqual({warning.filename for warning in caught}, {__file__} if caught else set())
            return [str(warning.message) for warning in caught]

        def read(**fields):
            key = {"id": "up", "time": 1, "pose": "side_leap", **fields}
            return said(lambda: read_keys({"keyframes": [key]}, self.skeleton))

        stands = 'side_leap is in the air, but without a place it stands on the floor; give it one: "place": [x, z]'
        self.assertEqual(read(hold=1), [f'key "up": {stands}'])
        self.assertEqual(read(joints=["legs", "pelvis"]), [f'key "up": {stands}'])
        self.assertEqual(said(lambda: library_pose("side_leap", self.skeleton)), [f"library_pose: {stands}"])
        for fine in ({"place": [0, 0]}, {"joints": ["arms"]}, {"pose": "kick"}):
            self.assertEqual(read(**fine), [])
        self.assertEqual(said(lambda: (library_pose("side_leap", self.skeleton, [0, 0]), library_pose("kick", self.skeleton))), [])

    def test_keys_come_in_order(self):
        keys = [{"time": 3, "pose": "kick", "hold": 0.4}, {"time": 1, "pose": "bow"}, {"time": 3.3, "pose": "dab"}]
        self.assertEqual([one["keyframe"]["time"] for one in read_keys({"keyframes": keys}, self.skeleton)], [1, 3, 3.3])
        frames = [{"frame": 9, "pose": "kick"}, {"frame": 3, "pose": "bow"}]
        self.assertEqual([one["keyframe"]["frame"] for one in read_keys({"keyframes": frames}, self.skeleton)], [3, 9])

    def test_what_choreo_refuses_is_refused(self):
        for refused in json.loads((ROOT / "tests/examples/refused_keys.json").read_text("utf-8")):
            with self.assertRaises(ChoreoError, msg=refused["said"]) as raised:
                read_keys(json.dumps(refused["file"]), self.skeleton)
            said = str(raised.exception).replace("'", '"').replace("None", "null").replace("True", "true")
            self.assertIn(refused["said"].replace("'", '"'), said)

    def test_what_is_no_json_is_refused(self):
        for text in ("hello", b"\xff", '{"keyframes": ['):
            with self.assertRaisesRegex(ChoreoError, "^file: is not JSON: "):
                read_keys(text, self.skeleton)

    def test_what_cannot_be_read_is_named(self):
        for key, field, said in (
            ({"pose": "stand"}, ".time", "is missing, and so is frame"),
            ({"time": 1, "frame": 2, "pose": "stand"}, ".time", "cannot be combined with frame"),
            ({"time": "9c", "pose": "stand"}, ".time", "'9c' is not a number; counts need a song's beats: say seconds"),
            ({"time": 1, "pose": "stnad"}, ".pose", "'stnad' is not a pose of the library; did you mean stand?"),
            ({"time": 1, "poze": "stand"}, ".poze", "is not known; did you mean pose?"),
            ({"time": 1}, ".rotations", "is missing, and so is pose"),
            ({"time": 1, "rotations": [[0, 0, 0]]}, ".rotations", "[[0, 0, 0]] is not one vector for each of 24 joints"),
            ({"time": 1, "pose": "stand", "place": [1]}, ".place", "[1] is not a list of 2 numbers"),
            ({"time": 1, "pose": "stand", "place": "here"}, ".place", "'here' is not a list of 2 numbers, [x, z] in metres; leave it out, and the pose is taken wherever"),
            ({"time": 1, "joints": {"left_knee": [1, 2, 3]}}, ".joints.left_knee", "[1, 2, 3] is not a number"),
            ({"time": 1, "joints": {"tail": [1, 2, 3]}}, ".joints.tail", "'tail' is not a joint of smpl24"),
            ({"time": 1, "pose": "stand", "joints": ["tail"]}, ".joints", "'tail' is not a joint of smpl24"),
            ({"frame": 1, "pose": "stand", "hold": 1}, ".hold", "goes with time"),
            ({"time": 1, "pose": "stand", "hold": 61}, ".hold", "61 s, must be 0.1 to 60"),
        ):
            with self.assertRaises(ChoreoError) as raised:
                read_keys({"keyframes": [key]}, self.skeleton)
            self.assertEqual(raised.exception.violations[0].field, f"keyframes[0]{field}")
            self.assertIn(said, str(raised.exception))

    def test_a_key_that_comes_too_late_is_not_missed(self):
        keys = [{"keyframe": {"id": name, "time": time, "pose": library_pose("dab", self.skeleton)}} for name, time in (("second", 2), ("first", 1))]
        requests = [{"config": {"frames": 90}}, *keys]
        with Client(os.environ["CHOREO_SERVER"]) as client:
            with self.assertWarnsRegex(KeyRejectedWarning, r'^key "first" is not danced as it was sent: frames before \d+ are frozen'):
                list(client.stream_dance(requests))
            heard = []
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                answers = list(client.stream_dance(requests, on_rejected=heard.append))
                with self.assertRaises(KeyRejectedWarning):
                    list(client.stream_dance(requests))
        self.assertEqual(heard, [answer.event.keyframe_rejected for answer in answers if answer.event.HasField("keyframe_rejected")])
        self.assertEqual([key.id for key in heard], ["first"])
