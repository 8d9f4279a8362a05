// Other ways to dance the same, side by side, each a click from being kept.
import type { Watch } from './dancer';
import { made, push, stream, total } from './history';
import { dancer, skeleton } from './link';
import { Motion } from './motion';
import { chosen, moment, moments, project, takes, tell, warnings, work } from './state';
import type { Moment, Take } from './state';

/// Of takes that may never be kept, nothing is said.
const silent: Watch = { grown: () => {}, noted: () => {} };

/// Other ways to dance the chosen interval, or all of it.
export const tryTakes = (count = 3) => work(async () => {
  const before = moment.value;
  const seed = before.project.seed + moments.value.length * 100 + takes.value.length;
  const whole = await made(before);
  if (moment.value !== before) return;
  if (!chosen.value) return tryWholes(before, seed, count);
  const [from, to] = chosen.value;
  const motions = await dancer.between(before.project, whole, from, Math.min(to, whole.count), seed, count, silent);
  if (moment.value === before) takes.value = motions.map((other) => ({ seed: before.project.seed, motion: other }));
});

/// Other ways to dance all but the chosen interval, which stays as it is.
export const tryTheRest = (count = 3) => work(async () => {
  const [before, interval] = [moment.value, chosen.value];
  const whole = await made(before);
  if (!interval || moment.value !== before) return;
  const [from, to] = interval;
  const { project: asked } = before;
  const first = asked.seed + moments.value.length * 100 + 50;
  takes.value = [];
  for (let seed = first; seed < first + count; ++seed) {
    const start = from > 0 ? (await dancer.between(asked, whole, -1, from, seed, 1, silent))[0] : whole;
    const other = to < whole.count - 1 ? (await dancer.between(asked, start, to, whole.count, seed, 1, silent))[0] : start;
    if (moment.value !== before || chosen.value !== interval || takes.value.length !== seed - first) return;
    takes.value = [...takes.value, { seed: asked.seed, motion: other }];
  }
});

async function tryWholes(before: Moment, seed: number, count: number) {
  const { signal } = stream();
  const others: Take[] = [];
  await Promise.all(Array.from({ length: count }, async (_, i) => {
    const next = { ...before.project, seed: seed + 1 + i };
    const take: Take = { seed: next.seed, motion: new Motion(skeleton.joints, dancer.fps) };
    others.push(take);
    await dancer.stream(next, null, -1, { ...silent, grown: (grown) => {
      if (take.motion === grown || moment.value !== before) return;
      take.motion = grown;
      takes.value = others.filter(({ motion: some }) => some.count > 0);
    } }, signal);
  }));
}

export function keepTake(take: Take) {
  const { motion: kept, seed } = take;
  if (kept.count < total.value) return tell('This take is not danced to its end yet.');
  push({ ...project.value, seed }, kept, async () => kept, warnings.value);
  tell('Kept.');
}
