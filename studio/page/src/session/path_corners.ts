// The corners of the floor path, for editing one by one; a drawn path has few, too.
import { computed, signal } from '@preact/signals';
import { heading } from '../project/body';
import { away, clearPath, least, lengthOf, stretch, walk } from './floor_path';
import type { Spot, Step } from '../project/project';
import { live, moment, motion, project, notify } from '../project/state';
import type { Moment } from '../project/state';

const near = 0.08; // metres; smaller bends are not corners
const onward = 0.5; // metres from the last point to a new one
const rest = 600; // ms from the last change until dancing

/// The corners being edited, and their frames.
const draft = signal<{ spots: Spot[]; from: number; to: number; of: Moment } | null>(null);
/// The corners as set, and the path made from them.
const walked = signal<{ path: Step[]; spots: Spot[] } | null>(null);
let resting: ReturnType<typeof setTimeout>;

export const areCornersShown = signal(false);
/// The corner being moved.
export const heldCorner = signal(0);

/// The distance of a spot from the line between two others.
function aside(spot: Spot, a: Spot, b: Spot): number {
  const length = away(a, b);
  if (length < 1e-6) return away(spot, a);
  const share = ((spot.x - a.x) * (b.x - a.x) + (spot.z - a.z) * (b.z - a.z)) / length ** 2;
  const on = Math.min(1, Math.max(0, share));
  return away(spot, { x: a.x + on * (b.x - a.x), z: a.z + on * (b.z - a.z) });
}

/// The essential spots of a line (Douglas and Peucker).
function cornersOf(spots: Spot[]): Spot[] {
  if (spots.length < 3) return spots.map(({ x, z }) => ({ x, z }));
  const [first, last] = [spots[0], spots.at(-1)!];
  const off = spots.map((spot) => aside(spot, first, last));
  const far = off.indexOf(Math.max(...off));
  if (off[far] < near) return cornersOf([first, last]);
  return [...cornersOf(spots.slice(0, far + 1)).slice(0, -1), ...cornersOf(spots.slice(far))];
}

/// The corners, as edited.
export const draftCorners = computed(() => (draft.value?.of === moment.value ? draft.value?.spots ?? null : null));
export const corners = computed((): Spot[] => {
  const path = project.value?.path ?? [];
  return draftCorners.value ?? (walked.value?.path === path ? walked.value.spots : cornersOf(path));
});

/// Sets corners: shown at once, danced after a pause.
export function setCorners(spots: Spot[]) {
  const { path } = project.value;
  const [from, to] = draft.value?.of === moment.value ? [draft.value!.from, draft.value!.to] : path.length ? [path[0].frame, path.at(-1)!.frame] : stretch();
  draft.value = { spots, from, to, of: moment.value };
  clearTimeout(resting);
  resting = setTimeout(take, rest);
}

function take() {
  const last = draft.value;
  if (live.value || last?.of !== moment.value) return void (draft.value = null);
  if (last.spots.length === 0 && project.value.path.length > 0) clearPath();
  // A single point waits for a second one.
  if (last.spots.length < 2) return;
  if (lengthOf(last.spots) < least) return void notify(`This path has ${lengthOf(last.spots).toFixed(1)} m; one that is walked has ${least} at least.`);
  walk(last.spots, last.from, last.to);
  walked.value = { path: project.value.path, spots: last.spots };
}

/// Adds a point in the direction of the last two; the first two lead ahead from the dancer.
export function addCorner() {
  const spots = corners.value;
  const last = spots.at(-1);
  if (!last) {
    const [from] = stretch();
    if (motion.value.count === 0) return;
    const here = motion.value.pose(from);
    const [x, z] = [here.root[0], here.root[2]];
    const way = heading(here);
    heldCorner.value = 1;
    return setCorners([{ x, z }, { x: x + Math.sin(way), z: z + Math.cos(way) }]);
  }
  const before = spots.at(-2) ?? { x: last.x, z: last.z - 1 };
  const length = away(last, before) || 1;
  heldCorner.value = spots.length;
  setCorners([...spots, { x: last.x + (onward * (last.x - before.x)) / length, z: last.z + (onward * (last.z - before.z)) / length }]);
}
