// What people make: key poses, and how to dance between them.
import type { Pose } from './body';
import type { Beats } from './counts';

/// A place on the floor; metres.
export type Spot = { x: number; z: number };
/// Where the dancer is to be at a frame. A path has at least two, in order of time.
export type Step = Spot & { frame: number };

/// A key pose. Without a place it asks for the pose alone, wherever the dancer is. `asks`: the joints that it asks for, in order; null:
/// all of them.
export type Key = { id: string; frame: number; pose: Pose; hasPlace: boolean; asks: number[] | null };

/// Keys stand at least so many frames apart (kMinKeyDistance of the program).
export const closest = 2;

export const parts = ['trunk', 'left arm', 'right arm', 'left leg', 'right leg'];

/// What the program does where nothing is said: kUsualDynamics, kUsualVariation.
const [usualDynamics, usualVariation] = [0.5, 0.3];
const usuallyApart = 0.2; // metres (kUsuallyApart)

/// One of several dancers. She dances as all do, but for what she says.
export type Partner = Spot & {
  id: string;
  /// Degrees that her dance is turned.
  facing: number;
  mirrored: boolean;
  /// Counts, or seconds, that she comes later.
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
  /// One of the model's; empty: as it comes.
  style: string;
  /// How much the music's energy is that of the dance, 0 to 1.
  dynamics: number;
  /// How much the dance to music that comes back differs, 0 to 1.
  variation: number;
  /// Of the song, where they are not as the program hears them.
  beats: Beats | null;
  /// How lively each of `parts` is; 1 is as usual.
  lively: number[];
  /// Where the dancer goes; empty: anywhere.
  path: Step[];
  /// By frame.
  keys: Key[];
  /// Two or more who dance it together; empty: one does.
  dancers: Partner[];
  /// Metres that stay between two of them at least.
  apart: number;
};

/// How a dance should be, whatever its music and its keys.
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
