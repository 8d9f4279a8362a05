"""client/python: requests that the API does not know are refused by field, value and what is allowed; failures are ChoreoErrors; methods say
what they take. python_test.py runs it; $CHOREO_SERVER names a choreod."""

import array
import asyncio
import concurrent.futures
import fractions
import functools
import inspect
import json
import math
import os
import pathlib
import queue
import re
import subprocess
import sys
import tempfile
import threading
import time
import typing
import unittest
import wave

from google.protobuf.json_format import MessageToDict

from choreo_client import Answers, ChoreoError, Client, aio, choreography, pose
from music import PCM, RATE, clicks

SKELETON = choreography.Skeleton(name="two", joint_names=["pelvis", "left_shoulder"], pelvis_height=1)
CONFIG = {"config": {"frames": 30}}


def keyframe(**fields):
    return [CONFIG, {"keyframe": {"id": "a", "time": 0.5, **fields}}]


class CheckTest(unittest.TestCase):
    def setUp(self):
        self.client = Client(os.environ["CHOREO_SERVER"])
        self.addCleanup(self.client.close)

    def dance(self, *requests):
        return list(self.client.stream_dance(requests))

    def assert_refused(self, pattern, call, *arguments, code="INVALID_ARGUMENT"):
        with self.assertRaisesRegex(ChoreoError, rf"^(requests\[\d+\]\.)?{pattern}") as raised:
            call(*arguments)
        self.assertEqual(raised.exception.code, code)
        return raised.exception

    def test_a_request_that_the_api_does_not_know_is_refused_by_its_path(self):
        for requests, field, description in (
            ([{"config": {"frameRate": 60}}], "config.frameRate", r"no field of DanceConfig; did you mean frame_rate\?$"),
            ([{"config": {"audio_format": {"zoom": 1}}}], "config.audio_format.zoom", "no field of AudioFormat; there are encoding, "),
            ([{"config": {"encoding": "QUATERNION"}}], "config.encoding", r"'QUATERNION' is not a .*; did you mean ROTATION_ENCODING_QUATERNION\?$"),
            ([{"config": {"encoding": 77}}], "config.encoding", "77 is not a RotationEncoding; there are ROTATION_ENCODING_UNSPECIFIED, "),
            (keyframe(hands="fist"), "keyframe.hands", r"'fist' is not a HandPose; did you mean HAND_POSE_FIST\?$"),
            (keyframe(pose={"root_position": [0, 1, 0]}), "keyframe.pose.root_position", r"\[0, 1, 0\] is not a Vector3, {x, y, z}$"),
            (keyframe(pose=choreography.Vector3()), "keyframe.pose", "a choreo.v1.Vector3 is not a Pose, "),
            (keyframe(pose={"rotations": [0, float("nan")]}), "keyframe.pose.rotations[1]", "nan is not a finite number$"),
            (keyframe(pose={"rotations": [0] * 7 + [math.nan]}), "keyframe.pose.rotations[7]", "nan is not a finite number$"),
            (keyframe(pose={"encoding": "ROTATION_ENCODING_QUATERNION", "rotations": [0] * 7 + [math.nan]}), "keyframe.pose.rotations[7]", "nan is no"),
            (keyframe(pose={"rotations": "none"}), "keyframe.pose.rotations", "'none' is not a list$"),
            (keyframe(pose={"rotations": 5}), "keyframe.pose.rotations", "5 is not a list$"),
            (keyframe(pose={"rotations": [[0, 0, 0]]}), "keyframe.pose.rotations[0]", r"\[0, 0, 0\] is not a number; rotations is one flat list: give "),
            (keyframe(mask={"joints": ["head"]}), "keyframe.mask.joints[0]", "'head' is not a whole number$"),
            (keyframe(id=5), "keyframe.id", "5 is not a str$"),
            (keyframe(id="a\ud800"), "keyframe.id", r"'a\\ud800' has half a character, a surrogate without its pair$"),
            ([{"config": {"style": "\udc83\ud83d"}}], "config.style", ".* has half a character, "),
            (keyframe(hands="fist\ud83d"), "keyframe.hands", ".* is not a HandPose; did you mean HAND_POSE_FIST"),
            (keyframe(hands=[]), "keyframe.hands", r"\[\] is not a HandPose; there are "),
            (keyframe(hands=10**400), "keyframe.hands", "1000000000.* is not a HandPose; there are "),
            (keyframe(hit=10**400), "keyframe.hit", "1000000000.*0000000000 is not a finite number$"),
            (keyframe(hit=fractions.Fraction(10**400)), "keyframe.hit", ".* is not a finite number$"),
            (keyframe(pose={"rotations": [0, 0, 0, 1e300]}), "keyframe.pose.rotations[3]", r"1e\+300 is beyond the numbers of 32 bits, which end at 3.4e38$"),
            ([{"config": {"seed": 10**400}}], "config.seed", "1000000000.* is more than 18446744073709551615$"),
            ([{"config": {"seed": "1" * 5000}}], "config.seed", "'1111.* is not a whole number$"),
            (keyframe(frame=3), "keyframe.frame", "given beside time; there is one of frame, time, interval_after_previous$"),
            ([{"config": {"allow_inexact_resume": "no"}}], "config.allow_inexact_resume", "'no' is not a bool$"),
            *(([{"config": {"seed": seed}}], "config.seed", ".* is not a whole number$") for seed in (1.5, "7x")),
            ([{"config": {"seed": -1}}], "config.seed", "-1 is less than 0$"),
            ([{"config": {"seed": 2**64}}], "config.seed", ".* is more than 18446744073709551615$"),
            ([CONFIG, {"keyframe": None}], "keyframe", "None is not a Keyframe, "),
            ([CONFIG, {"remove_keyframe": None}], "remove_keyframe", "None is not a RemoveKeyframe, "),
            ([CONFIG, None], "requests[1]", "None is not a StreamDanceRequest, {config, audio, "),
        ):
            error = self.assert_refused("", self.dance, *requests)
            ((named, said),) = error.violations
            self.assertEqual(named, field)
            self.assertRegex(said, f"^{description}")
            at = len(requests) - 1
            self.assertEqual(str(error), f"{'' if named.startswith('requests') else f'requests[{at}].'}{named}: {said}")
            self.assertEqual(error.violations[0].request, at)
            self.assertEqual(error.reason, "INVALID_VALUE")
            number = re.search(r"rotations\[(\d+)\]$", named)
            width = 4 if "QUATERNION" in str(requests) else 3
            self.assertEqual(error.violations[0].joint, number and int(number[1]) // width)
        self.assert_refused("requests: None is not an iterable", lambda: list(self.client.stream_dance(None)))
        for one in ({"config": {}}, choreography.StreamDanceRequest()):
            self.assert_refused("requests: is one request: put it in a list", lambda one=one: list(self.client.stream_dance(one)))
        self.assert_refused("rank_by: 'LIKELIHOOD' is not a RankBy; did you mean", self.client.generate_transition, {"rank_by": "LIKELIHOOD"})
        self.assert_refused("request: None is not a GenerateTransitionRequest", self.client.generate_transition, None)

    def test_lists_of_messages_are_lists_by_whatever_protobuf_there_is(self):
        program = """
from google.protobuf.internal import api_implementation
from choreo_client import choreography
from choreo_client._check import checked

pose = choreography.Pose(rotations=[1, 2, 3])
history = choreography.History(poses=[pose])
mask = choreography.JointMask(joints=[1, 2])
continuation = choreography.Continuation(root_positions=[1, 2, 3])
key = {"pose": {"rotations": pose.rotations}, "mask": {"joints": mask.joints}}
for kind, fields, message in (
    (choreography.History, {"poses": history.poses}, history),
    (choreography.Continuation, {"root_positions": continuation.root_positions}, continuation),
    (choreography.Keyframe, key, choreography.Keyframe(pose=pose, mask=mask)),
):
    read = checked(kind, fields, "fields")
    assert read == message, read
print(api_implementation.Type())
"""
        for implementation in ("cpp", "python"):
            environment = {**os.environ, "PROTOCOL_BUFFERS_PYTHON_IMPLEMENTATION": implementation, "PYTHONPATH": os.pathsep.join(sys.path)}
            done = subprocess.run([sys.executable, "-B", "-c", program], env=environment, capture_output=True, text=True, check=False)
            if "ImportError" in done.stderr:
                continue  # this protobuf is without that one
            self.assertEqual(done.returncode, 0, done.stderr)

    def test_a_source_whose_request_is_refused_is_ended(self):
        ended = threading.Event()

        def requests():
            try:
                yield {"config": {}}
                yield {"keyfarme": {}}
            finally:
                ended.set()

        wrong = r"keyfarme: no field of StreamDanceRequest; did you mean keyframe\?$"
        self.assert_refused(wrong, lambda: list(self.client.stream_dance(requests())))
        self.assertTrue(ended.wait(10))

    def test_with_reject_invalid_keys_a_request_that_is_wrong_beside_its_key_ends_the_dance_too(self):
        lenient = {"config": {"frames": 30, "reject_invalid_keys": True}}
        for wrong, field in (
            ({"keyfarme": {}}, "keyfarme"),
            ({"end_of_audio": {}, "keyframe": {"id": 5}}, "keyframe"),
            ({"keyframe": {"id": 5}, "end_of_audio": {}}, "keyframe.id"),
            ({"remove_keyframe": {"id": 5}, "end_of_audio": {}}, "remove_keyframe.id"),
        ):
            self.assertEqual(self.assert_refused("", self.dance, lenient, wrong).violations[0].field, field)

    def test_music_is_bytes_or_the_samples_that_its_encoding_says(self):
        def dance(encoding, data):
            audio_format = {"encoding": encoding, "sample_rate": 8000, "channels": 1}
            return sum(answer.frames.count for answer in self.dance({"config": {"audio_format": audio_format}}, {"audio": {"data": data}}))

        floats = array.array("f", bytes(4 * 8000))
        for data in (floats, floats.tobytes(), memoryview(floats.tobytes()), bytearray(floats)):
            self.assertEqual(dance("AUDIO_ENCODING_PCM_F32LE", data), 30)
        for data in (floats, array.array("d", [0]), "song.mp3", [1, 2]):
            self.assert_refused(r"audio\.data: ", dance, choreography.AUDIO_ENCODING_PCM_S16LE, data)

    def test_pieces_of_music_are_numbered_where_nobody_says_where_they_start(self):
        with tempfile.TemporaryFile() as file:
            with wave.open(file, "wb") as song:
                song.setnchannels(1)
                song.setsampwidth(2)
                song.setframerate(RATE)
                song.writeframes(clicks(2))
            file.seek(0)
            song = file.read()
        for audio_format, music in (({"encoding": "AUDIO_ENCODING_FILE"}, song), (PCM, clicks(2))):
            config = {"config": {"seed": 1, "frames": 60, "generate_until": 0, "audio_format": audio_format}}
            rest = [{"end_of_audio": {}}, {"keyframes_complete": {}}]

            def dance(*pieces):
                return [number for answer in self.dance(config, *pieces, *rest) for number in answer.frames.rotations]

            pieces = (music[:30000], music[30000:60000], music[60000:])
            whole = dance({"audio": {"data": music, "first_sample": 0}})
            self.assertEqual(dance(*({"audio": {"data": data}} for data in pieces)), whole)
            own = [choreography.StreamDanceRequest(audio={"data": data}) for data in pieces]
            self.assertEqual(dance(*own), whole)
            self.assertEqual(own[1].audio.first_sample, 0)  # the caller sees its own

    def test_music_that_no_message_can_hold_is_refused_before_it_is_sent(self):
        config = {"frames": 30, "audio_format": {"encoding": "AUDIO_ENCODING_PCM_F32LE", "sample_rate": 48000, "channels": 1}}

        def dance(size):
            return self.dance({"config": config}, {"audio": {"data": bytes(size)}}, {"end_of_audio": {}})

        wrong = r"audio\.data: {} MiB; a message has at most 16 MiB in all: {}$"
        pieces = "send it in pieces"
        for size, told in ((17 << 20, "17.0"), (16 << 20, "16.0")):
            self.assert_refused(wrong.format(told, pieces), dance, size)
        self.assertEqual(sum(answer.frames.count for answer in dance((16 << 20) - 32)), 30)
        transition = {"config": config, "frames": 9, "audio": {"data": bytes(17 << 20)}}
        alone = "send the music of its frames alone, or a compressed file"
        self.assert_refused(wrong.format("17.0", alone), self.client.generate_transition, transition)

    def test_what_the_page_tells_of_the_music_is_danced_to(self):
        page = pathlib.Path(__file__).resolve().parents[2] / "client/python/README.md"
        heard = json.loads(re.search(r'\{"music_dynamics.*\}', page.read_text())[0])
        beats = [answer.event for answer in self.dance({"config": {"frames": 45, **heard}}) if answer.event.HasField("beat")]
        told = [(time, time in heard["music_downbeats"]) for time in heard["music_beats"]]
        self.assertEqual([(event.time, event.beat.downbeat) for event in beats], told)
        self.assertLessEqual({"variation", "music_passages"}, set(heard))

    def test_a_transition_takes_fields(self):
        answers = list(self.client.generate_transition({"config": {"seed": 3}, "frames": 20, "candidates": 2}))
        self.assertEqual(sum(answer.frames.count for answer in answers), 40)

    def test_a_pose_of_joints_that_are_not_there_or_of_no_rotations_is_refused(self):
        for rotations, message in (
            ({"leftShoulder": [0, 0, 1]}, r"rotations\.leftShoulder: no joint of two; did you mean left_shoulder\?$"),
            ({"tail": [0, 0, 1]}, r"rotations\.tail: no joint of two; there are pelvis, left_shoulder$"),
            (5, r"rotations: 5 is not \{joint name: \[x, y, z\]\}$"),
            ({"pelvis": [0, 10**400, 0]}, r"rotations\.pelvis: \[0, 1000.* is not"),
            ({"pelvis": [0, 1e300, 0]}, r"rotations\.pelvis: \[0, 1e\+300, 0\] is not"),
            ({"pelvis": 1}, r"rotations\.pelvis: 1 is not \[x, y, z\], three finite numbers$"),
            ({"pelvis": [1, 2]}, r"rotations\.pelvis: \[1, 2\] is not"),
            ({"pelvis": [0, float("nan"), 0]}, r"rotations\.pelvis: \[0, nan, 0\] is not"),
        ):
            self.assert_refused(message, pose, SKELETON, rotations)

    def test_a_closed_client_ends_its_calls_and_begins_no_others(self):
        def requests():
            yield {"config": {"generate_until": 30}}
            over.wait()

        over = threading.Event()
        self.addCleanup(over.set)

        def dance():
            for answer in self.client.stream_dance(requests()):
                if answer.HasField("frames"):
                    self.client.close()

        for call in (dance, self.client.info, lambda: self.dance(CONFIG), lambda: list(self.client.generate_transition({"frames": 9}))):
            self.assert_refused("the client is closed$", call, code="CANCELLED")

    def test_a_timeout_and_addresses_that_cannot_be_are_refused(self):
        for timeout in ("soon", float("nan")):
            for call in (self.client.info, functools.partial(self.client.stream_dance, [CONFIG], None)):
                self.assert_refused("timeout: .* is not a number of seconds$", call, timeout)
        for timeout in (1e30, float("inf"), 10**400):
            self.assertTrue(self.client.info(timeout).models)
        self.assert_refused("retry_s: 1000.* is not a finite number >= 0$", lambda: Client("127.0.0.1:1", retry_s=10**400))
        Client("127.0.0.1:1", connect_timeout_s=1e300).close()
        for addresses in (None, b"one:50051"):
            self.assert_refused("addresses: .* is neither HOST:PORT nor", Client, addresses)

    def test_asyncio_asks_a_server_what_it_has(self):
        self.assertEqual(asyncio.run(aio.info(self.client)), self.client.info())
        self.assertTrue(asyncio.run(aio.info(self.client, 5, cards=True)).models[0].card)
        self.assert_refused("client: 'one:1' is not a Client$", lambda: asyncio.run(aio.info("one:1")))

    def test_a_stream_of_what_is_no_call_is_refused(self):
        async def read():
            return [answer async for answer in aio.stream(None)]

        self.assert_refused("answers: None is not what stream_dance or generate_transition returns$", lambda: asyncio.run(read()))

    def test_the_page_s_program_for_asyncio_dances_and_can_be_cancelled(self):
        page = pathlib.Path(__file__).resolve().parents[2] / "client/python/README.md"
        program = {}
        exec(re.findall(r"(?ms)^```python\n(.*?)^```$", page.read_text())[1], program)  # pylint: disable=exec-used

        async def dance(*said, until_frames):
            requests, heard, first = asyncio.Queue(), [], asyncio.Event()

            def hear(answer):
                heard.append(answer)
                if answer.HasField("frames"):
                    first.set()

            for request in said:
                requests.put_nowait(request)
            task = asyncio.create_task(program["watch"](self.client, requests, hear))
            if until_frames:
                await first.wait()
                task.cancel()
            await asyncio.wait([task])
            self.assertEqual(task.cancelled(), until_frames)
            return sum(answer.frames.count for answer in heard)

        self.assertEqual(asyncio.run(dance(CONFIG, None, until_frames=False)), 30)
        asyncio.run(dance({"config": {"generate_until": 30}}, until_frames=True))
        while self.client.info().active_streams > 0:
            time.sleep(0.005)

    def test_dances_that_wait_for_asyncio_leave_the_loop_to_others(self):
        async def dances():
            loop = asyncio.get_running_loop()
            loop.set_default_executor(concurrent.futures.ThreadPoolExecutor(2))
            waiting = [queue.SimpleQueue() for _ in range(12)]

            async def frames(requests):
                return sum([answer.frames.count async for answer in aio.stream(self.client.stream_dance(requests))])

            def source(requests):
                yield {"config": {"frames": 30, "generate_until": 0}}
                requests.get()
                yield {"keyframes_complete": {}}

            others = [asyncio.create_task(frames(source(requests))) for requests in waiting]
            while (await loop.run_in_executor(None, self.client.info)).active_streams < len(others):
                await asyncio.sleep(0.005)
            self.assertEqual(await frames([CONFIG]), 30)
            for requests in waiting:
                requests.put(None)
            self.assertEqual(await asyncio.gather(*others), [30] * len(others))

        asyncio.run(asyncio.wait_for(dances(), 60))

    def test_asyncio_hears_of_errors_and_ends_what_nobody_reads(self):
        async def refused():
            return [answer async for answer in aio.stream(self.client.stream_dance([{"config": {"frames": -1}}]))]

        async def leave():
            async for answer in aio.stream(self.client.stream_dance(source())):
                if answer.HasField("frames"):
                    break

        def source():
            yield {"config": {"generate_until": 30}}
            over.wait()

        over = threading.Event()
        self.addCleanup(over.set)
        self.assert_refused("config.frames", lambda: asyncio.run(refused()))
        asyncio.run(leave())
        while self.client.info().active_streams > 0:
            time.sleep(0.005)

    def test_requests_may_be_an_asynchronous_generator_which_ends_with_its_dance(self):
        ended = []

        async def requests(*said):
            try:
                yield {"config": {"frames": 30, "generate_until": 0}}
                for request in said:
                    await asyncio.sleep(0.001)
                    yield request
            finally:
                ended.append(True)

        async def patient():
            try:
                yield {"config": {"generate_until": 30}}
                await asyncio.Event().wait()
            finally:
                ended.append(True)

        async def frames(source):
            return sum([answer.frames.count async for answer in aio.stream(self.client.stream_dance(source))])

        async def leave():
            async for answer in aio.stream(self.client.stream_dance(patient())):
                if answer.HasField("frames"):
                    break
            while not ended:
                await asyncio.sleep(0.001)

        async def fails():
            yield {"config": {}}
            raise KeyError("of the program")

        async def blocks():
            return list(self.client.stream_dance(requests()))

        self.assertEqual(asyncio.run(frames(requests({"keyframes_complete": {}}))), 30)
        self.assertTrue(ended)
        ended.clear()
        asyncio.run(asyncio.wait_for(leave(), 20))
        ended.clear()
        wrong = r"keyfarme: no field of StreamDanceRequest"
        self.assert_refused(wrong, lambda: asyncio.run(frames(requests({"keyfarme": {}}))))
        with self.assertRaisesRegex(KeyError, "of the program"):
            asyncio.run(frames(fails()))
        self.assert_refused("requests: .* would wait for their own loop: read the answers by aio.stream$", lambda: asyncio.run(blocks()))
        self.assert_refused("requests: .* is asynchronous, and no loop runs here$", lambda: self.client.stream_dance(requests()))

    def test_a_continuation_that_was_kept_as_json_goes_on(self):
        rest = [{"keyframe": {"id": "a", "frame": 40, "pose": {"rotations": [0.1] * 72}}}, {"keyframes_complete": {}}]
        answers = list(self.client.stream_dance([{"config": {"seed": 2**63, "frames": 90}}, *rest]))
        whole = [number for answer in answers for number in answer.frames.rotations]
        continuation = next(answer.continuation for answer in answers if answer.HasField("continuation"))
        kept = json.loads(json.dumps(MessageToDict(continuation, preserving_proto_field_name=True)))
        self.assertIsInstance(kept["seed"], str)
        again = self.client.stream_dance([{"config": {"frames": 90, "continuation": kept}}, *rest])
        self.assertEqual([number for answer in again for number in answer.frames.rotations], whole[len(whole) * continuation.frame // 90 :])
        for text in ("12.5", "", "ten"):
            self.assert_refused(f"config.seed: '{text}' is not a whole number", self.dance, {"config": {"seed": text}})
        self.assert_refused("config.seed: '18446744073709551616' is more than", self.dance, {"config": {"seed": "18446744073709551616"}})

    def test_a_fault_in_one_of_several_requests_is_told_with_its_index(self):
        opened = {"config": {"frames": 99, "generate_until": 0}}
        heard = {"config": {"frames": 99, "audio_format": {"encoding": "AUDIO_ENCODING_PCM_S16LE", "sample_rate": 16000, "channels": 1}}}
        piece = {"data": bytes(100)}
        for requests, message in (
            ([opened, {}], r"requests\[1\]: is empty; there are config, audio, "),
            ([opened, {"generate_until": {"frame": 9}}, {"config": {}}], r"requests\[2\]\.config: came before"),
            ([heard, {"audio": piece}, {"audio": {**piece, "first_sample": 500}}, {"audio": piece}], r"requests\[2\]\.audio\.first_sample: 500 leaves a gap"),
            ([opened, {"generate_until": {"frame": 20}}, {"generate_until": {"frame": 10}}], r"requests\[2\]\.generate_until\.frame: 10 is not in"),
            ([opened, {"keyframes_complete": {}}, {"keyframes_complete": {}}], r"requests\[2\]\.keyframes_complete: comes after"),
            ([heard, {"end_of_audio": {}}, {"audio": piece}], r"requests\[1\]\.end_of_audio: no sample came before"),
        ):
            with self.subTest(message), self.assertRaisesRegex(ChoreoError, f"^{message}"):
                list(self.client.stream_dance(requests))

    def test_answers_can_be_closed(self):
        answers = self.client.stream_dance([{"config": {"generate_until": 30}}])
        next(answers)
        for _ in range(2):
            answers.close()
        self.assertEqual(list(answers), [])

    def test_the_client_s_signature_names_its_options(self):
        for signature in map(inspect.signature, (Client, Client.__init__)):
            self.assertLessEqual({"addresses", "tls", "token_file", "retry_s"}, set(signature.parameters))
            self.assertNotIn("options", signature.parameters)

    def test_public_functions_say_what_they_take_and_give(self):
        public = [aio.stream, aio.info, pose]
        for kind in (Answers, Client):
            public += [value for name, value in vars(kind).items() if inspect.isfunction(value) and (name[0] != "_" or name == "__next__")]
        self.assertGreater(len(public), 6)
        for function in public:
            told = typing.get_type_hints(function)
            wanted = {name for name in inspect.signature(function).parameters if name != "self"} | {"return"}
            self.assertEqual(set(told), wanted, function)
