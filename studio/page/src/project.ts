// A project: key poses, and how to dance between them.
import type { Pose } from './body';
import type { Beats } from './counts';

/// A place on the floor; metres.
export type Spot = { x: number; z: number };
/// A point of a path at a frame. A path has at least two, in order of time.
export type Step = Spot & { frame: number };

/// A key pose. Without a place it applies wherever the dancer is. `asks`: the joints that it fixes, in order; null: all of them.
export type Key = { id: string; frame: number; pose: Pose; hasPlace: boolean; asks: number[] | null };

/// The least distance between keys, frames (the program's kMinKeyDistance).
export const closest = 2;

export const parts = ['trunk', 'left arm', 'right arm', 'left leg', 'right leg'];

/// The program's defaults: kUsualDynamics, kUsualVariation.
const [usualDynamics, usualVariation] = [0.5, 0.3];
const usuallyApart = 0.2; // metres (kUsuallyApart)

/// One of several dancers, with the settings in which she differs.
export type Partner = Spot & {
  id: string;
  /// The rotation of her dance, degrees.
  facing: number;
  mirrored: boolean;
  /// Her delay, counts or seconds.
  after: number;
  inCounts: boolean;
  seed: number | null;
  /// Empty: the project's.
  style: string;
};

export type Project = {
  song: string;
  seconds: number;
  seed: number;
  /// One of the model's; empty: any.
  style: string;
  /// How closely the dance's energy follows the music's, 0 to 1.
  dynamics: number;
  /// How much the dance to repeated music varies, 0 to 1.
  variation: number;
  /// The song's beats, if they differ from the program's.
  beats: Beats | null;
  /// The liveliness of each of `parts`; 1 is usual.
  lively: number[];
  /// The floor path; empty: free.
  path: Step[];
  /// In order of frames.
  keys: Key[];
  /// Two or more dancers; empty: a single one.
  dancers: Partner[];
  /// The least distance between two of them, metres.
  apart: number;
};

/// The settings that are independent of music and keys.
export const wishes = ({ style, dynamics, variation, lively, path }: Project) => ({ style, dynamics, variation, lively, path });

export const emptyProject = (song: string, seconds: number): Project => ({
  song,
  seconds,
  seed: 1,
  style: '',
  dynamics: usualDynamics,
  variation: usualVariation,
  beats: null,
  lively: parts.map(() => 1),
  path: [],
  keys: [],
  dancers: [],
  apart: usuallyApart,
});

export const sorted = (keys: Key[]) => [...keys].sort((a, b) => a.frame - b.frame);

/// An id or a joint's name, for people.
export const spoken = (name: string) => name.replaceAll('_', ' ');

/// An id that no key has: "kick", "kick-2", ...
export const freeId = (keys: Key[], name: string) => {
  const base = name.replace(/-\d+$/, '');
  let id = base;
  for (let i = 2; keys.some((key) => key.id === id); ++i) id = `${base}-${i}`;
  return id;
};
