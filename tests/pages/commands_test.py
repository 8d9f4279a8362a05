#!/usr/bin/python3
"""Runs the commands of all pages: fences of `sh`, and those without a language whose first word is a program. Each page has a folder of its
own, in which its blocks run one after the other, as somebody does who follows it. stand_in.py says what of it doesn't run, and why.
    with_server.sh CHOREOD with_studio.sh CHOREO commands_test.py BIN_DIRECTORY [PAGE...]
"""

import json
import math
import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import wave

from pages import ROOT, fences, pages, without_fences

try:
    import numpy
except ImportError:
    print("skipped: there is no numpy here (scripts/install_packages.sh test)")
    sys.exit(int(os.environ.get("CHOREO_SKIP_CODE", 77)))

STAND_IN = pathlib.Path(__file__).resolve().parent / "stand_in.py"
PROGRAMS = "choreo choreod choreo-lab make cmake docker node npm npx python3 curl".split()
ORDINARY = "cd cp mkdir token= scripts/ tests/ ./ build/ /usr/bin/python3".split()
# Whose options are not ours, though pages name them.
OTHERS = ("beats_bench", "bench/live.py", "ctest", "engine_bench", "fit_test", "load ", "npm", "perf", "soak")
SECONDS = 16  # of the song: pages dance to a part of it


def commands(page):
    """(line number, script) of each block."""
    for number, language, lines in fences((ROOT / page).read_text()):
        first = (lines or [""])[0].split(" ")[0]
        if language == "sh" or (not language and (first in PROGRAMS or first.startswith(tuple(ORDINARY)))):
            yield number, "\n".join(lines)


