// Counting a song: its beats, its bars, and dancers' eights.

/// `count`: in its eight, from 1 on; 0 if not counted. `sure`: the confidence of a beat that was found (docs/beats.md).
export type Beat = { time: number; count: number; sure?: number };
/// `bar`: beats in a bar.
export type Beats = { bar: number; list: Beat[] };

const usualBar = 4;
const fewestTaps = 4;
const slack = 0.06; // share by which equal tempi may differ
const missed = 0.07; // seconds between a tap and the beat meant
const gap = 1.6; // intervals; longer ones are pauses, here and in the program (model/audio/beats/beat_hint.cpp)
const around = 4; // intervals on either side that tell how long one is

/// Beats in an eight: two bars, of four or three.
export const eight = (bar: number) => bar * Math.max(1, Math.floor(8 / bar));
export const isDownbeat = ({ count }: Beat, bar: number) => count > 0 && (count - 1) % bar === 0;
/// Beats as sent to the program: seconds, and the ones that begin an eight.
export type Counts = { beats: number[]; ones: number[] };
export const countsOf = (beats: Beats): Counts => ({ beats: timesOf(beats), ones: beats.list.filter(({ count }) => count === 1).map(({ time }) => time) });
/// A time as stored in projects.
const kept = (seconds: number) => Math.round(seconds * 1e4) / 1e4;
const median = (values: number[]) => [...values].sort((a, b) => a - b)[Math.floor(values.length / 2)];
const intervals = (times: number[]) => times.slice(1).map((time, i) => time - times[i]);

/// From the program's beats: `inBar` counts from 1 in each bar. Eights begin with the first bar, and again after a short bar.
export function counted(times: number[], inBar: number[], bar: number, sure: number[] = []): Beats {
  const length = bar || usualBar;
  const bars = eight(length) / length;
  let nth = bars - 1;
  let isFirst = true;
  const list = times.map((time, i) => {
    const at = Math.min(inBar[i] ?? 0, length);
    if (at === 1) {
      const isWhole = !isFirst && inBar[i - 1] === length;
      nth = isWhole ? (nth + 1) % bars : 0;
      isFirst = false;
    }
    return { time, count: at && nth * length + at, ...(sure[i] === undefined ? {} : { sure: sure[i] }) };
  });
  return { bar: length, list };
}

/// Counts live beats in order; a bar lasts from downbeat to downbeat.
export function countedLive(heard: { time: number; isDown: boolean; sure: number }[]): Beats {
  let at = 0;
  const inBar = heard.map(({ isDown }) => (at = isDown ? 1 : at && at + 1));
  const bars = inBar.filter((count, i) => count > 0 && inBar[i + 1] === 1);
  return counted(heard.map(({ time }) => time), inBar, bars.length ? median(bars) : usualBar, heard.map(({ sure }) => sure));
}

/// Whole beats from one to the next: 1, or more over a pause.
function beatsToNext(times: number[], i: number): number {
  const near = intervals(times.slice(Math.max(0, i - around), i + around + 2)).sort((a, b) => a - b);
  const beats = (times[i + 1] - times[i]) / near[Math.floor((near.length - 1) / 2)];
  return beats > gap ? Math.round(beats) : 1;
}

/// Each beat's distance, in beats, from a 1 of its part between pauses. In a part without counts
/// the count continues by time.
function sinceOne({ bar, list }: Beats): number[] {
  const times = timesOf({ bar, list });
  const places = [0];
  times.slice(1).forEach((_, i) => places.push(places[i] + beatsToNext(times, i)));
  const oneOf = (part: number[]) => {
    const anchor = part.find((i) => isDownbeat(list[i], bar)) ?? part.find((i) => list[i].count > 0);
    return anchor === undefined ? null : places[anchor] - list[anchor].count + 1;
  };
  const parts: number[][] = [];
  times.forEach((_, i) => (i > 0 && places[i] === places[i - 1] + 1 ? parts.at(-1)!.push(i) : parts.push([i])));
  let one = oneOf(parts.flat()) ?? 0;
  return parts.flatMap((part) => {
    one = oneOf(part) ?? one;
    return part.map((i) => places[i] - one);
  });
}

