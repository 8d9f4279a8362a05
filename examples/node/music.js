// Music for the examples.
import { readFile } from 'node:fs/promises';
import { setTimeout as sleep } from 'node:timers/promises';

export const sampleRate = 22050;
export const pcm = { encoding: 'AUDIO_ENCODING_PCM_S16LE', sample_rate: sampleRate, channels: 1 };

/** A click twice a second, as 16-bit samples. */
export function clicks(seconds) {
  const bytes = Buffer.alloc(2 * Math.round(seconds * sampleRate));
  for (let i = 0; i < bytes.length / 2; ++i) {
    const t = (i / sampleRate) % 0.5;
    bytes.writeInt16LE(Math.round(20000 * Math.exp(-60 * t) * Math.sin(2 * Math.PI * 880 * t)), 2 * i);
  }
  return bytes;
}

/** Requests with samples as a sound card hands them out: a tenth of a second at a time, `speed` times as fast as they sound. */
export async function* live(samples, speed = 1) {
  const piece = 2 * (sampleRate / 10);
  for (let start = 0; start < samples.length; start += piece) {
    await sleep(100 / speed);
    yield { audio: { data: samples.subarray(start, start + piece), first_sample: start / 2 } };
  }
}

/** Requests with the bytes of a WAV, FLAC, Ogg or MP3 file. */
export async function* file(path) {
  const bytes = await readFile(path);
  const piece = 1 << 20;
  for (let start = 0; start < bytes.length; start += piece) {
    yield { audio: { data: bytes.subarray(start, start + piece), first_sample: start } };
  }
}
