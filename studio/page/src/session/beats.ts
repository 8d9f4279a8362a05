// The beats of the song: as found by the program, or as set by the user. For live music the user
// sets how they are detected.
import { computed, signal } from '@preact/signals';
import { counted, doubled, halved, nudged, pulseOf, tapped, tempo, withOne } from '../project/counts';
import type { Beats } from '../project/counts';
import { sections } from '../project/form';
import { change, note } from './history';
import { hintLive, soundingNow } from './live';
import { liveBeats } from './live_beats';
import { limits } from '../project/limits';
import { audio } from './songs';
import { live, project, shownSong, notify } from '../project/state';

const none: Beats = { bar: 4, list: [] };
const nudge = 0.01; // seconds
const mostLater = 1; // seconds, of live beats either way
const pause = 2500; // ms after the last tap until the taps are applied
const longest = 3; // seconds from tap to tap
const tooFew = 'Tap four beats at least.';

const heardBeats = computed(() => {
  const heard = shownSong.value?.analysis;
  return heard ? counted(heard.beats, heard.counts, heard.beatsInBar, heard.confidence) : none;
});

export const beats = computed(() => (live.value ? liveBeats.value : project.value?.beats ?? heardBeats.value));

/// Suggested keys: a pose of the library on a beat, seconds.
export const suggested = computed((): { time: number; pose: string }[] => {
  const all = shownSong.value?.analysis.suggested ?? [];
  if (!project.value?.beats) return all;
  const near = 0.12; // seconds
  const times = beats.value.list.map(({ time }) => time);
  const moved = all.map(({ time: wanted, pose }) => ({ pose, time: times.find((time) => Math.abs(time - wanted) < near) ?? -1 }));
  return moved.filter(({ time }, i) => time >= 0 && time !== moved[i - 1]?.time);
});

/// The song's repeated sections.
export const form = computed(() => sections(shownSong.value?.analysis.passages ?? []));

const length = () => shownSong.value!.analysis.seconds;

/// Dances to other beats. Returns false, and changes nothing, if they are slower than half or
/// faster than double any permitted tempo.
function changeBeats(next: Beats): boolean {
  const [found, least, most] = [tempo(next), limits.slowestTempo / 2, 2 * limits.fastestTempo];
  const isDanced = found >= least && found <= most;
  if (isDanced) change({ beats: next });
  else notify(`${Math.round(found)} beats a minute, must be ${least} to ${most}.`);
  return isDanced;
}

export function halveBeats() {
  if (live.value) hintLive({ pace: live.value.hint.pace === 'double' ? null : 'half' });
  else changeBeats(halved(beats.value));
}
export function doubleBeats() {
  if (live.value) hintLive({ pace: live.value.hint.pace === 'half' ? null : 'double' });
  else changeBeats(doubled(beats.value));
}
/// Moves beats by this many steps.
export function nudgeBeats(steps: number) {
  if (live.value) hintLive({ later: Math.min(mostLater, Math.max(-mostLater, live.value.hint.later + nudge * steps)) });
  else change({ beats: nudged(beats.value, nudge * steps, length()) });
}
/// Counting from another beat does not change the dance.
export function countFromHere() {
  if (live.value) hintLive({ one: soundingNow() });
  else note({ beats: withOne(beats.value, audio.currentTime) });
}
export function hearBeats() {
  if (live.value) hintLive();
  else change({ beats: null });
}

/// Taps along with the music, in its seconds, not yet applied.
export const taps = signal<number[]>([]);
let waiting: ReturnType<typeof setTimeout>;

/// Records a tap. The taps become the beats after a pause of the taps or the song.
export function tap() {
  if (audio.paused && !live.value) return void audio.play().catch(() => {}); // an immediate pause rejects the promise
  const now = live.value ? soundingNow() : audio.currentTime;
  const last = taps.value.at(-1) ?? now;
  taps.value = now < last || now - last > longest ? [now] : [...taps.value, now];
  clearTimeout(waiting);
  waiting = setTimeout(applyTaps, pause / (live.value ? 1 : audio.playbackRate));
}

function applyTaps() {
  clearTimeout(waiting);
  const times = taps.value;
  taps.value = [];
  if (times.length > 0 && live.value) return tapLive(times);
  if (times.length === 0 || !shownSong.value || !project.value) return;
  const found = tapped(heardBeats.value, beats.value, times, length());
  if (!found) return notify(tooFew);
  if (changeBeats(found)) notify(`${Math.round(tempo(found))} beats a minute, of ${times.length} taps.`);
}
audio.addEventListener('pause', applyTaps);

/// Sets the taps' tempo, near which beats of live music are detected.
function tapLive(times: number[]) {
  const pulse = pulseOf(times);
  if (!pulse) return notify(tooFew);
  const tapped = 60 / pulse.period;
  if (tapped < limits.slowestTempo || tapped > limits.fastestTempo)
    return notify(`${Math.round(tapped)} taps a minute, must be ${limits.slowestTempo} to ${limits.fastestTempo}.`);
  hintLive({ tempo: tapped, pace: null });
  notify(`${Math.round(tapped)} beats a minute, of ${times.length} taps.`);
}
