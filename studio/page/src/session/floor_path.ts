// The path over the floor, drawn on the stage and followed in a part of the dance.
import type { Pose } from '../project/body';
import { total, danceFrom } from './history';
import { dancer } from './link';
import type { Key, Spot, Step } from '../project/project';
import { audio } from './songs';
import { selection, motion, project, notify } from '../project/state';
import { signal } from '@preact/signals';

/// Whether the next stroke on the stage draws a path.
export const drawing = signal(false);

const apart = 8; // frames between steps
const same = 1e-3; // metres; a nearer key stays where it is
const shortest = 15; // frames of a path
export const least = 0.3; // metres; shorter strokes are accidental

export const away = (a: Spot, b: Spot) => Math.hypot(a.x - b.x, a.z - b.z);
const between = (a: Spot, b: Spot, share: number): Spot => ({ x: a.x + (b.x - a.x) * share, z: a.z + (b.z - a.z) * share });

export const lengthOf = (spots: Spot[]) => spots.slice(1).reduce((sum, spot, i) => sum + away(spots[i], spot), 0);

/// Smooths a hand-drawn stroke by moving each spot towards its neighbours.
function smooth(spots: Spot[]): Spot[] {
  let out = spots;
  for (let round = 0; round < 4; ++round)
    out = out.map((spot, i) => (i === 0 || i === out.length - 1 ? spot : between(spot, between(out[i - 1], out[i + 1], 0.5), 0.5)));
  return out;
}

/// A stroke as a path at constant speed between two frames.
function paced(spots: Spot[], from: number, to: number): Step[] {
  const count = Math.max(1, Math.round((to - from) / apart));
  const length = lengthOf(spots);
  const out: Step[] = [];
  let leg = 0;
  let before = 0; // metres up to this leg
  for (let i = 0; i <= count; ++i) {
    const wanted = (length * i) / count;
    while (leg < spots.length - 2 && before + away(spots[leg], spots[leg + 1]) < wanted) before += away(spots[leg], spots[++leg]);
    const span = away(spots[leg], spots[leg + 1]);
    const { x, z } = between(spots[leg], spots[leg + 1], span ? Math.min(1, (wanted - before) / span) : 0);
    out.push({ frame: Math.round(from + ((to - from) * i) / count), x, z });
  }
  return out;
}

/// The position on the path at a frame; null outside the path.
export function spotAt(path: Step[], frame: number): Spot | null {
  const next = path.findIndex((step) => step.frame >= frame);
  if (next < 0 || (next === 0 && path[0].frame > frame)) return null;
  if (next === 0) return path[0];
  const [a, b] = [path[next - 1], path[next]];
  return between(a, b, (frame - a.frame) / (b.frame - a.frame));
}

/// Moves a key to the path at its frame; otherwise the key would bend the path.
export function onPath(path: Step[], key: Key): Key {
  const spot = spotAt(path, key.frame);
  if (!spot || !key.hasPlace || away(spot, { x: key.pose.root[0], z: key.pose.root[2] }) < same) return key;
  const pose: Pose = { ...key.pose, root: [spot.x, key.pose.root[1], spot.z] };
  return { ...key, pose };
}

/// The frames for the next stroke: the selected interval, or from the playhead to the end.
export function stretch(): [number, number] {
  if (selection.value) return selection.value;
  const from = Math.round(audio.currentTime * dancer.fps);
  return from < total.value - dancer.fps ? [from, total.value - 1] : [0, total.value - 1];
}

/// Dances anew from the last unchanged key at or before the first touched frame.
function put(path: Step[], touched: number[]) {
  const before = project.value.keys;
  const keys = before.map((key) => onPath(path, key));
  const from = keys.findLast((key, i) => key === before[i] && key.frame <= Math.min(...touched))?.frame ?? -1;
  danceFrom({ ...project.value, path, keys }, from);
}

/// Uses a stroke as the path. Moves it to begin at the dancer, who would otherwise first walk
/// there.
export function drawPath(stroke: Spot[]) {
  drawing.value = false;
  const [from, to] = stretch();
  const before = from > 0 && motion.value.count > from ? motion.value.pose(from).root : null;
  const spots = smooth(before ? [{ x: before[0], z: before[2] }, ...stroke] : stroke);
  if (lengthOf(stroke) < least) return notify(`That was a stroke of ${lengthOf(stroke).toFixed(1)} m; a path is at least ${least} m long.`);
  walk(spots, from, to);
}

/// Uses these spots as the path, at constant speed between two frames.
export function walk(spots: Spot[], from: number, to: number) {
  put(paced(spots, from, to), [from, project.value.path[0]?.frame ?? from]);
}

export const clearPath = () => put([], [project.value.path[0].frame]);

/// The same path with other frames.
export function rush(from: number, to: number) {
  const { path } = project.value;
  if (to - from < shortest) return notify(`A path takes at least ${(shortest / dancer.fps).toFixed(1)} s.`);
  put(paced(path, from, to), [path[0].frame, from]);
}
