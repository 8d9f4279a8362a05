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

const beat = 0.5; // seconds
const bars = [0, -4, 3, -2].map((step) => 110 * 2 ** (step / 12)); // the bass of each, Hz: A, F, C, G
const decay = (t, rate) => (t < 0 ? 0 : Math.exp(-rate * t));
const tone = (hertz, t) => Math.sin(2 * Math.PI * hertz * t);

/** A song of our own, under the licence of this file: drums, bass and chords at 120 beats a minute, as 16-bit samples. */
export function song(seconds) {
  const passage = Buffer.alloc(2 * 4 * beat * bars.length * sampleRate); // which comes again and again
  let noise = 1;
  for (let i = 0; i < passage.length / 2; ++i) {
    const t = i / sampleRate;
    noise = (noise * 48271) % 2147483647;
    const hiss = noise / 1073741824 - 1;
    const [inBeat, inHalf, inPair] = [t % beat, t % (beat / 2), t % (2 * beat)];
    const root = bars[Math.floor(t / (4 * beat))];
    const kick = decay(inBeat, 12) * tone(50 + 100 * decay(inBeat, 40), inBeat);
    const clap = decay(inPair - beat, 25) * hiss;
    const hat = decay(inHalf, 80) * hiss;
    const bass = decay(inHalf, 6) * tone(root, inHalf);
    const chord = [2, 2 * 2 ** (1 / 4), 3].reduce((sum, ratio) => sum + tone(ratio * root, t), 0) * decay(inPair, 1.5);
    passage.writeInt16LE(Math.round(11000 * (0.9 * kick + 0.5 * clap + 0.25 * hat + 0.6 * bass + 0.15 * chord)), 2 * i);
  }
  return Buffer.alloc(2 * Math.round(seconds * sampleRate), passage);
}

/** Samples as a WAV file. */
export function wav(samples) {
  const header = Buffer.alloc(44);
  for (const [at, text] of [[0, 'RIFF'], [8, 'WAVEfmt '], [36, 'data']]) header.write(text, at, 'latin1');
  for (const [at, number] of [[4, 36 + samples.length], [16, 16], [24, sampleRate], [28, 2 * sampleRate], [40, samples.length]]) header.writeUInt32LE(number, at);
  for (const [at, number] of [[20, 1], [22, 1], [32, 2], [34, 16]]) header.writeUInt16LE(number, at);
  return Buffer.concat([header, samples]);
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
    yield { audio: { data: bytes.subarray(start, start + piece) } };
  }
}
