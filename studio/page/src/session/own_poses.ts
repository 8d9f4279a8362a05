// The user's own poses, stored in this browser.
import { create } from '@bufbuild/protobuf';
import { signal } from '@preact/signals';
import type { Pose } from '../project/body';
import { LibraryPoseSchema } from '../generated/studio/studio_pb';
import type { LibraryPose } from '../generated/studio/studio_pb';
import { showError, notify } from '../project/state';

const place = 'choreo poses';
const most = 200;
type Kept = { id: string; height: number; rotations: number[] };

const asLibrary = ({ id, height, rotations }: Kept): LibraryPose =>
  create(LibraryPoseSchema, { id, description: 'Yours', pose: { rootPosition: { x: 0, y: height, z: 0 }, rotations } });

const isNumber = (value: unknown) => typeof value === 'number' && Number.isFinite(value);
const isKept = (value: unknown): value is Kept => {
  const kept = value as Kept | null;
  return typeof kept?.id === 'string' && isNumber(kept.height) && Array.isArray(kept.rotations) && kept.rotations.every(isNumber);
};

function read(): Kept[] {
  try {
    const all: unknown = JSON.parse(localStorage.getItem(place) ?? '[]');
    return Array.isArray(all) ? all.filter(isKept) : [];
  } catch {
    return [];
  }
}

const kept = signal(read());

/// Own poses for a body with this many joints.
export const ownPoses = (joints: number) => kept.value.filter(({ rotations }) => rotations.length === 3 * joints).map(asLibrary);

function keep(all: Kept[]) {
  kept.value = all;
  try {
    localStorage.setItem(place, JSON.stringify(all));
  } catch {
    showError(new Error('This browser cannot store poses: they are lost when this page closes.'));
  }
}

/// Stores a pose at the origin under a free name, which it reports.
export function addPose(name: string, pose: Pose) {
  let id = name;
  for (let i = 2; kept.value.some((other) => other.id === id); ++i) id = `${name}_${i}`;
  keep([{ id, height: pose.root[1], rotations: pose.rotations }, ...kept.value].slice(0, most));
  notify(`Added to the poses as ${id}.`);
}

export const forgetPose = (id: string) => keep(kept.value.filter((other) => other.id !== id));
