#!/usr/bin/python3
"""Measures live dances: starts a choreod and prints up to five tables.

    live.py BIN_DIRECTORY [--songs SONG...] [--tables beats songs latency crowd notice] [--data FOLDER --splits JSON] [--seconds 40]

beats: how often dancers hit the beats of songs that are sent as PCM, whose beats are predicted while they play, against the same
songs sent as files. A dancer's beats are the maxima of the mean joint speed, as in the server's report. Both are scored, from second 10 on,
by the tempo map beside the song (SONG.beats, seconds, one a line), or where there is none by what the server found in the file; and
each by the beats that its own server told it. Chance is what the live dances hit of beats that are shifted by a random time. Songs are
heard from their second 30 on.

songs: how far apart two live dances are, that differ in their song alone: the mean distance of the joints, over all pairs of songs.

latency: keys each 1, 2, 4 s come 3 s ahead and are changed 1 s ahead, and music plays in real time, in pieces of 0.1 s; frames are
granted as far ahead of what plays as the table says. Lateness is behind the piece that holds the sample a frame needs.

crowd: so many such dances at once, all in this process, on the cores that the server has; how many are refused at once, and what share
of the others' frames is more than 0.1 s late.

notice: what it costs that keys come late (live_notice.py), on clips that choreo-lab prepared, as /recordings/dancedb; only with --data.
"""
import argparse
import itertools
import json
import pathlib
import queue
import random
import subprocess
import sys
import threading
import time

import numpy

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT / "client" / "python"), str(ROOT / "examples" / "python")]
from choreo_client import ChoreoError, Client, choreography  # noqa: E402
from live_notice import notice_table  # noqa: E402
from music import PCM, RATE, clicks  # noqa: E402

FPS = 30
FROM_SECOND = 10  # the tracker has locked by then
SKIPPED = 30  # of each song: many begin softly
TABLES = ["beats", "songs", "latency", "crowd", "notice"]
CROWDS = [8, 56]
POSES = sorted((ROOT / "client" / "poses").glob("*.json"))


class Server:
    """A choreod for this run."""

    def __init__(self, program):
        self.process = subprocess.Popen([program, "--listen", "127.0.0.1:0", "--log-level", "warning"], stdout=subprocess.PIPE, text=True)
        address = self.process.stdout.readline().split()[-1]
        self.client = Client(address, retry_s=0)  # those refused are counted
        self.skeleton = self.client.info().models[0].skeleton

    def close(self):
        self.process.terminate()
        self.process.wait()


def samples_of(song, seconds):
    """Mono 16-bit samples from the song's second SKIPPED on, as bytes."""
    command = ["ffmpeg", "-v", "error", "-ss", str(SKIPPED), "-i", song, "-t", str(seconds), "-ac", "1", "-ar", str(RATE), "-f", "s16le", "-"]
    return subprocess.run(command, check=True, capture_output=True).stdout


def wav(samples):
    head = b"RIFF" + (36 + len(samples)).to_bytes(4, "little") + b"WAVEfmt " + (16).to_bytes(4, "little")
    head += (1).to_bytes(2, "little") * 2 + RATE.to_bytes(4, "little") + (2 * RATE).to_bytes(4, "little")
    return head + (2).to_bytes(2, "little") + (16).to_bytes(2, "little") + b"data" + len(samples).to_bytes(4, "little") + samples


def key(number, frame):
    first = json.loads(POSES[number % len(POSES)].read_text())["keyframes"][0]
    x, y, z = first["root_position"]
    pose = choreography.Pose(root_position=choreography.Vector3(x=x, y=y, z=z), rotations=[value for joint in first["rotations"] for value in joint])
    return choreography.Keyframe(id=str(frame), frame=frame, pose=pose)


# ------------------------------------------------------------------------------------------------------------------ beats