const countAt = (since: number, length: number) => ((since % length) + length) % length + 1;

/// Counts forwards and backwards from one of the beats. Beyond a pause the count moves by as much: only music says how many beats of a bar a pause takes.
function countedFrom(beats: Beats, one: number): Beats {
  const since = sinceOne(beats);
  return { bar: beats.bar, list: beats.list.map(({ time }, i) => ({ time: kept(time), count: countAt(since[i] - since[one], eight(beats.bar)) })) };
}

const nearest = (times: number[], wanted: number) =>
  times.reduce((best, time, i) => (Math.abs(time - wanted) < Math.abs(times[best] - wanted) ? i : best), 0);
const timesOf = ({ list }: Beats) => list.map(({ time }) => time);

/// Makes the beat nearest to a second a 1.
export const withOne = (beats: Beats, seconds: number) => countedFrom(beats, nearest(timesOf(beats), seconds));

/// A second's place among the beats: 1.5 is halfway from the second to the third. Extrapolates before the first and after the last.
export function placeAmong(seconds: number, times: number[]): number {
  const at = intervalAt(times.findLastIndex((time) => time <= seconds), times);
  return at + (seconds - times[at]) / (times[at + 1] - times[at]);
}

/// The second this many counts later, as in the program (client/authoring/fields/counts.h). `times`: at least two.
export function later(seconds: number, counts: number, times: number[]): number {
  const place = placeAmong(seconds, times) + counts;
  const at = intervalAt(Math.floor(place), times);
  return times[at] + (place - at) * (times[at + 1] - times[at]);
}

/// The second that a frame stands for, as in the program: that of the simplest count on it (a whole one, a half, a third, a quarter), or its own.
export function secondOf(frame: number, fps: number, times: number[]): number {
  if (times.length < 2) return frame / fps;
  const place = placeAmong(frame / fps, times);
  const simple = [1, 2, 3, 4].map((parts) => later(times[0], Math.round(place * parts) / parts, times));
  return simple.find((second) => Math.round(second * fps) === frame) ?? frame / fps;
}

const intervalAt = (place: number, times: number[]) => Math.min(Math.max(place, 0), times.length - 2);

const eachOf = (times: number[], nth: number, first: number) => times.filter((_, i) => i % nth === first % nth);

/// The beats from each to before the next: this many, but one before a pause.
const parted = (times: number[], into: number) =>
  times.map((time, i) => {
    const parts = i + 1 < times.length && beatsToNext(times, i) === 1 ? into : 1;
    return Array.from({ length: parts }, (_, part) => (part ? time + ((times[i + 1] - time) * part) / into : time));
  });

/// Keeps every second beat: in each part between pauses the half that contains its first 1.
export function halved(beats: Beats): Beats {
  const since = sinceOne(beats);
  const list = beats.list.map(({ time }, i) => ({ time: kept(time), count: countAt(since[i] / 2, eight(beats.bar)) }));
  return { bar: beats.bar, list: list.filter((_, i) => since[i] % 2 === 0) };
}

export function doubled(beats: Beats): Beats {
  const since = sinceOne(beats);
  const list = parted(timesOf(beats), 2).map((both, i) => both.map((time, half) => ({ time: kept(time), count: countAt(2 * since[i] + half, eight(beats.bar)) })));
  return { bar: beats.bar, list: list.flat() };
}

/// Moves all beats, and keeps the ones within the song. Beats before the first counted one are
/// counted back from it.
export const nudged = ({ bar, list }: Beats, by: number, seconds: number): Beats => {
  const first = Math.max(0, list.findIndex(({ count }) => count > 0));
  const back = (i: number) => ((((list[first].count || 1) - 1 + i - first) % eight(bar)) + eight(bar)) % eight(bar) + 1;
  const moved = list.map(({ time, count }, i) => ({ time: kept(time + by), count: count || back(i) }));
  return { bar, list: moved.filter(({ time }) => time >= 0 && time <= seconds) };
};

