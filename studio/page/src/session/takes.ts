// Takes: alternative dances, side by side, kept with a click.
import type { Watch } from '../project/dancer';
import { made, push, stream, total } from './history';
import { dancer, skeleton } from './link';
import { Motion } from '../project/motion';
import { audio } from './songs';
import { selection, moment, moments, project, takes, notify, warnings, work } from '../project/state';
import type { Moment, Take } from '../project/state';
import { mostUnlike, unlikeness } from '../project/unlike';

const alike = 0.002; // of `unlikeness`; less is invisible
const near = 4; // seconds; the playhead moves no further

/// Suppresses notes on takes, which may never be kept.
const silent: Watch = { onFrames: () => {}, onWarning: () => {} };

/// Moves a resting playhead to where takes differ most between two frames, if they look alike at its place, as at common keys.
function goWhereTheyDiffer(from: number, to: number) {
  const all = [moment.value.motion.value, ...takes.value.map((take) => take.motion)];
  const now = Math.round(audio.currentTime * dancer.fps);
  if (!audio.paused || unlikeness(all, now) > alike) return;
  const frame = mostUnlike(all, from, Math.min(to, total.value));
  if (unlikeness(all, frame) > alike) audio.currentTime = frame / dancer.fps;
}

/// Makes takes of the selected interval, or of the whole dance.
export const tryTakes = (count = 3) => work(async () => {
  const before = moment.value;
  const seed = before.project.seed + moments.value.length * 100 + takes.value.length;
  const whole = await made(before);
  if (moment.value !== before) return;
  if (!selection.value) return tryWholes(before, seed, count);
  const [from, to] = selection.value;
  const end = Math.min(to, whole.count);
  const motions = await dancer.between({ ...before.project, seed }, whole, from, end, count, silent);
  if (moment.value !== before) return;
  takes.value = motions.map((other) => ({ seed: before.project.seed, motion: other }));
  goWhereTheyDiffer(from, to);
});

/// Makes takes of everything but the selected interval.
export const tryTheRest = (count = 3) => work(async () => {
  const [before, interval] = [moment.value, selection.value];
  const whole = await made(before);
  if (!interval || moment.value !== before) return;
  const [from, to] = interval;
  const { project: current } = before;
  const first = current.seed + moments.value.length * 100 + 50;
  takes.value = [];
  for (let seed = first; seed < first + count; ++seed) {
    const start = from > 0 ? (await dancer.between({ ...current, seed }, whole, -1, from, 1, silent))[0] : whole;
    const other = to < whole.count - 1 ? (await dancer.between({ ...current, seed }, start, to, whole.count, 1, silent))[0] : start;
    if (moment.value !== before || selection.value !== interval || takes.value.length !== seed - first) return;
    takes.value = [...takes.value, { seed: current.seed, motion: other }];
  }
  if (to < whole.count - 1) goWhereTheyDiffer(to, to + near * dancer.fps);
  else goWhereTheyDiffer(0, from);
});

async function tryWholes(before: Moment, seed: number, count: number) {
  const { signal } = stream();
  const others: Take[] = [];
  await Promise.all(Array.from({ length: count }, async (_, i) => {
    const next = { ...before.project, seed: seed + 1 + i };
    const take: Take = { seed: next.seed, motion: new Motion(skeleton.joints, dancer.fps) };
    others.push(take);
    await dancer.stream(next, null, -1, { ...silent, onFrames: (longer) => {
      if (take.motion === longer || moment.value !== before) return;
      take.motion = longer;
      takes.value = others.filter(({ motion: some }) => some.count > 0);
    } }, signal);
  }));
  if (moment.value === before && takes.value.length === count) {
    const now = Math.round(audio.currentTime * dancer.fps);
    goWhereTheyDiffer(now, now + near * dancer.fps);
  }
}

export function keepTake(take: Take) {
  const { motion: kept, seed } = take;
  if (kept.count < total.value) return notify('This take is not danced to its end yet.');
  push({ ...project.value, seed }, kept, async () => kept, warnings.value);
  notify('Kept.');
}
