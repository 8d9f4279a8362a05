// Skeletons and poses: metres, Y up, a body at rest faces +Z, its left side towards +X.
import { Quaternion, Vector3 } from 'three';
import type { Skeleton as SkeletonMessage } from '../generated/choreo/v1/motion_pb';

export type Triple = [number, number, number];

/// The root's position, and an axis-angle vector per joint, relative to its parent.
export type Pose = { root: Triple; rotations: number[] };

export const toQuaternion = (rotations: ArrayLike<number>, at: number, out = new Quaternion()) => {
  const [x, y, z] = [rotations[at], rotations[at + 1], rotations[at + 2]];
  const angle = Math.hypot(x, y, z);
  const scale = angle > 1e-9 ? Math.sin(angle / 2) / angle : 0.5;
  return out.set(x * scale, y * scale, z * scale, Math.cos(angle / 2));
};

export const toVector = (q: Quaternion): Triple => {
  const sign = q.w < 0 ? -1 : 1;
  const length = Math.hypot(q.x, q.y, q.z);
  const angle = 2 * Math.atan2(length, Math.abs(q.w));
  const scale = length > 1e-9 ? (sign * angle) / length : 2;
  return [q.x * scale, q.y * scale, q.z * scale];
};

export class Skeleton {
  readonly names: string[];
  readonly parents: number[];
  readonly offsets: Vector3[];
  readonly height: number;
  readonly feet: number[];
  /// For each joint, the corresponding joint on the other side.
  readonly twins: number[];
  private readonly rest: Figure;

  constructor(message: SkeletonMessage) {
    this.names = message.jointNames;
    this.parents = message.parents;
    this.offsets = this.names.map((_, i) => new Vector3().fromArray(message.offsets, 3 * i));
    this.height = message.pelvisHeight;
    this.feet = message.feet;
    const swap = (name: string) =>
      name.replace(/^(left|right)_/, (side) => (side === 'left_' ? 'right_' : 'left_'));
    this.twins = this.names.map((name) => Math.max(0, this.names.indexOf(swap(name))));
    const still: Pose = { root: [0, this.height, 0], rotations: Array(3 * this.joints).fill(0) };
    this.rest = new Figure(this, still);
  }

  get joints() {
    return this.names.length;
  }
  find(name: string) {
    return this.names.indexOf(name);
  }

  /// Exchanges left and right, in the plane that the body faces along.
  mirrored(pose: Pose): Pose {
    const rotations = Array<number>(pose.rotations.length);
    for (let joint = 0; joint < this.joints; ++joint) {
      const [x, y, z] = pose.rotations.slice(3 * this.twins[joint], 3 * this.twins[joint] + 3);
      rotations.splice(3 * joint, 3, x, -y, -z);
    }
    // Mirroring in the world's plane changes the facing, so turn the body back.
    return turned({ root: pose.root, rotations }, 2 * heading(pose));
  }

  /// The same joints on the other side, in order.
  twinsOf(joints: number[]): number[] {
    return joints.map((joint) => this.twins[joint]).sort((a, b) => a - b);
  }

  /// The pose moved vertically until the lowest foot is as high as at rest.
  grounded(pose: Pose): Pose {
    const figure = new Figure(this, pose);
    const drop = Math.min(
      ...this.feet.map((foot) => figure.places[foot].y - this.rest.places[foot].y),
    );
    return { ...pose, root: [pose.root[0], pose.root[1] - drop, pose.root[2]] };
  }
}

/// A body's facing on the floor: radians about +Y; 0 is +Z.
export const heading = (pose: Pose) => {
  const forward = new Vector3(0, 0, 1).applyQuaternion(toQuaternion(pose.rotations, 0));
  return Math.atan2(forward.x, forward.z);
};

export const turned = (pose: Pose, angle: number): Pose => {
  const turn = new Quaternion().setFromAxisAngle(new Vector3(0, 1, 0), angle);
  const rotations = pose.rotations.slice();
  rotations.splice(0, 3, ...toVector(turn.multiply(toQuaternion(pose.rotations, 0))));
  return { root: pose.root, rotations };
};

/// Takes these joints (null: all) from `after` and the others from `before`. The root's position belongs to joint 0.
export function only(before: Pose, after: Pose, joints: number[] | null): Pose {
  if (!joints) return after;
  const rotations = before.rotations.slice();
  for (const joint of joints) rotations.splice(3 * joint, 3, ...after.rotations.slice(3 * joint, 3 * joint + 3));
  return { root: joints.includes(0) ? after.root : before.root, rotations };
}

/// A pose with its joints' world positions, for editing.
export class Figure {
  readonly root: Vector3;
  readonly local: Quaternion[];
  readonly places: Vector3[];
  readonly world: Quaternion[];

  constructor(readonly skeleton: Skeleton, pose: Pose) {
    this.root = new Vector3(...pose.root);
    this.local = skeleton.names.map((_, joint) => toQuaternion(pose.rotations, 3 * joint));
    this.places = this.local.map(() => new Vector3());
    this.world = this.local.map(() => new Quaternion());
    this.place();
  }

  /// Recomputes all joints' positions.
  place() {
    const { parents, offsets } = this.skeleton;
    for (let joint = 0; joint < this.local.length; ++joint) {
      const parent = parents[joint];
      if (parent < 0) {
        this.places[joint].copy(this.root);
        this.world[joint].copy(this.local[joint]);
      } else {
        this.places[joint].copy(offsets[joint]).applyQuaternion(this.world[parent]);
        this.places[joint].add(this.places[parent]);
        this.world[joint].multiplyQuaternions(this.world[parent], this.local[joint]);
      }
    }
  }

  /// Turns a joint and its descendants in the world.
  turn(joint: number, by: Quaternion) {
    this.orient(joint, by.clone().multiply(this.world[joint]));
  }
  orient(joint: number, world: Quaternion) {
    const parent = this.skeleton.parents[joint];
    this.local[joint].copy(world);
    if (parent >= 0) this.local[joint].premultiply(this.world[parent].clone().invert());
    this.place();
  }

  pose(): Pose {
    return { root: this.root.toArray() as Triple, rotations: this.local.flatMap(toVector) };
  }
}
