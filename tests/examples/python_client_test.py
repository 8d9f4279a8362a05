"""client/python, the package: who may come, and dances that outlive their server. python_test.py runs it; $CHOREO_SERVER names a
choreod, $CHOREOD the program of it."""

import functools
import hashlib
import os
import pathlib
import re
import socket
import tempfile
import threading
import time
import unittest
import unittest.mock

from choreo_client import ChoreoError, Client, choreography, pose
from choreo_client._options import Options
from choreo_client._replicas import Cancellation, Patience
from killed_dance import dance_and_kill, told, undisturbed
from music import PCM, RATE, clicks, live
from servers import Authority, Server

OTHER = os.environ["CHOREO_SERVER"]


def info(address, **options):
    with Client(address, **({"retry_s": 0} | options)) as client:
        return client.info()


def token_line(token, name):
    return f"{hashlib.sha256(token.encode()).hexdigest()} {name}\n"


# Keys that the package refuses itself, but for the third and two removals, and what is wrong with them. Two would move a key that is there.
BAD_KEYS = [
    {"keyframe": {"id": "moved", "time": "soon"}},
    {"keyframe": {"id": "blank", "frame": 160, "pose": {"rotations": [0, float("nan")]}}},
    {"keyframe": {"id": "blank"}},
    {"keyframe": {"id": 5, "frame": 160}},
    {"keyframe": "wave"},
    {"keyframe": {"id": "hurried", "time": 0.5, "tim": 3}},
    {"keyframe": {"id": "twice", "frame": 9, "time": 3}},
    {"keyframe": {"id": "next", "frame": 45, "pose": 5}},
    {"keyframe": {"id": "after", "interval_after_previous": 15, "pose": 5}},
    {"keyframe": {"id": "half \ud83d", "frame": 160}},
    {"keyframe": {"id": "far", "time": 10**400}},
    {"keyframe": {"id": "turned", "frame": 160, "pose": {"rotations": [10**5000]}}},
    {"keyframe": {"id": "odd", "frame": 160, "ti\ud83dme": 1}},
    {"remove_keyframe": {"id": "next"}},
    {"remove_keyframe": {"id": "nobody"}},
    {"keyframe": None},
    {"remove_keyframe": None},
    {"keyframe": None, "remove_keyframe": {"id": 5}},
    {"remove_keyframe": "zz"},
    {"remove_keyframe": {"id": "early", "idd": "s"}},
]
REFUSED_HERE = [
    ("moved", choreography.REJECTION_CODE_INVALID, "keyframe.time", -1),
    ("blank", choreography.REJECTION_CODE_INVALID, "keyframe.pose.rotations[1]", 160),
    ("blank", choreography.REJECTION_CODE_INVALID, "keyframe", -1),
    ("", choreography.REJECTION_CODE_INVALID, "keyframe.id", 160),
    ("", choreography.REJECTION_CODE_INVALID, "keyframe", -1),
    ("hurried", choreography.REJECTION_CODE_INVALID, "keyframe.tim", 15),
    ("twice", choreography.REJECTION_CODE_INVALID, "keyframe.time", -1),
    ("next", choreography.REJECTION_CODE_INVALID, "keyframe.pose", 45),
    ("after", choreography.REJECTION_CODE_INVALID, "keyframe.pose", 60),
    ("half \ufffd", choreography.REJECTION_CODE_INVALID, "keyframe.id", 160),
    ("far", choreography.REJECTION_CODE_INVALID, "keyframe.time", -1),
    ("turned", choreography.REJECTION_CODE_INVALID, "keyframe.pose.rotations[0]", 160),
    ("odd", choreography.REJECTION_CODE_INVALID, "keyframe.ti\ufffdme", 160),
    ("next", choreography.REJECTION_CODE_FROZEN, "", 50),
    ("nobody", choreography.REJECTION_CODE_INVALID, "remove_keyframe.id", -1),
    ("", choreography.REJECTION_CODE_INVALID, "keyframe", -1),
    ("", choreography.REJECTION_CODE_INVALID, "remove_keyframe", -1),
    ("", choreography.REJECTION_CODE_INVALID, "remove_keyframe.id", -1),
    ("", choreography.REJECTION_CODE_INVALID, "remove_keyframe", -1),
    ("early", choreography.REJECTION_CODE_INVALID, "remove_keyframe.idd", -1),
]


