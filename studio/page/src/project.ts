// What people make: a readable JSON file, which `choreo dance SONG --keyframes FILE` takes as well.
import type { Pose, Triple } from './body';

/// A key pose. Without a place it asks for the pose alone, wherever the dancer is.
export type Key = { id: string; frame: number; pose: Pose; hasPlace: boolean };

export const parts = ['trunk', 'left arm', 'right arm', 'left leg', 'right leg'];

export type Project = {
  song: string;
  seconds: number;
  seed: number;
  /// How lively each of `parts` is; 1 is as usual.
  lively: number[];
  /// By frame.
  keys: Key[];
};

export const emptyProject = (song: string, seconds: number): Project => ({
  song,
  seconds,
  seed: 1,
  lively: parts.map(() => 1),
  keys: [],
});

export const sorted = (keys: Key[]) => [...keys].sort((a, b) => a.frame - b.frame);

/// An id that no key has: "kick", "kick-2", ...
export const freeId = (keys: Key[], name: string) => {
  const base = name.replace(/-\d+$/, '');
  let id = base;
  for (let i = 2; keys.some((key) => key.id === id); ++i) id = `${base}-${i}`;
  return id;
};

const round = (value: number) => Math.round(value * 1e5) / 1e5;

export function toJson(project: Project, fps: number): string {
  const keyframes = project.keys.map(({ id, frame, pose, hasPlace }) => ({
    id,
    time: round(frame / fps),
    ...(hasPlace ? { root_position: pose.root.map(round) } : {}),
    rotations: Array.from({ length: pose.rotations.length / 3 }, (_, joint) =>
      pose.rotations.slice(3 * joint, 3 * joint + 3).map(round),
    ),
  }));
  const { song, seconds, seed } = project;
  const lively = Object.fromEntries(parts.map((part, i) => [part, project.lively[i]]));
  const text = JSON.stringify({ studio: 1, song, seconds, seed, lively, keyframes }, null, 1);
  // A line for each vector, not for each number.
  return text.replace(/\[\s+(-?[\d.e-]+),\s+(-?[\d.e-]+),\s+(-?[\d.e-]+)\s+\]/g, '[$1, $2, $3]') + '\n';
}

export function fromJson(text: string, joints: number, fps: number): Project {
  const json = JSON.parse(text);
  if (!Array.isArray(json.keyframes)) throw new Error('This file has no list "keyframes".');
  const numbers = (value: unknown, count: number, what: string): number[] => {
    const flat = Array.isArray(value) ? value.flat() : [];
    if (flat.length !== count || !flat.every((x) => typeof x === 'number' && isFinite(x)))
      throw new Error(`${what} should be ${count} numbers.`);
    return flat;
  };
  const keys = json.keyframes.map((key: Record<string, unknown>, i: number): Key => {
    const where = `keyframes[${i}]`;
    const frame = typeof key.frame === 'number' ? key.frame : Math.round(Number(key.time) * fps);
    if (!(frame >= 0)) throw new Error(`${where}.time should be a number of seconds.`);
    const rotations = numbers(key.rotations, 3 * joints, `${where}.rotations`);
    const hasPlace = key.root_position !== undefined;
    const root = hasPlace ? numbers(key.root_position, 3, `${where}.root_position`) : [0, 0.9, 0];
    const id = typeof key.id === 'string' ? key.id : `key${i + 1}`;
    return { id, frame, pose: { root: root as Triple, rotations }, hasPlace };
  });
  const seconds = Number(json.seconds) || 0;
  const project = emptyProject(typeof json.song === 'string' ? json.song : '', seconds);
  project.seed = Number(json.seed ?? 1);
  project.lively = parts.map((part) => Number(json.lively?.[part] ?? 1));
  project.keys = sorted(keys);
  return project;
}
