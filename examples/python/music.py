"""Music for the examples."""

import array
import math
import time

from choreo_client import choreography

RATE = 22050
PCM = choreography.AudioFormat(encoding=choreography.AUDIO_ENCODING_PCM_S16LE, sample_rate=RATE, channels=1)


def clicks(seconds):
    """A click twice a second, as 16-bit samples."""
    times = ((i / RATE) % 0.5 for i in range(round(seconds * RATE)))
    samples = (round(20000 * math.exp(-60 * t) * math.sin(2 * math.pi * 880 * t)) for t in times)
    return array.array("h", samples).tobytes()  # on a little-endian machine


def live(samples, speed=1.0):
    """Samples as a sound card hands them out: a tenth of a second at a time, `speed` times as fast as they sound."""
    piece = 2 * (RATE // 10)
    for start in range(0, len(samples), piece):
        time.sleep(0.1 / speed)
        yield choreography.Audio(data=samples[start : start + piece], first_sample=start // 2)


def file(path):
    """The bytes of a WAV, FLAC, Ogg or MP3 file."""
    with open(path, "rb") as song:
        while data := song.read(1 << 20):
            yield choreography.Audio(data=data)