def dance(server, audio_format, music, seconds, seed, keyed):
    """[frames, joints, 3] places, and the Beat events."""

    def requests():
        frames = round(seconds * FPS)
        yield {"config": choreography.DanceConfig(seed=seed, frames=frames, audio_format=audio_format)}
        for frame in range(60, frames if keyed else 0, 60):
            yield {"keyframe": key(frame // 60, frame - 1)}
        yield {"keyframes_complete": choreography.KeyframesComplete()}
        unit = 1 if audio_format.encoding == choreography.AUDIO_ENCODING_FILE else 2
        for start in range(0, len(music), 1 << 16):
            yield {"audio": choreography.Audio(data=music[start : start + (1 << 16)], first_sample=start // unit)}
        yield {"end_of_audio": choreography.EndOfAudio()}

    roots, rotations, beats = [], [], []
    for answer in server.client.stream_dance(requests()):
        roots += answer.frames.root_positions
        rotations += answer.frames.rotations
        if answer.event.HasField("beat"):
            beats.append((answer.event.time, answer.event.beat.source))
    return places(server.skeleton, numpy.array(roots).reshape(-1, 3), numpy.array(rotations).reshape(-1, len(server.skeleton.parents), 3)), beats


def places(skeleton, roots, rotations):
    angle = numpy.maximum(numpy.linalg.norm(rotations, axis=-1), 1e-12)[..., None, None]
    x, y, z = numpy.moveaxis(rotations / angle[..., 0], -1, 0)
    zero = numpy.zeros_like(x)
    cross = numpy.stack([zero, -z, y, z, zero, -x, -y, x, zero], -1).reshape(*x.shape, 3, 3)
    local = numpy.eye(3) + numpy.sin(angle) * cross + (1 - numpy.cos(angle)) * cross @ cross
    offsets = numpy.array(skeleton.offsets).reshape(-1, 3)
    world, at = [local[:, 0]], [roots]
    for joint, parent in list(enumerate(skeleton.parents))[1:]:
        at.append(at[parent] + world[parent] @ offsets[joint])
        world.append(world[parent] @ local[:, joint])
    return numpy.stack(at, 1)


def dancers_beats(joints):
    speed = numpy.linalg.norm(numpy.diff(joints, axis=0), axis=-1).mean(1)
    window = numpy.exp(-0.5 * (numpy.arange(-10, 11) / (FPS / 12)) ** 2)
    speed = numpy.convolve(numpy.pad(speed, 10, mode="edge"), window / window.sum(), mode="valid")
    peak = (speed[1:-1] > speed[:-2]) & (speed[1:-1] > speed[2:])
    return numpy.flatnonzero(peak) + 2


def hits(own, beats):
    """The share of `own` (frames) with one of `beats` (seconds) at most two frames away."""
    if len(beats) == 0:
        return 0
    own = own[(own >= FROM_SECOND * FPS) & (own <= beats[-1] * FPS)]
    return numpy.mean([min(abs(beat * FPS - frame) for beat in beats) <= 2 for frame in own])


def f_measure(found, wanted):
    found = [beat for beat in found if beat >= FROM_SECOND]
    wanted = [beat for beat in wanted if beat >= FROM_SECOND]
    met = sum(1 for beat in found if min(abs(beat - other) for other in wanted) <= 0.07)
    return 2 * min(met, len(wanted)) / (len(found) + len(wanted))


def tempo_map(song, shift, seconds):
    """The beats in SONG.beats beside the song, or None."""
    file = pathlib.Path(song).with_suffix(".beats")
    if not file.exists():
        return None
    beats = numpy.array([float(line) for line in file.read_text().split()]) + shift - SKIPPED
    return beats[(beats >= 0) & (beats < seconds)]


def beats_table(server, songs, seconds, shift):
    print("\n| song, dances | hits, sent as file | live | live / file | chance | own beats hit, file | live | F of the beats, file | live | heard |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    generator = random.Random(1)
    for song in songs:
        samples = samples_of(song, seconds)
        written = tempo_map(song, shift, seconds)
        for keyed in (False, True):
            rows = []
            for seed in (1, 2, 3):
                file_format = choreography.AudioFormat(encoding=choreography.AUDIO_ENCODING_FILE)
                of_file, found = dance(server, file_format, wav(samples), seconds, seed, keyed)
                of_live, heard = dance(server, PCM, samples, seconds, seed, keyed)
                of_file, of_live = dancers_beats(of_file), dancers_beats(of_live)
                is_heard = [source == choreography.BEAT_SOURCE_HEARD for beat, source in heard if beat >= FROM_SECOND]
                found, heard = [numpy.array([beat for beat, _ in beats]) for beats in (found, heard)]
                beats = found if written is None else written
                period = numpy.median(numpy.diff(beats))
                chance = [hits(of_live, beats + generator.uniform(0, period)) for _ in range(50)]
                rows.append((hits(of_file, beats), hits(of_live, beats), numpy.mean(chance), hits(of_file, found), hits(of_live, heard),
                             f_measure(found, beats), f_measure(heard, beats), numpy.mean(is_heard or [0])))
            whole, live, *rest = numpy.mean(rows, 0)
            name = pathlib.Path(song).stem + (", keys each 2 s" if keyed else ", no keys")
            chance, *rest = [f"{value:.2f}" for value in rest]
            print(f"| {name} | {whole:.2f} | {live:.2f} | {live / whole:.2f} | {chance} | {' | '.join(rest)} |", flush=True)


# ------------------------------------------------------------------------------------------------------------------ songs


def songs_table(server, songs, seconds):
    print("\n| live dances, one seed | songs apart cm, least | median | most |")
    print("|---|---|---|---|")
    for keyed in (False, True):
        apart = []
        for seed in (1, 2, 3):
            danced = [dance(server, PCM, samples_of(song, seconds), seconds, seed, keyed)[0] for song in songs]
            apart += [100 * numpy.linalg.norm(one - other, axis=-1).mean() for one, other in itertools.combinations(danced, 2)]
        figures = " | ".join(f"{value:.2f}" for value in numpy.percentile(apart, (0, 50, 100)))
        print(f"| {'keys each 2 s' if keyed else 'no keys'} | {figures} |", flush=True)


# ---------------------------------------------------------------------------------------------------------------- latency


class LiveDance:
    """One dance in real time; sets `sent`, `rejected` and `refused`."""

    def __init__(self, server, look_ahead, key_each, samples):
        self.server, self.look_ahead, self.key_each, self.samples = server, look_ahead, key_each, samples
        self.seconds = len(samples) / 2 / RATE
        self.pieces, self.arrivals, self.sent, self.rejected, self.refused = [], [], 0, 0, False
        self.latency = 0

    def run(self):
        self.start = time.monotonic()
        try:
            for answer in self.server.client.stream_dance(self.requests()):
                now = time.monotonic() - self.start
                self.latency = answer.header.latency_frames or self.latency
                self.arrivals += [now] * answer.frames.count
                self.rejected += answer.event.HasField("keyframe_rejected")
        except ChoreoError as error:
            if error.code != "RESOURCE_EXHAUSTED" or self.arrivals:
                raise
            self.refused = True

    def late_ms(self):
        """Of each frame."""
        late = []
        for frame, arrival in enumerate(self.arrivals):
            due = [at for end, at in self.pieces if end >= (frame + self.latency) / FPS]
            late.append(1000 * (arrival - (due or [self.pieces[-1][1]])[0]))
        return late

    def requests(self):
        config = choreography.DanceConfig(seed=1, frames=round(self.seconds * FPS), audio_format=PCM, generate_until=0)
        yield {"config": config}
        due = queue.PriorityQueue()  # (second at which it is sent, key)
        for number in range(1, int(self.seconds / self.key_each)):
            at = number * self.key_each
            for change, ahead in ((0, 3), (1, 1)):
                due.put((max(0, at - ahead), number, change))
        piece = RATE // 10
        for start in range(0, len(self.samples) // 2, piece):
            played = (start + piece) / RATE
            time.sleep(max(0, self.start + played - time.monotonic()))
            while not due.empty() and due.queue[0][0] <= played:
                _, number, change = due.get()
                self.sent += change
                yield {"keyframe": key(number + 7 * change, round(number * self.key_each * FPS))}
            yield {"generate_until": choreography.GenerateUntil(frame=round((played + self.look_ahead) * FPS))}
            yield {"audio": choreography.Audio(data=self.samples[2 * start : 2 * (start + piece)], first_sample=start)}
            self.pieces.append((played, time.monotonic() - self.start))
        yield {"end_of_audio": choreography.EndOfAudio()}
        yield {"keyframes_complete": choreography.KeyframesComplete()}


def dance_together(dances, within=0):
    """Their begins spread over so many seconds."""
    threads = [threading.Thread(target=one.run) for one in dances]
    for thread in threads:
        thread.start()
        time.sleep(within / len(threads))
    for thread in threads:
        thread.join()


def latency_table(server):
    print("\n| look-ahead s | keys each s | first frame after s | lateness p50 ms | p99 | changes 1 s ahead accepted |\n|---|---|---|---|---|---|")
    for look_ahead in (0.3, 0.5, 1, 2):
        samples = clicks(13)
        dances = [LiveDance(server, look_ahead, key_each, samples) for key_each in (1, 2, 4)]
        dance_together(dances)
        for one in dances:
            p50, p99 = numpy.percentile(one.late_ms(), (50, 99))
            print(f"| {look_ahead} | {one.key_each} | {one.arrivals[0]:.2f} | {p50:.0f} | {p99:.0f} | {one.sent - one.rejected} of {one.sent} |", flush=True)


def crowd_table(server):
    print("\n| Python streams | refused | frames p50 ms late | p99 | most | over 100 ms late % |\n|---|---|---|---|---|---|")
    samples = clicks(13)
    for count in CROWDS:
        dances = [LiveDance(server, 0.5, 2, samples) for _ in range(count)]
        dance_together(dances, within=2)
        late = numpy.concatenate([one.late_ms() for one in dances])
        figures = " | ".join(f"{value:.0f}" for value in numpy.percentile(late, (50, 99, 100)))
        refused = sum(one.refused for one in dances)
        print(f"| {count} | {refused} | {figures} | {100 * numpy.mean(late > 100):.2f} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin", type=pathlib.Path)
    parser.add_argument("--songs", nargs="*", default=[])
    parser.add_argument("--tables", nargs="+", default=TABLES, choices=TABLES)
    parser.add_argument("--data", type=pathlib.Path, help="folder of prepared clips")
    parser.add_argument("--splits", type=pathlib.Path, help="which of them are held out, JSON")
    parser.add_argument("--split", default="validation")
    parser.add_argument("--seconds", type=float, default=40, help="of each song")
    parser.add_argument("--shift", type=float, default=0.07, help="seconds by which onsets lie behind the tempo maps")
    options = parser.parse_args()
    server = Server(options.bin / "choreod")
    try:
        if "beats" in options.tables:
            beats_table(server, options.songs, options.seconds, options.shift)
        if "songs" in options.tables and len(options.songs) > 1:
            songs_table(server, options.songs, options.seconds)
        if "latency" in options.tables:
            latency_table(server)
        if "crowd" in options.tables:
            crowd_table(server)
        if "notice" in options.tables and options.data:
            notice_table(server, places, options.data, options.splits, options.split)
    finally:
        server.close()


if __name__ == "__main__":
    main()
