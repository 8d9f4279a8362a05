// The beats of the song: as found by the program, or as set by the user.
import { computed, signal } from '@preact/signals';
import { counted, doubled, halved, nudged, tapped, tempo, withOne } from './counts';
import type { Beats } from './counts';
import { sections } from './form';
import { change, note } from './history';
import { audio } from './songs';
import { project, shownSong, tell } from './state';

const none: Beats = { bar: 4, list: [] };
const nudge = 0.01; // seconds
const pause = 2500; // ms after the last tap, after which they count
const longest = 3; // seconds from tap to tap

const heardBeats = computed(() => {
  const heard = shownSong.value?.heard;
  return heard ? counted(heard.beats, heard.counts, heard.beatsInBar) : none;
});

export const beats = computed(() => project.value?.beats ?? heardBeats.value);

/// Suggested beats for key poses, seconds.
export const suggested = computed(() => {
  const all = shownSong.value?.heard.suggested ?? [];
  if (!project.value?.beats) return all;
  const near = 0.12; // seconds
  const times = beats.value.list.map(({ time }) => time);
  const moved = all.map((wanted) => times.find((time) => Math.abs(time - wanted) < near) ?? -1);
  return [...new Set(moved.filter((time) => time >= 0))];
});

/// The song's repeated sections.
export const form = computed(() => sections(shownSong.value?.heard.passages ?? []));

const length = () => shownSong.value!.heard.seconds;

export const halveBeats = () => change({ beats: halved(beats.value) });
export const doubleBeats = () => change({ beats: doubled(beats.value) });
/// Moves beats by this many steps.
export const nudgeBeats = (steps: number) => change({ beats: nudged(beats.value, nudge * steps, length()) });
/// Counting from another beat does not change the dance.
export const countFromHere = () => note({ beats: withOne(beats.value, audio.currentTime) });
export const hearBeats = () => change({ beats: null });

/// Taps along with the song, in its seconds, not yet applied.
export const taps = signal<number[]>([]);
let waiting: ReturnType<typeof setTimeout>;

/// Records a tap. The taps become the beats after a pause of the taps or the song.
export function tap() {
  if (audio.paused) return void audio.play().catch(() => {}); // an immediate pause rejects the promise
  const now = audio.currentTime;
  const last = taps.value.at(-1) ?? now;
  taps.value = now < last || now - last > longest ? [now] : [...taps.value, now];
  clearTimeout(waiting);
  waiting = setTimeout(applyTaps, pause / audio.playbackRate);
}

function applyTaps() {
  clearTimeout(waiting);
  const told = taps.value;
  taps.value = [];
  if (told.length === 0 || !shownSong.value || !project.value) return;
  const found = tapped(heardBeats.value, beats.value, told, length());
  if (!found) return tell('Tap four beats at least.');
  change({ beats: found });
  tell(`${Math.round(tempo(found))} beats a minute, of ${told.length} taps.`);
}
audio.addEventListener('pause', applyTaps);
