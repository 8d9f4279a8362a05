// A project as a readable JSON file: `choreo dance --project FILE` dances it, and it is a key file, too.
import type { Beats } from './counts';
import { limits } from './limits';
import { emptyProject, parts, round, sorted, trimmed, withHolds } from './project';
import type { Key, Marker, Project, Step } from './project';

const format = 1; // version of the file format

type Json = Record<string, unknown>;
/// What a project must be compatible with.
export type Known = { fps: number; styles: string[] };


/// The dancers of a project, in the form of a dancers' file; with keys of their own as `said`.
export const dancersJson = ({ dancers, apart }: Project, said?: (keys: Key[]) => Json[]) => ({
  dancers: dancers.map(({ id, x, z, facing, mirrored, after, inCounts, seed, style, keys }) => ({
    id,
    place: [round(x), round(z)],
    ...(facing ? { facing } : {}),
    ...(mirrored ? { mirrored } : {}),
    ...(after ? { after: inCounts ? `${after} counts` : after } : {}),
    ...(seed === null ? {} : { seed }),
    ...(style ? { style } : {}),
    ...(said && keys ? { keyframes: keys.length ? said(keys) : 'none' } : {}),
  })),
  apart,
});

export function toJson(project: Project, fps: number, names: string[]): string {
  const said = (keys: Key[]) => trimmed(keys, Math.round(project.seconds * fps), fps).map(({ id, frame, pose, hasPlace, asks, hold, hit, hands }) => ({
    id,
    time: round(frame / fps),
    ...(hold ? { hold: round(hold / fps) } : {}),
    ...(hit === null ? {} : { hit }),
    ...(hands ? { hands } : {}),
    ...(asks ? { joints: asks.map((joint) => names[joint]) } : {}),
    ...(hasPlace ? { root_position: pose.root.map(round) } : {}),
    rotations: Array.from({ length: pose.rotations.length / 3 }, (_, joint) =>
      pose.rotations.slice(3 * joint, 3 * joint + 3).map(round),
    ),
  }));
  const keyframes = said(project.keys);
  const { song, seconds, seed, style, dynamics, variation, beats } = project;
  const path = { points: project.path.map(({ frame, x, z }) => ({ frame, x: round(x), z: round(z) })) };
  const lively = Object.fromEntries(parts.map((part, i) => [part, project.lively[i]]));
  const markers = project.markers.map(({ frame, name }) => ({ time: round(frame / fps), name }));
  const text = JSON.stringify({ studio: format, song, seconds, seed, style, music_dynamics: dynamics, variation,
    ...(beats ? { bar: beats.bar, beats: beats.list.map(({ time, count }) => [time, count]) } : {}), lively, ...(path.points.length ? { path } : {}),
    ...(markers.length ? { markers } : {}), ...(project.dancers.length ? dancersJson(project, said) : {}), keyframes }, null, 1);
  // Puts each vector, beat, place and list of joints on one line.
  return text.replace(/\[\s+(-?[\d.e-]+),\s+(-?[\d.e-]+),\s+(-?[\d.e-]+)\s+\]/g, '[$1, $2, $3]')
    .replace(/\[\s+(-?[\d.e-]+),\s+(-?[\d.e-]+)\s+\]/g, '[$1, $2]')
    .replace(/"joints": \[\s+([^\]]*?)\s+\]/g, (_, joints: string) => `"joints": [${joints.replace(/\s*\n\s*/g, ' ')}]`)
    .replace(/\{\s+"time": ([\d.e-]+),\s+("name": ".*")\s+\}/g, '{"time": $1, $2}')
    .replace(/\{\s+"frame": (\d+),\s+"x": (-?[\d.e-]+),\s+"z": (-?[\d.e-]+)\s+\}/g, '{"frame": $1, "x": $2, "z": $3}') + '\n';
}

const shown = (value: unknown) => (JSON.stringify(value) ?? 'nothing').slice(0, 40);

function number(value: unknown, where: string, from: number, to: number): number {
  if (typeof value !== 'number' || !(value >= from && value <= to))
    throw new Error(`${where}: ${shown(value)} is not a number from ${from} to ${to}.`);
  return value;
}

function parse(text: string, name: string): Json {
  let json: unknown = null;
  try {
    json = JSON.parse(text);
  } catch {
    throw new Error(`${name} is no JSON.`);
  }
  if (typeof json !== 'object' || json === null || !Array.isArray((json as Json).keyframes))
    throw new Error(`${name} has no list "keyframes": it is neither a project nor a key file.`);
  return json as Json;
}

function readPath(path: Json, name: string, known: Known): Step[] {
  if (typeof path !== 'object' || path === null || !Array.isArray(path.points)) throw new Error(`${name}: path has no list "points".`);
  const steps = path.points.map((point: Json | null, i): Step => {
    const at = `${name}: path.points[${i}]`;
    if (typeof point !== 'object' || point === null) throw new Error(`${at}: ${shown(point)} is no point.`);
    if ('y' in point) throw new Error(`${at}.y: the studio's paths lie on the floor.`);
    const frame = Math.round('frame' in point
      ? number(point.frame, `${at}.frame`, 0, limits.danceS * known.fps)
      : number(point.time, `${at}.time`, 0, limits.danceS) * known.fps);
    return { frame, x: number(point.x, `${at}.x`, -limits.positionM, limits.positionM), z: number(point.z, `${at}.z`, -limits.positionM, limits.positionM) };
  });
  if (steps.length < 2) throw new Error(`${name}: path.points: ${steps.length} points, a path has at least 2.`);
  const back = steps.findIndex((step, i) => i > 0 && step.frame <= steps[i - 1].frame);
  if (back > 0) throw new Error(`${name}: path.points[${back}] does not come after the point before it.`);
  return steps;
}

