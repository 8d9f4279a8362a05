// Several dancers: their settings, their dances, and the distance between them.
import { computed, effect, signal } from '@preact/signals';
import { beats } from './beats';
import type { Clip, Formation } from '../generated/studio/studio_pb';
import { later } from '../project/counts';
import { change, note } from './history';
import { limits } from '../project/limits';
import { dancer, wire } from './link';
import type { Motion } from '../project/motion';
import { dancersMessage } from '../project/project_file';
import type { Partner, Project, Spot } from '../project/project';
import { busy, showError, live, moment, project, selectedKey } from '../project/state';
import type { Moment, Song } from '../project/state';

const beside = 1.4; // metres between a new dancer and the last one
const behind = 0.4; // metres that a new dancer stands further back

/// A dance whose seed, keys or style differ from the project's, and its inputs.
type Other = { project: Project; song: Song | null; motion: Motion };
let others: Other[] = [];
let forming: AbortController | null = null;

const madeOf = ({ dancers: _, apart: __, markers: ___, ...rest }: Project) => rest;
const isSame = (a: Project, b: Project) => Object.entries(madeOf(a)).every(([name, value]) => value === b[name as keyof Project]);
const ownProject = (all: Project, { seed, style, keys }: Partner): Project => ({ ...all, seed: seed ?? all.seed, style: style || all.style, keys: keys ?? all.keys });

/// The program's formation of the present dancers and their dances, with the index of each dancer's dance.
export const formation = signal<{ of: Moment; reply: Formation; dances: Motion[]; danceOf: number[] } | null>(null);

/// Makes each dance of a moment that differs from the project's, once.
async function dancesOf(now: Moment, signal: AbortSignal) {
  // Continues a dance that was left unfinished.
  for (let there: Moment['ready'] | null = null; there !== now.ready; await there) there = now.ready;
  const dances = [now.motion.value];
  const kinds = [now.project];
  const used: Other[] = [];
  const danceOf: number[] = [];
  for (const partner of now.project.dancers) {
    const own = ownProject(now.project, partner);
    let nth = kinds.findIndex((kind) => isSame(kind, own));
    if (nth < 0) {
      let known = others.find((other) => other.song === now.song && isSame(other.project, own));
      const count = dances[0].count;
      if (!known || known.motion.count !== count)
        known = { project: own, song: now.song, motion: await dancer.stream(own, null, -1, { onFrames: () => {}, onWarning: () => {} }, signal) };
      if (signal.aborted) return null;
      used.push(known);
      nth = kinds.push(own) - 1;
      dances.push(known.motion.head(count));
    }
    danceOf.push(nth);
  }
  others = used;
  return { dances, danceOf };
}

const requestOf = (all: Project, more: { dances: Clip[]; danceOf: number[]; name?: string }) => ({
  project: dancersMessage(all),
  beats: beats.value.list.map(({ time }) => time),
  ...more,
});

async function form(now: Moment, signal: AbortSignal) {
  busy.value += 1;
  try {
    const danced = await dancesOf(now, signal);
    if (!danced || signal.aborted || danced.dances[0].count === 0) return;
    const clips = danced.dances.map((dance) => dance.toClip());
    const answer = await wire.request({ case: 'company', value: requestOf(now.project, { dances: clips, danceOf: danced.danceOf }) });
    if (answer.case === 'formation' && !signal.aborted) formation.value = { of: now, reply: answer.value, ...danced };
  } catch (error) {
    if (!signal.aborted) showError(error);
  } finally {
    busy.value -= 1;
  }
}

effect(() => {
  const now = moment.value;
  forming?.abort();
  if (!now || live.value || now.project.dancers.length === 0) return void (formation.value = null);
  forming = new AbortController();
  const { signal } = forming;
  // Outside the effect, which must not depend on its own changes.
  queueMicrotask(() => void form(now, signal));
});

/// A dancer for the stage, relative to the project's own dance. `isLead`: she has exactly that dance.
export type Cast = { motion: Motion | null; after: number; mirrored: boolean; x: number; z: number; facing: number; isLead: boolean };

const radians = Math.PI / 180;

