// A project: key poses, and how to dance between them.
import type { DescEnum } from '@bufbuild/protobuf';
import type { Pose } from './body';
import type { Beats } from './counts';
import { BodyPartSchema, HandPoseSchema } from '../generated/choreo/v1/choreography_pb';
import type { HandPose } from '../generated/choreo/v1/choreography_pb';
import { limits } from './limits';

/// A place on the floor; metres.
export type Spot = { x: number; z: number };
/// A point of a path at a frame. A path has at least two, in order of time.
export type Step = Spot & { frame: number };

/// The names of the API's enumerators from number 1 on: "left arm".
const namesOf = ({ values }: DescEnum) => values.slice(1).map(({ localName }) => localName.toLowerCase().replaceAll('_', ' '));
/// In the order of HandPose and of BodyPart.
export const [handPoses, parts] = [namesOf(HandPoseSchema), namesOf(BodyPartSchema)];

/// A key pose. Without a place it fixes only the pose, wherever the dancer is. `joints`: those
/// that it fixes, in order; null: all. `hold`: frames for which its pose is held. `hit`: how hard
/// it is hit, 0 to `limits.hit`; null: it is danced through. `hands`: 0: unset; hands move on to
/// the next key that sets them.
export type Key = { id: string; frame: number; pose: Pose; hasPlace: boolean; joints: number[] | null; hold: number; hit: number | null; hands: HandPose };

/// A named moment.
export type Marker = { frame: number; name: string };

/// One of several dancers, with the settings that differ from the project's.
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
  /// Her own; null: the project's.
  keys: Key[] | null;
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
  /// The velocity factor of each of `parts`; 1 is usual.
  velocities: number[];
  /// The floor path; empty: free.
  path: Step[];
  /// In order of frames.
  keys: Key[];
  /// In order of frames, at most one at each; no frame depends on them.
  markers: Marker[];
  /// Two or more dancers; empty: a single one.
  dancers: Partner[];
  /// The least distance between two of them, metres.
  apart: number;
};

/// The settings that are independent of music and keys.
export const settingsOf = ({ style, dynamics, variation, velocities, path }: Project) => ({ style, dynamics, variation, velocities, path });

export const emptyProject = (song: string, seconds: number): Project => ({
  song,
  seconds,
  seed: 1,
  style: '',
  dynamics: limits.usualMusicDynamics,
  variation: limits.usualVariation,
  beats: null,
  velocities: parts.map(() => 1),
  path: [],
  keys: [],
  markers: [],
  dancers: [],
  apart: limits.usualApartM,
});

export const sorted = (keys: Key[]) => [...keys].sort((a, b) => a.frame - b.frame);

/// The time, in frames, for which a pose can be held: rounded down to whole steps.
export function holdOf(frames: number, fps: number) {
  const step = limits.holdStepS * fps;
  return Math.round(Math.max(0, Math.floor(frames / step + 1e-9)) * step);
}

/// Whether a key follows while another one is held.
export const isInHold = (key: Key, frame: number) => key.hold > 0 && key.frame < frame && frame <= key.frame + key.hold;

/// The keys, with shortened holds. No hold lasts until the next key or past the last frame. A hold
/// that would overlap the next key ends early enough for the transition to it, as in the program
/// (client/authoring/keys/dance_keys.cpp). A hold to the dance's end ends exactly on the last frame.
export const trimmed = (keys: Key[], frames: number, fps: number) =>
  keys.map((key, i) => {
    const next = keys[i + 1]?.frame ?? Infinity;
    const way = isInHold(key, next) ? Math.round(limits.wayFromHoldS * fps) : limits.keyDistance;
    const end = frames - 1 - key.frame;
    const most = Math.min(key.hold, next - way - key.frame, end);
    const isWhole = most === key.hold || (most === end && holdOf(most, fps) > 0);
    return { ...key, hold: isWhole ? most : holdOf(most, fps) };
  });

/// An id or a joint's name, for people.
export const displayName = (name: string) => name.replaceAll('_', ' ');

/// An unused name: "kick", "kick-2", ...
export const freeName = (names: string[], name: string) => {
  const base = name.replace(/-\d+$/, '');
  let free = base;
  for (let i = 2; names.includes(free); ++i) free = `${base}-${i}`;
  return free;
};
export const freeId = (keys: Key[], name: string) => freeName(keys.map(({ id }) => id), name);

/// The markers with `next` in place of `old`; null if another marker has its frame.
export function withMarker(markers: Marker[], old: Marker | null, next: Marker | null): Marker[] | null {
  const others = markers.filter((marker) => marker !== old);
  if (!next) return others;
  if (others.some(({ frame }) => frame === next.frame)) return null;
  return [...others, next].sort((a, b) => a.frame - b.frame);
}