def edited(skeleton, frame_rate=0, go_on=None):
    """A dance to live music whose keys change on the way, one of them too late. Its last second waits for `go_on`."""
    yield {"config": choreography.DanceConfig(seed=5, audio_format=PCM, frames=180, frame_rate=frame_rate, generate_until=0, reject_invalid_keys=True)}

    def key(turn, **fields):
        return {"keyframe": choreography.Keyframe(pose=pose(skeleton, {"head": [0, turn, 0]}), **fields)}

    yield key(0.2, id="early", frame=30)
    yield key(0.4, id="next", interval_after_previous=20)
    bodiless = [{"keyframe": choreography.Keyframe(id="bodiless", frame=frame, pose={"rotations": [0.1]})} for frame in (20, 150)]
    late = [key(0.3, id="moved", time=4), key(0.3, id="late", frame=20), *bodiless, key(0.3, id="timeless", time=-1), *BAD_KEYS]
    said = {2: [key(0.1, id="moved", time=3.5)], 3: late}
    for piece in live(clicks(6), 1000):
        yield from said.pop(piece.first_sample / RATE, [])
        if go_on and piece.first_sample == 5 * RATE:
            go_on.wait()
        yield {"generate_until": {"frame": round(30 * piece.first_sample / RATE)}}
        yield {"audio": piece}
    yield {"end_of_audio": {}}
    yield {"keyframes_complete": {}}


def unkeyed(skeleton, go_on=None, **config):
    """A dance without keys, which has no continuation for seconds."""
    del skeleton
    yield {"config": choreography.DanceConfig(seed=9, audio_format=PCM, frames=90, generate_until=0, **config)}
    for piece in live(clicks(3), 1000):
        if go_on and piece.first_sample == 2 * RATE:
            go_on.wait()
        yield {"audio": piece}
        yield {"generate_until": {"frame": round(30 * piece.first_sample / RATE)}}


