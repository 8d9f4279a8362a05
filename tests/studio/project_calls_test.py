#!/usr/bin/python3
"""POST /dance and GET /model of the studio that $CHOREO_STUDIO names, as any program asks them."""

import base64
import http.client
import io
import json
import math
import os
import struct
import threading
import unittest
import urllib.parse
import wave

PLACE = urllib.parse.urlparse(os.environ["CHOREO_STUDIO"])
REST = [[0, 0, 0]] * 24
JSON = {"Content-Type": "application/json"}


def ask(method, path, body=None, headers=None):
    connection = http.client.HTTPConnection(PLACE.hostname, PLACE.port, timeout=120)
    try:
        connection.request(method, path, body, JSON if headers is None else headers)
        answer = connection.getresponse()
        return answer.status, answer.read().decode()
    finally:
        connection.close()


def dance(call="/dance", **changes):
    project = {"studio": 1, "seconds": 2, "keyframes": [{"id": "a", "time": 1, "rotations": REST, "root_position": [0.5, 0.9, 0]}]}
    project.update(changes)
    return ask("POST", call, json.dumps({name: value for name, value in project.items() if value is not None}))


def clicks(seconds, channels=(1,)):
    out = io.BytesIO()
    with wave.open(out, "wb") as file:
        file.setparams((len(channels), 2, 22050, 0, "NONE", ""))
        tones = (20000 * math.exp(-(i % 11025) / 200) * math.sin(i % 11025 / 2) for i in range(seconds * 22050))
        file.writeframes(b"".join(struct.pack("<h", int(tone) * sign) for tone in tones for sign in channels))
    return base64.b64encode(out.getvalue()).decode()


