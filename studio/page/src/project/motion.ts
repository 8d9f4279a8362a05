// Frames at the model's rate.
import { create } from '@bufbuild/protobuf';
import { Quaternion } from 'three';
import { toQuaternion } from './body';
import type { Pose, Triple } from './body';
import { ClipSchema } from '../generated/studio/studio_pb';
import type { Clip } from '../generated/studio/studio_pb';
import type { Frames } from '../generated/choreo/v1/motion_pb';

/// What looks wrong from one frame to another, for people.
export type Fault = { from: number; to: number; text: string };

const pick = (from: Float32Array, width: number, first: number, end: number) =>
  from.slice(width * first, width * end);

export class Motion {
  count = 0;
  private roots: Float32Array;
  private rotations: Float32Array;
  private contacts: Float32Array;

  constructor(readonly joints: number, readonly fps: number, room = 900) {
    this.roots = new Float32Array(3 * room);
    this.rotations = new Float32Array(3 * joints * room);
    this.contacts = new Float32Array(4 * room);
  }

  /// Appends frames.
  append(frames: Frames) {
    this.makeRoom(this.count + frames.count);
    this.roots.set(frames.rootPositions, 3 * this.count);
    this.rotations.set(frames.rotations, 3 * this.joints * this.count);
    this.contacts.set(frames.contacts, 4 * this.count);
    this.count += frames.count;
  }

  /// A copy of the first `count` frames.
  head(count: number): Motion {
    const out = new Motion(this.joints, this.fps, Math.max(count, 1));
    out.count = count;
    out.roots.set(pick(this.roots, 3, 0, count));
    out.rotations.set(pick(this.rotations, 3 * this.joints, 0, count));
    out.contacts.set(pick(this.contacts, 4, 0, count));
    return out;
  }

  /// A copy with frames from `first` on replaced by `part`.
  with(first: number, part: Motion, count = part.count): Motion {
    const out = this.head(this.count);
    out.makeRoom(first + count);
    out.roots.set(pick(part.roots, 3, 0, count), 3 * first);
    out.rotations.set(pick(part.rotations, 3 * this.joints, 0, count), 3 * this.joints * first);
    out.contacts.set(pick(part.contacts, 4, 0, count), 4 * first);
    out.count = Math.max(out.count, first + count);
    return out;
  }

  pose(frame: number): Pose {
    const at = Math.min(Math.max(frame, 0), this.count - 1);
    return {
      root: [...this.roots.subarray(3 * at, 3 * at + 3)] as Triple,
      rotations: [...this.rotations.subarray(3 * this.joints * at, 3 * this.joints * (at + 1))],
    };
  }

  poses(first: number, end: number): Pose[] {
    const out = [];
    for (let frame = Math.max(first, 0); frame < Math.min(end, this.count); ++frame)
      out.push(this.pose(frame));
    return out;
  }

  /// Interpolates between frames, into `root` and `joints`. False before the first frame.
  sample(time: number, root: Triple, joints: Quaternion[]): boolean {
    if (this.count === 0) return false;
    const at = Math.min(Math.max(time * this.fps, 0), this.count - 1);
    const frame = Math.min(Math.floor(at), Math.max(0, this.count - 2));
    const next = Math.min(frame + 1, this.count - 1);
    const share = at - frame;
    for (let i = 0; i < 3; ++i) {
      root[i] = this.roots[3 * frame + i] * (1 - share) + this.roots[3 * next + i] * share;
    }
    for (let joint = 0; joint < this.joints; ++joint) {
      toQuaternion(this.rotations, 3 * (this.joints * frame + joint), joints[joint]);
      joints[joint].slerp(toQuaternion(this.rotations, 3 * (this.joints * next + joint)), share);
    }
    return true;
  }

  toClip(): Clip {
    return create(ClipSchema, {
      frameRate: this.fps,
      frames: {
        count: this.count,
        rootPositions: [...pick(this.roots, 3, 0, this.count)],
        rotations: [...pick(this.rotations, 3 * this.joints, 0, this.count)],
        contacts: [...pick(this.contacts, 4, 0, this.count)],
      },
    });
  }

  /// Converts a clip of any rate to the model's rate.
  static fromClip(clip: Clip, joints: number, fps: number): Motion {
    const own = new Motion(joints, clip.frameRate);
    const frames = clip.frames!;
    if (frames.contacts.length === 0) frames.contacts = Array(4 * frames.count).fill(0);
    own.append(frames);
    if (clip.frameRate === fps) return own;
    const out = new Motion(joints, fps);
    const count = Math.floor(((own.count - 1) / own.fps) * fps + 1e-6) + 1;
    out.makeRoom(count);
    const root: Triple = [0, 0, 0];
    const turns = Array.from({ length: joints }, () => new Quaternion());
    for (let frame = 0; frame < count; ++frame) {
      own.sample(frame / fps, root, turns);
      out.roots.set(root, 3 * frame);
      turns.forEach((q, joint) => {
        const length = Math.hypot(q.x, q.y, q.z);
        const scale = length > 1e-9 ? (2 * Math.atan2(length, q.w)) / length : 2;
        out.rotations.set([q.x * scale, q.y * scale, q.z * scale], 3 * (joints * frame + joint));
      });
    }
    out.count = count;
    return out;
  }

  private makeRoom(count: number) {
    if (3 * count <= this.roots.length) return;
    const grow = (from: Float32Array, width: number) => {
      const out = new Float32Array(2 * width * count);
      out.set(from);
      return out;
    };
    this.roots = grow(this.roots, 3);
    this.rotations = grow(this.rotations, 3 * this.joints);
    this.contacts = grow(this.contacts, 4);
  }
}
