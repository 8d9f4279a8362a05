// The song of the dance, and its playback.
import type { SongHeard } from '../generated/studio/studio_pb';
import { wire } from './link';
import { opened, song, notify } from '../project/state';
import type { Song } from '../project/state';
import { wav } from './wav';

export const audio = new Audio();

const types: Record<string, string> = {
  mp3: 'audio/mpeg', ogg: 'audio/ogg', oga: 'audio/ogg', opus: 'audio/ogg', flac: 'audio/flac', wav: 'audio/wav',
  m4a: 'audio/mp4', mp4: 'audio/mp4', aac: 'audio/aac', webm: 'audio/webm',
};
export const songExtensions = Object.keys(types);

/// Makes a song the played one.
export function useSong(name: string, bytes: Uint8Array, analysis: SongHeard) {
  const type = types[name.split('.').at(-1)!.toLowerCase()] ?? '';
  play({ name, bytes, analysis, url: URL.createObjectURL(new Blob([bytes as BlobPart], { type })) });
}

function play(next: Song) {
  audio.src = next.url;
  song.value = next;
}

/// Has the program analyse a song and uses it for the dance.
export async function analyseSong(name: string, bytes: Uint8Array) {
  const answer = await wire.request({ case: 'song', value: { name, data: bytes } });
  if (answer.case === 'song') useSong(name, bytes, answer.value);
}

/// Reports problems of the song's file, together with other notes.
export function showSongNotes(also = '') {
  const { name, analysis } = song.value!;
  if (analysis.notes.length) notify(`${opened(name, `${analysis.seconds.toFixed(1)} s of song`, analysis.notes)} ${also}`.trim());
}

/// Returns to an earlier song; playback continues if it is the present one.
export async function returnTo(known: Song) {
  await wire.request({ case: 'song', value: { name: known.name, data: known.bytes } });
  if (known !== song.value) play(known);
}

/// Plays silence, for a dance without a song.
export function playSilence(seconds: number) {
  const rate = 8000;
  const silence = wav(new Uint8Array(Math.ceil(seconds * rate)), rate, 8);
  audio.src = URL.createObjectURL(new Blob([silence as BlobPart], { type: 'audio/wav' }));
}
