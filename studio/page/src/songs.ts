// The song that is danced to, and the sound that is played.
import type { SongHeard } from './generated/studio/studio_pb';
import { wire } from './link';
import { song } from './state';
import type { Song } from './state';

export const audio = new Audio();

const types: Record<string, string> = { mp3: 'audio/mpeg', ogg: 'audio/ogg', flac: 'audio/flac', wav: 'audio/wav' };
export const songExtensions = Object.keys(types);

/// Plays it from now on.
export function takeSong(name: string, bytes: Uint8Array, heard: SongHeard) {
  const type = types[name.split('.').at(-1)!.toLowerCase()] ?? '';
  play({ name, bytes, heard, url: URL.createObjectURL(new Blob([bytes as BlobPart], { type })) });
}

function play(taken: Song) {
  audio.src = taken.url;
  song.value = taken;
}

/// Has the program hear a song, which is danced to from then on.
export async function hear(name: string, bytes: Uint8Array) {
  const answer = await wire.ask({ case: 'song', value: { name, data: bytes } });
  if (answer.case === 'song') takeSong(name, bytes, answer.value);
}

/// Back to a song that was heard before; the sound goes on where the song is the present one.
export async function returnTo(known: Song) {
  await wire.ask({ case: 'song', value: { name: known.name, data: known.bytes } });
  if (known !== song.value) play(known);
}

/// A sound to play a dance to that has no song.
export function playSilence(seconds: number) {
  const [rate, header] = [8000, 44];
  const samples = Math.ceil(seconds * rate);
  const wav = new DataView(new ArrayBuffer(header + samples));
  const word = (at: number, text: string) => [...text].forEach((c, i) => wav.setUint8(at + i, c.charCodeAt(0)));
  word(0, 'RIFF');
  wav.setUint32(4, header - 8 + samples, true);
  word(8, 'WAVEfmt ');
  wav.setUint32(16, 16, true);
  wav.setUint16(20, 1, true);
  wav.setUint16(22, 1, true);
  wav.setUint32(24, rate, true);
  wav.setUint32(28, rate, true);
  wav.setUint16(32, 1, true);
  wav.setUint16(34, 8, true);
  word(36, 'data');
  wav.setUint32(40, samples, true);
  new Uint8Array(wav.buffer).fill(128, header);
  audio.src = URL.createObjectURL(new Blob([wav], { type: 'audio/wav' }));
}