function readBeats({ beats, bar = 4 }: Json, name: string): Beats {
  if (!Array.isArray(beats)) throw new Error(`${name}: beats: ${shown(beats)} is no list.`);
  const count = (value: unknown, where: string) => {
    if (!Number.isInteger(value)) throw new Error(`${where}: ${shown(value)} is no count.`);
    return number(value, where, 1, limits.beatsInBar);
  };
  const list = beats.map((beat: unknown, i) => {
    const at = `${name}: beats[${i}]`;
    if (!Array.isArray(beat) || beat.length !== 2) throw new Error(`${at}: ${shown(beat)} is no beat: its second and its count.`);
    return { time: number(beat[0], at, 0, limits.songS), count: count(beat[1], at) };
  });
  const back = list.findIndex(({ time }, i) => i > 0 && time <= list[i - 1].time);
  if (back > 0) throw new Error(`${name}: beats[${back}] does not come after the beat before it.`);
  return { bar: count(bar, `${name}: bar`), list };
}

function readMarkers(list: unknown, name: string, fps: number): Marker[] {
  if (!Array.isArray(list)) throw new Error(`${name}: markers: ${shown(list)} is no list.`);
  const markers = list.map((marker: Json | null, i): Marker => {
    const at = `${name}: markers[${i}]`;
    if (typeof marker !== 'object' || marker === null) throw new Error(`${at}: ${shown(marker)} is no marker: its time and its name.`);
    if (typeof marker.name !== 'string' || marker.name === '') throw new Error(`${at}.name: ${shown(marker.name)} is no name.`);
    return { frame: Math.round(number(marker.time, `${at}.time`, 0, limits.danceS) * fps), name: marker.name };
  });
  const back = markers.findIndex(({ frame }, i) => i > 0 && frame <= markers[i - 1].frame);
  if (back > 0) throw new Error(`${name}: markers[${back}] does not come after the marker before it.`);
  return markers;
}

/// The keys of a file as read by the program, in order. Throws for keys that do not fit a dance here.
export function inOrder(keys: Key[], name: string, fps: number): Key[] {
  for (const { id, frame, pose } of keys) {
    if (!(frame >= 0 && frame <= limits.danceS * fps)) throw new Error(`${name}: the key "${id}" stands at ${frame / fps} s, and may from 0 to ${limits.danceS}.`);
    if (!pose.root.every((value) => Math.abs(value) <= limits.positionM)) throw new Error(`${name}: the key "${id}" is more than ${limits.positionM} m away.`);
  }
  const list = sorted(keys);
  list.forEach(({ id, frame }, i) => {
    if (i > 0 && frame - list[i - 1].frame < limits.keyDistance)
      throw new Error(`${name}: the keys "${list[i - 1].id}" and "${id}" stand closer than ${limits.keyDistance} frames.`);
  });
  return withHolds(list);
}

/// Reads a project or a key file, except its keys, which the program reads. Throws if it is unusable, naming member, value and limit; `tell` receives
/// notes on what is left out.
export function fromJson(text: string, name: string, known: Known, tell: (words: string) => void): Project {
  const json = parse(text, name);
  if (json.studio !== undefined && json.studio !== format)
    throw new Error(`${name} is of format ${shown(json.studio)}; this studio knows ${format}. It was saved by another version.`);
  const at = (member: string) => `${name}: ${member}`;
  const project = emptyProject(typeof json.song === 'string' ? json.song : '', 0);
  if (json.seconds !== undefined) project.seconds = number(json.seconds, at('seconds'), 0, limits.danceS);
  if (json.seed !== undefined) project.seed = Math.round(number(json.seed, at('seed'), 0, Number.MAX_SAFE_INTEGER));
  if (typeof json.style === 'string') project.style = json.style;
  if (project.style && !known.styles.includes(project.style)) {
    tell(`The model has no style "${project.style}", only ${known.styles.join(', ') || 'none'}.`);
    project.style = '';
  }
  project.dynamics = number(json.music_dynamics ?? project.dynamics, at('music_dynamics'), 0, 1);
  project.variation = number(json.variation ?? project.variation, at('variation'), 0, 1);
  if (json.beats !== undefined) project.beats = readBeats(json, name);
  const lively = (json.lively ?? {}) as Json;
  project.lively = parts.map((part) => number(lively[part] ?? 1, at(`lively.${part}`), 0, limits.velocityFactor));
  if (json.markers !== undefined) project.markers = readMarkers(json.markers, name, known.fps);
  if (json.path !== undefined) project.path = readPath(json.path as Json, name, known);
  return project;
}