class ProjectCalls(unittest.TestCase):
    def refused(self, answer, status, words):
        self.assertEqual(answer[0], status, answer[1])
        self.assertIn(words, json.loads(answer[1])["error"])

    def test_the_model(self):
        status, text = ask("GET", "/model")
        model = json.loads(text)
        self.assertEqual(status, 200)
        self.assertEqual((len(model["joints"]), len(model["parents"]), len(model["offsets"])), (24, 24, 24))
        self.assertEqual(model["styles"], ["calm", "wild"])
        self.assertEqual(model["most_seconds"], 600)
        self.assertAlmostEqual(model["pelvis_height"], 0.94, delta=0.05)

    def test_of_several_dancers_it_is_the_dance_that_they_share(self):
        status, text = dance(dancers=[{"place": [0, 0]}, {"place": [2, 0], "mirrored": True}])
        self.assertEqual(status, 200, text)
        self.assertEqual(json.loads(text)["warnings"][-1]["message"], "dancers: this is the dance that they share")
        self.assertEqual(json.loads(text)["rotations"], json.loads(dance()[1])["rotations"])

    def test_a_project_is_danced_through_its_key(self):
        status, text = dance()
        self.assertEqual(status, 200, text)
        made = json.loads(text)
        self.assertEqual(made["frame_rate"], 30)
        self.assertEqual(len(made["root_positions"]), 60)
        self.assertEqual([len(frame) for frame in made["rotations"]], [24] * 60)
        self.assertLess(math.dist(made["root_positions"][30], (0.5, 0.9, 0)), 0.002)
        self.assertLess(max(abs(value) for joint in made["rotations"][30] for value in joint), 0.01)
        self.assertEqual(dance()[1], text)
        self.assertNotEqual(dance(seed=9)[1], text)
        self.assertNotEqual(dance(style="wild")[1], text)
        self.assertNotEqual(dance(lively={"left arm": 2})[1], text)

    def test_without_keys_it_is_danced_freely(self):
        status, text = dance(keyframes=[])
        self.assertEqual(status, 200, text)
        self.assertEqual(len(json.loads(text)["root_positions"]), 60)

    def test_an_impossible_key_is_told(self):
        sunk = {"id": "sunk", "time": 1, "rotations": REST, "root_position": [0, 0.2, 0]}
        warnings = json.loads(dance(keyframes=[sunk])[1])["warnings"]
        self.assertTrue(any(told["frame"] == 30 and "sunk" in told["message"] for told in warnings), warnings)

    def test_a_key_at_the_very_end_is_on_the_last_frame(self):
        key = {"id": "last", "rotations": REST, "root_position": [0.5, 0.9, 0]}
        status, text = dance(keyframes=[{**key, "time": 2}])
        self.assertEqual(status, 200, text)
        self.assertLess(math.dist(json.loads(text)["root_positions"][59], (0.5, 0.9, 0)), 0.002)
        self.refused(dance(keyframes=[{**key, "time": 2.1}]), 400, "project:keyframes[0].time")

    def test_as_bvh(self):
        status, text = dance("/dance?as=bvh")
        self.assertEqual(status, 200)
        self.assertTrue(text.startswith("HIERARCHY\nROOT pelvis\n"), text[:40])
        self.assertIn("\nFrames: 60\n", text)

    def test_a_song_gives_length_and_music(self):
        status, text = dance(song="clicks.wav", song_data=clicks(3), seconds=None)
        self.assertEqual(status, 200, text)
        self.assertEqual(len(json.loads(text)["root_positions"]), 90)
        silent = json.loads(dance(seconds=3)[1])["rotations"]
        self.assertNotEqual(json.loads(text)["rotations"], silent)
        self.assertEqual(len(json.loads(dance(song="c.wav", song_data=clicks(3), seconds=2)[1])["rotations"]), 60)
    def test_what_is_noted_about_a_song_is_told(self):
        status, text = dance(song="c.wav", song_data=clicks(2, (1, -1)), beats=[[0.5, 1], [1, 2], [9, 3]])
        self.assertEqual(status, 200, text)
        beats, song = json.loads(text)["notes"]
        self.assertEqual(beats, "project:beats: 1 beat is left out, behind the end of the song at 2 s")
        self.assertTrue(song.startswith("c.wav: ") and "cancel" in song, song)
        self.assertEqual(json.loads(dance()[1])["notes"], [])

    def test_beats_of_a_project_are_danced_on(self):
        song = {"song": "clicks.wav", "song_data": clicks(3), "seconds": None}
        heard, said = dance(**song), dance(**song, beats=[[0.3, 1], [1.1, 2], [1.9, 3]], bar=4)
        self.assertEqual((heard[0], said[0]), (200, 200), said[1])
        self.assertNotEqual(heard[1], said[1])

    def test_what_cannot_be_is_named(self):
        key = {"id": "a", "time": 1, "rotations": REST}
        for changes, words in (
            ({"keyframes": None}, 'project: has no list "keyframes"'),
            ({"keyframes": [{**key, "time": 5}]}, "keyframes[0]"),
            ({"keyframes": [{"time": 1, "pose": "star_jump", "place": [0, 0], "hold": 0.9}]}, 'project:keyframes[0].hold: key "key1": the body is'),
            ({"seconds": None}, "project:seconds: is missing, and there is no song"),
            ({"seconds": 601}, "project:seconds: 601 is beyond 600, the longest allowed"),
            ({"style": "foxtrot"}, 'project:style: "foxtrot"'),
            ({"path": {"points": [{"time": 9, "x": 0, "z": 0}, {"time": 10, "x": 1, "z": 0}]}}, "project:path:points[0]: the first point at 9 s"),
            ({"path": {"points": [{"time": 0, "x": 0, "z": 0}, {"time": 1, "x": 2e4, "z": 0}]}}, "project:path:points[1].x"),
            ({"beats": [[0.5, 1]]}, "project:beats: need a song"),
            ({"song": "a.wav", "song_data": clicks(1), "beats": [[0.5, 1], [0.505, 2]]}, "project:beats[1]: is 0.005 s after the beat before it"),
            ({"song": "a.wav", "song_data": clicks(1), "beats": [[100, 1], [101, 2]]}, "project:beats: has no beat within the part of the song that is heard, its first 1 s"),
            ({"song": "a.wav"}, "project:song_data: is missing beside song"),
            ({"song_data": "AAAA"}, "project:song: is missing beside song_data"),
            ({"song": "a.wav", "song_data": "?!"}, "project:song_data: is not base64"),
            ({"song": "a.wav", "song_data": 7}, "project:song_data: is not a text"),
            ({"song": "a.wav", "song_data": "AAAA"}, "a.wav: "),
            ({"song": "../../etc/passwd", "song_data": ""}, "passwd"),
        ):
            with self.subTest(words):
                self.refused(dance(**changes), 400, words)
        self.refused(ask("POST", "/dance", "{"), 400, "project")
        self.refused(ask("POST", "/dance", b"\xff\xfe"), 400, "project")
        self.refused(ask("POST", "/dance", "[" * 100000), 400, "project")
        self.refused(ask("POST", "/dance", ""), 400, "project")
        self.refused(ask("POST", "/dance?as=fbx", "{}"), 400, "as: must be json or bvh")
        self.refused(ask("GET", "/dance"), 405, "POST a project")
        self.refused(ask("POST", "/dance", "{}", {"Content-Type": "text/plain"}), 415, "application/json")
        self.assertEqual(ask("POST", "/model", "{}")[0], 405)

    def test_it_is_for_no_page_from_elsewhere(self):
        self.assertEqual(ask("POST", "/dance", "{}", {**JSON, "Origin": "http://elsewhere.example"})[0], 403)
        self.assertEqual(ask("POST", "/dance", "{}", {**JSON, "Host": "elsewhere.example"})[0], 403)

    def test_what_is_too_large_is_refused_before_it_is_read(self):
        connection = http.client.HTTPConnection(PLACE.hostname, PLACE.port, timeout=30)
        connection.putrequest("POST", "/dance")
        connection.putheader("Content-Type", "application/json")
        connection.putheader("Content-Length", str(1 << 40))
        connection.endheaders()
        answer = connection.getresponse()
        self.assertEqual(answer.status, 413)
        self.assertIn("larger than 67108864 bytes", json.loads(answer.read())["error"])
        connection.close()

    def test_many_at_once_are_served_or_sent_away(self):
        answers = []
        threads = [threading.Thread(target=lambda: answers.append(dance(seconds=20))) for _ in range(12)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertLessEqual({status for status, _ in answers}, {200, 503})
        self.assertEqual(len({text for status, text in answers if status == 200}), 1)
        self.assertEqual(dance()[0], 200)


if __name__ == "__main__":
    unittest.main()