/// The mean confidence of beats that were found, in percent; null for others.
export function confidence({ list }: Beats): number | null {
  const sure = list.flatMap((beat) => beat.sure ?? []);
  return sure.length ? Math.round((100 * sure.reduce((sum, one) => sum + one, 0)) / sure.length) : null;
}

/// The tempo of most beats, per minute; 0 without beats.
export function tempo({ list }: Beats): number {
  const all = intervals(list.map(({ time }) => time));
  const usual = median(all);
  const near = all.filter((length) => Math.abs(length / usual - 1) < 0.2);
  return near.length ? (60 * near.length) / near.reduce((sum, length) => sum + length, 0) : 0;
}

/// The pulse of taps, some of which may be missing: the second of a beat, and the seconds per beat. Null for too few taps.
export function pulseOf(taps: number[]): { phase: number; period: number } | null {
  if (taps.length < fewestTaps) return null;
  const usual = median(intervals(taps));
  const places = [0];
  for (const length of intervals(taps)) places.push(places.at(-1)! + Math.max(1, Math.round(length / usual)));
  const mean = (values: number[]) => values.reduce((sum, value) => sum + value, 0) / values.length;
  const [place, time] = [mean(places), mean(taps)];
  const spread = mean(places.map((at) => (at - place) ** 2));
  const period = mean(taps.map((at, i) => (at - time) * (places[i] - place))) / spread;
  return { phase: time - period * place, period };
}

/// Beats from taps. Taps choose among the beats found in the song, `heard`, which give the exact times; without matching beats they continue evenly
/// over the whole song. Eights stay as in `before`.
export function tapped(heard: Beats, before: Beats, taps: number[], seconds: number): Beats | null {
  const pulse = pulseOf(taps);
  if (!pulse) return null;
  const { phase, period } = pulse;
  const times = along(timesOf(heard), taps, period) ?? evenly(phase % period, period, seconds);
  const ones = before.list.filter(({ count }) => count === 1).map(({ time }) => time);
  const one = ones.length ? ones[nearest(ones, taps[0])] : taps[0];
  return countedFrom({ bar: before.bar, list: times.map((time) => ({ time, count: 0 })) }, nearest(times, one));
}

const evenly = (first: number, period: number, seconds: number) =>
  Array.from({ length: Math.max(0, Math.floor((seconds - first) / period) + 1) }, (_, i) => first + i * period);

/// The found beats, divided or thinned to the taps' tempo; null if the tempi do not match.
function along(heard: number[], taps: number[], period: number): number[] | null {
  const there = heard.filter((time) => time > taps[0] - 1 && time < taps.at(-1)! + 1);
  if (there.length < 3) return null;
  const ratio = median(intervals(there)) / period;
  const isNear = (value: number) => Math.abs(value - 1) < slack;
  // A circular mean, as half a beat late equals half a beat early.
  const away = (times: number[]) => {
    const turns = taps.map((tap) => (2 * Math.PI * (tap - times[nearest(times, tap)])) / period);
    const sum = (of: (turn: number) => number) => turns.reduce((all, turn) => all + of(turn), 0);
    return (Math.atan2(sum(Math.sin), sum(Math.cos)) * period) / (2 * Math.PI);
  };
  const more = [1, 2, 3, 4].find((n) => isNear(ratio / n));
  if (more) return shifted(more > 1 ? parted(heard, more).flat() : heard, away, period);
  const fewer = [2, 3, 4].find((n) => isNear(ratio * n));
  if (!fewer) return null;
  const ways = Array.from({ length: fewer }, (_, first) => eachOf(heard, fewer, first));
  ways.sort((a, b) => Math.abs(away(a)) - Math.abs(away(b)));
  return shifted(ways[0], away, period);
}

/// Shifts beats by a constant share of their intervals, for taps that are consistently off the beats.
function shifted(times: number[], away: (times: number[]) => number, period: number): number[] {
  const by = away(times);
  if (Math.abs(by) <= missed) return times;
  const moved = times.map((time, i) => time + (by / period) * Math.min((times[i + 1] ?? time + period) - time, gap * period));
  return moved.filter((time, i) => time >= 0 && (i === 0 || time > moved[i - 1]));
}
