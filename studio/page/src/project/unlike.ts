// Measures where several motions differ, and by how much.
import { Quaternion } from 'three';
import { toQuaternion } from './body';
import type { Motion } from './motion';

const step = 3; // frames between samples

/// The difference of the two most similar motions at a frame: the mean over joints of 1 - |cos| of half the angle between them.
export function unlikeness(motions: Motion[], frame: number): number {
  const [a, b] = [new Quaternion(), new Quaternion()];
  const poses = motions.map((motion) => motion.pose(frame).rotations);
  const between = (one: number[], other: number[]) => {
    let sum = 0;
    for (let at = 0; at < one.length; at += 3) sum += 1 - Math.abs(toQuaternion(one, at, a).dot(toQuaternion(other, at, b)));
    return (3 * sum) / one.length;
  };
  return Math.min(...poses.flatMap((one, i) => poses.slice(i + 1).map((other) => between(one, other))));
}

/// The frame in [from, to) at which all motions differ most from each other.
export function mostUnlike(motions: Motion[], from: number, to: number): number {
  let [best, most] = [from, -1];
  for (let frame = from; frame < to; frame += step) {
    const value = unlikeness(motions, frame);
    if (value > most) [best, most] = [frame, value];
  }
  return best;
}