def write_song(path):
    """Clicks at 120 a minute. Named as pages name it: what it is, is told from what is in it."""
    rate = 22050
    samples = bytearray()
    for at in range(SECONDS * rate):
        since = at % (rate // 2)
        loud = math.exp(-since / 400) * math.sin(2 * math.pi * 900 * since / rate) if since < 4000 else 0
        samples += struct.pack("<h", int(20000 * loud))
    with wave.open(str(path), "wb") as file:
        file.setnchannels(1)
        file.setsampwidth(2)
        file.setframerate(rate)
        file.writeframes(samples)


def landmarks():
    """Somebody who stands, as MediaPipe sees people: x to the right of the picture, y down, metres from the hips."""
    places = [(0.0, -0.6)] * 11 + [(0.18, -0.48), (-0.18, -0.48), (0.25, -0.22), (-0.25, -0.22), (0.27, 0.0), (-0.27, 0.0)]
    places += [(0.28, 0.08), (-0.28, 0.08)] * 3 + [(0.1, 0.0), (-0.1, 0.0), (0.11, 0.4), (-0.11, 0.4), (0.12, 0.8), (-0.12, 0.8)]
    places += [(0.12, 0.83), (-0.12, 0.83), (0.14, 0.84), (-0.14, 0.84)]
    toes = (31, 32)
    return [{"x": x, "y": y, "z": -0.12 if at in toes else 0.0, "visibility": 0.9} for at, (x, y) in enumerate(places)]


class Reader:
    """A folder that looks like the repository after `make build`, with files of one's own in it."""

    def __init__(self, folder, made):
        self.folder = folder
        shutil.copytree(made, folder, dirs_exist_ok=True)
        for name in ("client/node", "client/python", "docker", "examples", "proto"):
            shutil.copytree(ROOT / name, folder / name, ignore=shutil.ignore_patterns("node_modules"))
        for name in ("model/checkpoints", "tests/proto", "build/release/bin", "build/example", "models", "docs/images"):
            (folder / name).mkdir(parents=True, exist_ok=True)
        for name in PROGRAMS:
            (folder / "build/release/bin" / name).symlink_to(STAND_IN)
        (folder / "build/example/first_dance").symlink_to(STAND_IN)
        for group in ("scripts", "tests"):
            for script in [*(ROOT / group).rglob("*.sh"), *(ROOT / group).glob("quote_figures.py")]:
                stand_in = folder / script.relative_to(ROOT)
                stand_in.parent.mkdir(parents=True, exist_ok=True)
                stand_in.symlink_to(STAND_IN)
        # README.md goes into the folder of programs.
        shutil.copy(folder / "song.mp3", folder / "build/release/bin")

    def gets(self, page):
        """Models that a page has by now."""
        for name in set(re.findall(r"[\w./]+\.safetensors", "\n".join(script for _, script in commands(page)))):
            model = self.folder / name
            if not model.exists() and not model.name.startswith("."):
                model.parent.mkdir(parents=True, exist_ok=True)
                model.symlink_to(ROOT / "model/checkpoints/default.safetensors")

    def runs(self, page, script):
        inside = self.folder / pathlib.Path(page).parent if page.startswith("examples/") else self.folder
        path = f"{self.folder / 'build/release/bin'}:{os.environ['PATH']}"
        return subprocess.run(["bash", "-euo", "pipefail", "-c", script.replace("/usr/bin/python3", "python3")], cwd=inside, check=False,
                              env=os.environ | {"PATH": path}, capture_output=True, text=True, timeout=300)


class CommandsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.made = made = pathlib.Path(cls.scratch.name) / "made"
        made.mkdir()
        for name in ("song.mp3", "song.ogg"):
            write_song(made / name)
        sound = struct.pack("<44100f", *(math.sin(0.1 * at) for at in range(44100)))
        (made / "sound.raw").write_bytes(10 * sound)
        (made / "alsa.conf").write_text('pcm.nothing { type null }\npcm.!default { type file slave.pcm nothing file /dev/null format raw infile "'
                                        f'{made / "sound.raw"}" }}\n')
        os.environ |= {"ALSA_CONFIG_PATH": str(made / "alsa.conf"), "CHOREO_ROOT": str(ROOT), "CHOREO_BIN": str(BIN)}
        (made / "seen.json").write_text(json.dumps(landmarks()))
        key = {"studio": 1, "seconds": 4, "style": "happy", "keyframes": [{"time": 2, "pose": "kick"}]}
        (made / "keys.json").write_text(json.dumps(key))
        (made / "project.json").write_text(json.dumps(key | {"song": "song.mp3", "markers": [{"time": 1, "name": "verse"}]}))
        (made / "out.map.json").write_text('{"bones": {"pelvis": "pelvis"}}')
        for take in ("walk1", "run1", "sprint1"):
            (made / "lafan1").mkdir(exist_ok=True)
            (made / f"lafan1/{take}.bvh").touch()
        numpy.savez(made / "seen.npz", poses=numpy.zeros((1, 72)))
        for out in (made / "dance.npz", made / "hero.glb", made / "walk.bvh"):
            subprocess.run([BIN / "choreo", "dance", made / "song.mp3", "--seconds", "5", "--out", out, "--report", made / "report.json"], check=True, capture_output=True)

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def test_they_run(self):
        for page in PAGES:
            blocks = list(commands(page))
            if not blocks:
                continue
            reader = Reader(pathlib.Path(self.scratch.name) / page.replace("/", "_"), self.made)
            reader.gets(page)
            begun = time.monotonic()
            for number, script in blocks:
                with self.subTest(page=f"{page}:{number}"):
                    done = reader.runs(page, script)
                    self.assertEqual(done.returncode, 0, f"{script}\n{done.stdout[-1000:]}{done.stderr[-1000:]}")
            print(f"{page}: {len(blocks)} blocks, {time.monotonic() - begun:.1f} s", flush=True)

    def test_options_in_the_text_exist(self):
        """Those in `code` between the commands, of whichever program."""
        helps = [subprocess.run([BIN / "choreod", "--help"], capture_output=True, text=True, check=True).stdout]
        for program in ("choreo", "choreo-lab"):
            said = subprocess.run([BIN / program, "--help"], capture_output=True, text=True, check=True).stdout
            for name in re.findall(r"^  (\w+)  ", said[said.index("Subcommands:"):], flags=re.M):
                helps.append(subprocess.run([BIN / program, name, "--help"], capture_output=True, text=True, check=True).stdout)
        known = set(re.findall(r"--[a-z][\w-]*", "".join(helps)))
        for page in PAGES:
            for code in re.findall(r"`([^`\n]+)`", without_fences((ROOT / page).read_text())):
                if not code.startswith(OTHERS):
                    for option in re.findall(r"(?<![\w-])--[a-z][\w-]*", code):
                        with self.subTest(page=page, code=code):
                            self.assertTrue(option in known, "no program has it")


BIN = pathlib.Path(sys.argv.pop(1)).resolve()
PAGES = sys.argv[1:] or pages()
unittest.main(argv=sys.argv[:1])
