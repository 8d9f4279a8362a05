#!/usr/bin/python3
"""Do real dancers move more where their music is louder? Needs numpy and ffmpeg.

    scripts/loudness_of_dancers.py FOLDER

FOLDER holds NAME.npy, joints of Tang et al. (float32 [frames, joints, 3], cm, 25 fps; of 24 joints the first is a centre and the others
are relative to it), beside NAME.ogg. In windows of 4 s it correlates loudness (ITU-R BS.1770) with the joints' mean speed, in the world
and relative to their mean, and beside it with the song shifted in a circle, which shows chance.
"""
import pathlib
import subprocess
import sys

import numpy as np

FPS, RATE, SECONDS = 25, 22050, 4


def windows(values, rate):
    size = rate * SECONDS
    return values[: len(values) // size * size].reshape(-1, size).mean(1)


def loudness(song):
    raw = subprocess.run(["ffmpeg", "-v", "error", "-i", song, "-ac", "1", "-ar", str(RATE), "-f", "f32le", "-"], capture_output=True, check=True)
    heard = np.fft.rfft(np.frombuffer(raw.stdout, np.float32))
    z = np.exp(-2j * np.pi * np.arange(len(heard)) * RATE / (2 * (len(heard) - 1)) / 48000)  # BS.1770's filters are for 48 kHz
    heard *= (1.53512485958697 - 2.69169618940638 * z + 1.19839281085285 * z**2) / (1 - 1.69065929318241 * z + 0.73248077421585 * z**2)
    heard *= (1 - z) ** 2 / (1 - 1.99004745483398 * z + 0.99007225036621 * z**2)
    return 10 * np.log10(windows(np.fft.irfft(heard) ** 2, RATE) + 1e-10)


def speed(joints):
    smooth = np.exp(-0.5 * (np.arange(-4, 5) / 1.5) ** 2)
    size = len(joints) - len(smooth) + 1
    joints = sum(weight * joints[i : i + size] for i, weight in enumerate(smooth / smooth.sum()))
    return windows(np.linalg.norm(np.diff(joints, axis=0), axis=2).mean(1) * FPS / 100, FPS)


def main(folder):
    dances = []
    for path in sorted(pathlib.Path(folder).glob("*.npy")):
        if path.with_suffix(".ogg").exists():
            joints = np.load(path).astype(float)
            joints = joints[:, :1] + joints[:, 1:] if joints.shape[1] == 24 else joints
            dances.append((loudness(path.with_suffix(".ogg")), speed(joints), speed(joints - joints.mean(1, keepdims=True))))
    chance = np.random.default_rng(0)
    for which, name in ((1, "in the world"), (2, "of the body")):
        pairs = [(dance[0][: len(dance[which])], dance[which][: len(dance[0])]) for dance in dances]
        weights = [len(loud) for loud, _ in pairs]

        def mean(shifted):
            turn = lambda loud: np.roll(loud, chance.integers(2, len(loud) - 1)) if shifted else loud
            return np.average([np.corrcoef(turn(loud), moved)[0, 1] for loud, moved in pairs], weights=weights)

        shifted = [mean(True) for _ in range(500)]
        louder = [moved[loud >= np.quantile(loud, 0.75)].mean() / moved[loud <= np.quantile(loud, 0.25)].mean() for loud, moved in pairs]
        print(f"{len(pairs)} dances, speed {name}: correlation {mean(False):.3f}, of shifted songs {np.mean(shifted):.3f} ± {np.std(shifted):.3f}; "
              f"loudest quarter ÷ softest {np.mean(louder):.2f}")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
