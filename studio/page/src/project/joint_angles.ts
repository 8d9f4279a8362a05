// Joint angles in degrees. The program sends the meaning and range of a joint's numbers.
import { Euler, Quaternion, Vector3 } from 'three';
import { toQuaternion, toVector } from './body';
import type { Pose } from './body';
import type { JointTurn } from '../generated/studio/studio_pb';

const degree = Math.PI / 180;

/// A hinge's bend, or the successive turns about x, y and z of the bone above.
export function degreesOf({ hinge }: JointTurn, { rotations }: Pose, joint: number): number[] {
  if (hinge.length) return [new Vector3().fromArray(rotations, 3 * joint).dot(new Vector3(...hinge)) / degree];
  const { x, y, z } = new Euler().setFromQuaternion(toQuaternion(rotations, 3 * joint), 'ZYX');
  return [x, y, z].map((angle) => angle / degree);
}

/// The pose with these angles for a joint.
export function withDegrees({ hinge }: JointTurn, pose: Pose, joint: number, degrees: number[]): Pose {
  const [x, y, z] = degrees.map((angle) => angle * degree);
  const turn = hinge.length ? hinge.map((axis) => axis * x) : toVector(new Quaternion().setFromEuler(new Euler(x, y, z, 'ZYX')));
  const rotations = pose.rotations.slice();
  rotations.splice(3 * joint, 3, ...turn);
  return { ...pose, rotations };
}