class ClientTest(unittest.TestCase):
    maxDiff = 2000

    def assert_refused(self, code, pattern, call, *arguments, **options):
        with self.assertRaisesRegex(ChoreoError, pattern) as raised:
            call(*arguments, **options)
        self.assertEqual(raised.exception.code, code, str(raised.exception))
        return raised.exception

    def test_a_pause_says_its_generate_until_again(self):
        def paused():
            yield {"config": {"frames": 60, "generate_until": 30}}
            for frame in (30, 30, 30, 60):
                yield {"generate_until": {"frame": frame}}

        with Client(os.environ["CHOREO_SERVER"]) as client:
            self.assertEqual(sum(answer.frames.count for answer in client.stream_dance(paused())), 60)

    def test_a_token_is_sent_and_read_again_and_a_wrong_one_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            tokens, mine = pathlib.Path(folder, "tokens"), pathlib.Path(folder, "mine")
            tokens.write_text(token_line("secret", "alice"))
            with Server("--tokens", tokens) as server:
                self.assert_refused("UNAUTHENTICATED", "^a token is needed; send the metadata", info, server.address)
                self.assert_refused("UNAUTHENTICATED", "^that token is unknown", info, server.address, token="guessed")
                self.assertTrue(info(server.address, token="secret").models)
                with Client(server.address, token_file=mine) as client:
                    self.assert_refused("INVALID_ARGUMENT", f"^token_file: no file {mine}$", client.info)
                    mine.write_text("guessed\n")
                    dance = lambda: list(client.stream_dance([{"config": {"frames": 30}}]))
                    self.assert_refused("UNAUTHENTICATED", "^that token is unknown", dance)
                    mine.write_text("secret\n")
                    self.assertTrue(dance()[-1].HasField("summary"))
                    request = choreography.GenerateTransitionRequest(config={}, frames=9)
                    self.assertTrue(list(client.generate_transition(request))[-1].HasField("summary"))

    def test_tls_with_authority_certificate_and_server_name(self):
        with tempfile.TemporaryDirectory() as folder:
            authority = Authority(folder)
            certificate, key = authority.issue("server", "DNS:choreod")
            own, own_key = authority.issue("client", "DNS:client")
            with Server("--tls-cert", certificate, "--tls-key", key, "--tls-client-ca", authority.certificate) as server:
                options = {"tls": True, "ca_certificate": authority.certificate, "server_name": "choreod"}
                both = options | {"client_certificate": own, "client_key": own_key}
                self.assertTrue(info(server.address, **both).models)
                texts = {name: pem.read_text() for name, pem in both.items() if isinstance(pem, pathlib.Path)}
                self.assertTrue(info(server.address, **(both | texts)).models)
                self.assert_refused("UNAVAILABLE", "the text is not that of its authority", info, server.address, **(both | texts | {"ca_certificate": texts["client_certificate"]}))
                for wrong in (options, both | {"ca_certificate": None}, both | {"server_name": None}):
                    self.assert_refused("UNAVAILABLE", f"^{server.address}: ", info, server.address, **wrong)
                self.assert_refused("UNAVAILABLE", f"^{server.address}: the server there wants TLS: set tls$", info, server.address)

    def test_what_only_other_options_can_mend_is_told_at_once_in_one_line(self):
        def refused(address, said, **options):
            self.assert_refused("UNAVAILABLE", f"^[^ ]*: {said}$", info, address, **{"retry_s": 3600, **options})

        with tempfile.TemporaryDirectory() as folder:
            authority = Authority(folder)
            certificate, key = authority.issue("server", "DNS:choreod")
            trusting = {"tls": True, "ca_certificate": authority.certificate}
            refused(OTHER, "the server there speaks no TLS: leave out tls", **trusting)
            with Server("--tls-cert", certificate, "--tls-key", key) as server:
                refused(server.address, "the server there wants TLS: set tls")
                untrusted = r"the server's certificate is not trusted \(.*\): name the PEM file of its authority \(ca_certificate\)"
                refused(server.address, untrusted, tls=True)
                wrong_name = "the server's certificate is of other names, not of elsewhere: say of which as server_name"
                for addresses in (server.address, [server.address, server.address]):
                    refused(addresses, wrong_name, server_name="elsewhere", **trusting)
                self.assertTrue(info(server.address, server_name="choreod", **trusting).models)
        with unittest.mock.patch("socket.getaddrinfo", side_effect=socket.gaierror(socket.EAI_NONAME, "not known")):
            refused("nobody.invalid:50051", r"no host of that name is known \(addresses\)")

    def test_options_that_cannot_be_used_are_named(self):
        with tempfile.TemporaryDirectory() as folder:
            authority = Authority(folder)
            own, own_key = authority.issue("client", "DNS:client")
            far, absent = "192.0.2.1:50051", pathlib.Path(folder, "absent")
            for addresses, options, message in (
                ([], {}, "addresses: none is given$"),
                ("localhost:70000", {}, r"addresses: localhost:70000: port 70000 is not in \[1, 65535\]$"),
                (far, {"token": "secret"}, f"token: a token is sent to {far} only over TLS$"),
                (f"ipv4:127.0.0.1:1,{far}", {"token": "secret"}, "token: a token is sent to ipv4:.* only over TLS$"),
                (far, {"tls": True, "token": "two words"}, "token: it is not one line of visible ASCII characters$"),
                (far, {"ca_certificate": own}, f'ca_certificate: "{own}" needs TLS, which is off$'),
                (far, {"tls": True, "ca_certificate": absent}, f"ca_certificate: no file {absent}$"),
                (far, {"tls": True, "client_key": own_key}, "client_certificate: missing; a certificate and its key go together$"),
                (far, {"tls": True, "ca_certificate": own_key}, f"ca_certificate: {own_key} holds no certificate in PEM"),
                (far, {"tls": True, "client_certificate": own, "client_key": authority.key}, f"client_key: {authority.key} is not the key of {own}"),
                (far, {"silence_s": 1}, "silence_s: 1 s is neither 0 nor at least 2 s$"),
                ("http://one:50051", {}, "addresses: http://one:50051 is a URL; use HOST:PORT, and the option tls for TLS$"),
                ("dns:///one", {}, "addresses: dns:///one has no port; use HOST:PORT$"),
                (far, {"tls": True, "token": "secret\n"}, "token: it begins or ends with spaces or a newline; strip it$"),
                (far, {"tls": True, "token": b"secret"}, "token: a bytes is not a str$"),
                (far, {"ca_certificate": own.read_text()}, 'ca_certificate: "the text" needs TLS, which is off$'),
                (far, {"tls": True, "ca_certificate": own_key.read_text()}, "ca_certificate: the text holds no certificate in PEM"),
                (far, {"tls": True, "client_certificate": own.read_text(), "client_key": authority.key.read_text()}, "client_key: the text is not the key of the text"),
                (far, {"retry_s": "long"}, "retry_s: a str is not a number$"),
                (far, {"tsl": True}, r"tsl: no option; did you mean tls\?$"),
                (far, {"patience": 1}, "patience: no option; there are tls, ca_certificate, "),
                (far, {"tls": "yes"}, "tls: a str is not a bool$"),
                (far, {"connect_timeout_s": 0}, "connect_timeout_s: 0 s leave no time to connect$"),
                (far, {"retry_s": -1}, "retry_s: -1 is not a finite number >= 0$"),
            ):
                self.assert_refused("INVALID_ARGUMENT", "^" + message, Client, addresses, **options)

    def test_a_dance_goes_on_where_its_server_is_killed_bit_for_bit(self):
        for rate in (30, 50):
            with self.subTest(rate=rate):

                def source(skeleton, go_on=None):
                    return edited(skeleton, rate, go_on)

                def is_time(answers):
                    continuations = sum(answer.HasField("continuation") for answer in answers)
                    return continuations > 1 and answers[-1].frames.first_frame > 3.5 * rate

                whole = undisturbed(source)
                events = [answer.event for answer in whole if answer.event.HasField("keyframe_rejected")]
                self.assertEqual(
                    [(event.keyframe_rejected.id, event.keyframe_rejected.code, event.keyframe_rejected.field, event.frame) for event in events],
                    [
                        ("late", choreography.REJECTION_CODE_TOO_LATE, "", 20),
                        ("bodiless", choreography.REJECTION_CODE_INVALID, "keyframe.pose.rotations", 20),
                        ("bodiless", choreography.REJECTION_CODE_INVALID, "keyframe.pose.rotations", 150),
                        ("timeless", choreography.REJECTION_CODE_INVALID, "keyframe.time", -1),
                        *REFUSED_HERE,
                    ],
                )
                reasons = [event.keyframe_rejected.reason for event in events[-len(REFUSED_HERE) :]]
                for reason, pattern in zip(reasons, ("'soon' is not a finite", "nan is not a finite", "none of frame, time", "5 is not a str", "'wave' is not a Keyframe")):
                    self.assertRegex(reason, f"^{pattern}")
                answers, resumes = dance_and_kill(source, is_time)
                ((address, exact, code),) = [(resumed.address, resumed.exact, resumed.because.code) for resumed in resumes]
                self.assertEqual((address, exact, code), (OTHER, True, "UNAVAILABLE"))
                self.assertGreater(resumes[0].frame, 3.5 * rate)
                self.assertEqual(told(answers), told(whole))

    def test_a_dance_whose_server_is_killed_before_its_first_continuation_goes_on(self):
        answers, resumes = dance_and_kill(unkeyed, lambda answers: answers[-1].HasField("frames"))
        self.assertEqual(len(resumes), 1)
        self.assertEqual(told(answers), told(undisturbed(unkeyed)))

    def test_the_log_of_a_server_that_goes_on_with_a_dance_names_the_call_in_which_it_began(self):
        with Server() as heir:
            dance_and_kill(unkeyed, lambda answers: answers[-1].HasField("frames"), heir.address)
            while " from " not in heir.log():
                time.sleep(0.005)
            (first,) = re.findall("resumes stream ([0-9a-f]{16}) at frame 0", heir.log())
            self.assertRegex(heir.log(), f" stream [0-9a-f]{{16}} from {first}: OK")

    def test_before_its_first_continuation_a_dance_begins_anew_on_another_fingerprint_where_that_is_allowed(self):
        with Server(FAKE_FINGERPRINT="another") as other:

            def lose(allowed, **options):
                source = functools.partial(unkeyed, allow_inexact_resume=allowed)
                return dance_and_kill(source, lambda answers: answers[-1].HasField("frames"), other.address, **options)

            answers, resumes = lose(True)
            self.assertEqual(told(answers)["frames"], (0, 90))
            self.assertEqual([resumed.exact for resumed in resumes], [False])
            what = 'begun by ".*"; .* has "another", which config.allow_inexact_resume would let go on$'
            error = self.assert_refused("FAILED_PRECONDITION", f"^config.continuation.fingerprint: {what}", lose, False, retry_s=0.5)
            self.assertEqual(error.violations[0].field, "config.continuation.fingerprint")
            self.assertRegex(error.violations[0].description, "^" + what)

    def test_calls_wait_for_a_server_and_give_up_in_time(self):
        error = self.assert_refused("UNAVAILABLE", "^127.0.0.1:1: no server can be reached: connection refused$", info, "127.0.0.1:1", retry_s=0.3)
        self.assert_refused("UNAVAILABLE", "^127.0.0.1:1, 127.0.0.1:2: no server can be reached: connection refused$", info, ["127.0.0.1:1", "127.0.0.1:2"], retry_s=0.3)
        self.assertEqual(error.violations, [])
        begun = time.monotonic()
        with Client("127.0.0.1:1", retry_s=60) as client:
            answers = client.stream_dance([{"config": {}}])
            threading.Timer(0.2, answers.cancel).start()
            self.assert_refused("CANCELLED", "", list, answers)
        self.assertLess(time.monotonic() - begun, 30)
        with Client(["127.0.0.1:1", OTHER]) as client:
            request = choreography.GenerateTransitionRequest(config={"seed": 3}, frames=20, candidates=2)
            blocks = [answer.frames.count for answer in client.generate_transition(request)]
            self.assertEqual(sum(blocks), 40)

    def test_calls_take_turns_at_the_addresses_of_a_list(self):
        def silence():
            yield {"config": {"audio_format": PCM}}
            stop.wait()

        stop = threading.Event()
        with Server() as one, Client(f"ipv4:{one.address},{OTHER}") as client:
            dances = []
            # Connections are made one after the other: turns are taken once both are there.
            while not all(info(address).active_streams for address in (one.address, OTHER)):
                self.assertLess(len(dances), 40, "all calls went to one server")
                dances.append(client.stream_dance(silence()))
                next(dances[-1])
            for dance in dances:
                dance.cancel()
                self.assert_refused("CANCELLED", "", list, dance)
            stop.set()

    def test_a_server_that_drains_is_looked_at_by_who_says_so(self):
        def silence():
            yield {"config": {"audio_format": PCM}}
            stop.wait()

        stop = threading.Event()
        with Server() as server, Client(server.address) as client, client.stream_dance(silence()) as dance:
            next(dance)
            server.drain()
            try:
                while info(server.address).models:  # as long as it has not heard of it
                    time.sleep(0.02)
            except ChoreoError as error:
                self.assertEqual(error.code, "UNAVAILABLE")
            told = info(server.address, even_draining=True)
            self.assertTrue(told.models and told.draining)
            # The next server is tried at once, and a refusal says why.
            with Client(server.address, even_draining=True, retry_s=0) as other:
                error = self.assert_refused("UNAVAILABLE", "draining", list, other.stream_dance([{"config": {"frames": 30}}]))
            self.assertEqual(error.reason, "DRAINING")
            patience = Patience(Options(first_backoff_s=2), Cancellation(), 2)
            self.assertEqual(patience.next(error, True, "a:1"), 0)
            self.assertGreater(patience.next(error, True, "b:1"), 0, "both drain")
            passed = self.assert_refused("UNAVAILABLE", f"^{server.address}: the server takes no calls: it drains, or ", info, server.address)
            patience.reset()
            self.assertEqual(patience.next(passed, True, "a:1"), 0)
            alone = Patience(Options(), Cancellation(), 1)
            alone.next(error, False, "a:1")
            gone = ChoreoError("UNAVAILABLE", "no server can be reached: connection refused")
            gone.is_away = True
            alone.next(gone, False, "a:1")
            self.assertIs(alone.verdict, error, "why it is gone")
            stop.set()

    def test_a_full_server_that_asks_to_wait_longer_than_a_call_tries_is_asked_once(self):
        def silence():
            yield {"config": {"audio_format": PCM}}
            stop.wait()

        stop = threading.Event()
        with Server("--max-streams", 1) as server, Client(server.address) as holder, holder.stream_dance(silence()) as dance:
            next(dance)
            with Client(server.address, retry_s=0.5) as client:
                error = self.assert_refused("RESOURCE_EXHAUSTED", "", list, client.stream_dance([{"config": {"frames": 30}}]))
            self.assertGreater(error.retry_after, 0.5)
            info(server.address)
            refused = lambda: len(re.findall("StreamDance .*RESOURCE_EXHAUSTED", server.log()))
            while "GetServerInfo" not in server.log() or not refused():  # each line comes when it may
                time.sleep(0.02)
            self.assertEqual(refused(), 1)
            stop.set()

    def test_who_reads_too_slowly_is_told_the_limit(self):
        with Server("--unread-seconds", 0.5, "--outbox-kib", 16) as server, Client(server.address) as client:
            with client.stream_dance([{"config": {"frames": 60000}}]) as dance:
                next(dance)
                while "DEADLINE_EXCEEDED" not in server.log():
                    time.sleep(0.02)
                with self.assertRaisesRegex(ChoreoError, r"limits\.unread_s \(--unread-seconds\): read faster, or resume") as raised:
                    list(dance)
        self.assertEqual(raised.exception.code, "DEADLINE_EXCEEDED")

    def test_a_mistake_in_the_requests_ends_the_call_with_that_mistake(self):
        def requests():
            yield {"config": {"audio_format": PCM}}
            raise OSError("the microphone is gone")

        with Client(OTHER) as client:
            with self.assertRaisesRegex(OSError, "the microphone is gone"):
                list(client.stream_dance(requests()))