export const cast = computed((): Cast[] => {
  const partners = live.value ? [] : project.value?.dancers ?? [];
  if (partners.length === 0) return [];
  const formed = formation.value;
  const isKnown = formed?.danceOf.length === partners.length;
  const widened = isKnown ? formed.reply.widened : 1;
  const middle = (axis: 'x' | 'z') => partners.reduce((sum, partner) => sum + partner[axis] / partners.length, 0);
  const [x, z] = [middle('x'), middle('z')];
  const place = (partner: Partner): Spot => ({ x: x + widened * (partner.x - x), z: z + widened * (partner.z - z) });
  const isOther = (partner: Partner) => !isSame(ownProject(project.value, partner), project.value);
  const lead = partners.findIndex((partner) => !partner.mirrored && partner.after === 0 && !isOther(partner));
  const from = lead < 0 ? { x: 0, z: 0, facing: 0 } : { ...place(partners[lead]), facing: partners[lead].facing };
  const [sin, cos] = [Math.sin(from.facing * radians), Math.cos(from.facing * radians)];
  return partners.map((partner, i) => {
    const { x: px, z: pz } = place(partner);
    const [dx, dz] = [px - from.x, pz - from.z];
    const other = isOther(partner);
    return {
      motion: other ? (isKnown && formed.danceOf[i] > 0 ? formed.dances[formed.danceOf[i]] : null) : null,
      after: secondsLater(partner), mirrored: partner.mirrored,
      x: dx * cos - dz * sin, z: dx * sin + dz * cos, facing: (partner.facing - from.facing) * radians, isLead: i === lead,
    };
  });
});

/// Counts are converted with the tempo at the music's beginning.
function secondsLater({ after, inCounts }: Partner): number {
  const times = beats.value.list.map(({ time }) => time);
  if (!inCounts || times.length < 2) return after;
  return later(times[0], after, times) - times[0];
}

/// All dancers as files of one format, as the command line writes them.
export async function writeCompany(name: string, now: Moment) {
  const danced = await dancesOf(now, new AbortController().signal);
  const answer = await wire.request({ case: 'company', value: requestOf(now.project, { dances: danced!.dances.map((dance) => dance.toClip()), danceOf: danced!.danceOf, name }) });
  return answer.case === 'formation' ? answer.value.files : [];
}

const changeAll = (dancers: Partner[]) => note({ dancers });
export const changePartner = (nth: number, what: Partial<Partner>) =>
  changeAll(project.value.dancers.map((old, i) => (i === nth ? { ...old, ...what } : old)));

/// Makes one dancer's dance the edited one; the others keep their dances.
export function workOnDanceOf(nth: number) {
  const { value } = project;
  const mine = ownProject(value, value.dancers[nth]);
  const dancers = value.dancers.map((partner, i) => {
    const own = i === nth ? mine : ownProject(value, partner);
    return { ...partner, keys: own.keys === mine.keys ? null : own.keys, seed: own.seed === mine.seed ? null : own.seed };
  });
  selectedKey.value = null;
  change({ keys: mine.keys, seed: mine.seed, dancers });
}

/// A single remaining dancer is no longer a company.
export function removePartner(nth: number) {
  const left = project.value.dancers.filter((_, i) => i !== nth);
  changeAll(left.length > 1 ? left : []);
}

/// Turns each dancer to the nearest other one, as they begin.
export function faceEachOther() {
  const { dancers } = project.value;
  const away = (a: Partner, b: Partner) => Math.hypot(b.x - a.x, b.z - a.z);
  changeAll(dancers.map((one) => {
    const [other] = dancers.filter((partner) => partner !== one).sort((a, b) => away(one, a) - away(one, b));
    return { ...one, facing: Math.round((Math.atan2(other.x - one.x, other.z - one.z) * 180) / Math.PI) };
  }));
}

/// Adds a dancer beside the others, on alternating sides; the first call makes the present dancer one of two.
export function addPartner() {
  const { dancers } = project.value;
  if (dancers.length >= limits.dancers) return;
  const named = (all: Partner[], spot: Spot): Partner => {
    let number = all.length + 1;
    while (all.some(({ id }) => id === `dancer${number}`)) ++number;
    return { id: `dancer${number}`, ...spot, facing: 0, mirrored: false, after: 0, inCounts: true, seed: null, style: '', keys: null };
  };
  const all = dancers.length ? dancers : [named([], { x: 0, z: 0 })];
  const isFree = (spot: Spot) => all.every(({ x, z }) => Math.hypot(x - spot.x, z - spot.z) > beside / 2);
  for (let nth = 1; ; ++nth) {
    const away = Math.ceil(nth / 2);
    const spot = { x: beside * away * (nth % 2 ? 1 : -1), z: Math.round(-100 * behind * away) / 100 };
    if (isFree(spot)) return changeAll([...all, named(all, spot)]);
  }
}

/// The colour of a dancer's shirt, by number: the lead wears the body's own.
export function shirtNumber(nth: number): number {
  const lead = cast.value.findIndex(({ isLead }) => isLead);
  return nth === lead ? 0 : lead < 0 || nth < lead ? nth + 1 : nth;
}
