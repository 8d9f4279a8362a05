// Inverse kinematics for dragging a body's handles.
import { Quaternion, Vector3 } from 'three';
import { Figure, only } from '../project/body';
import type { Pose, Skeleton } from '../project/body';

/// A handle at `joint`. For limbs, `chain` is the joint above, the hinge, and the end.
export type Handle = { id: string; label: string; joint: string; chain?: [string, string, string] };

const limb = (side: string, label: string, ends: [string, string, string]): Handle => ({
  id: `${side}_${label}`,
  label: `${side} ${label}`,
  joint: `${side}_${ends[2]}`,
  chain: ends.map((end) => `${side}_${end}`) as [string, string, string],
});

export const handles: Handle[] = [
  { id: 'head', label: 'head', joint: 'head' },
  limb('left', 'hand', ['shoulder', 'elbow', 'wrist']),
  limb('right', 'hand', ['shoulder', 'elbow', 'wrist']),
  { id: 'pelvis', label: 'hips', joint: 'pelvis' },
  limb('left', 'foot', ['hip', 'knee', 'ankle']),
  limb('right', 'foot', ['hip', 'knee', 'ankle']),
];

/// The joints that bend when the head is dragged, from above.
const spine = ['neck', 'spine3', 'spine2', 'spine1'];

/// The floor handle moves the whole body.
export const floorHandle: Handle = { id: 'floor', label: 'place', joint: 'pelvis' };

/// Whether a handle can be dragged if only these joints may change (null: all).
export function canPull(skeleton: Skeleton, { id, joint, chain }: Handle, joints: number[] | null): boolean {
  const needed = chain ?? (id === 'head' ? spine : [joint]);
  return !joints || needed.every((name) => joints.includes(skeleton.find(name)));
}

/// The pose after dragging a handle to a place in the world. Joints other than these (null: all) keep their rotations.
export function pull(skeleton: Skeleton, pose: Pose, handle: Handle, to: Vector3, joints: number[] | null): Pose {
  if (handle.id === 'floor') {
    return { ...pose, root: [to.x, pose.root[1], to.z] };
  }
  const figure = new Figure(skeleton, pose);
  if (handle.chain) bendLimb(figure, handle.chain.map((name) => skeleton.find(name)), to);
  else if (handle.id === 'head') bendSpine(figure, to);
  else moveHips(figure, to);
  return only(pose, figure.pose(), joints);
}

/// Moves the hips and keeps the feet in place.
function moveHips(figure: Figure, to: Vector3) {
  const legs = handles.filter(({ id }) => id.endsWith('_foot'));
  const chains = legs.map(({ chain }) => chain!.map((name) => figure.skeleton.find(name)));
  const ends = chains.map(([, , end]) => ({
    place: figure.places[end].clone(),
    world: figure.world[end].clone(),
  }));
  figure.root.copy(to);
  figure.place();
  chains.forEach((chain, i) => {
    bendLimb(figure, chain, ends[i].place);
    figure.orient(chain[2], ends[i].world);
  });
}

/// Two-bone reach: the hinge opens or closes in its present plane, then the limb swings. Hand or foot keeps its world rotation.
function bendLimb(figure: Figure, [upper, hinge, end]: number[], to: Vector3) {
  const facing = figure.world[end].clone();
  const [a, b, c] = [figure.places[upper], figure.places[hinge], figure.places[end]];
  const above = a.distanceTo(b);
  const below = b.distanceTo(c);
  const reach = Math.min(Math.max(to.distanceTo(a), Math.abs(above - below) + 1e-3), (above + below) * 0.9995);
  const up = a.clone().sub(b).normalize();
  const down = c.clone().sub(b).normalize();
  const axis = up.clone().cross(down);
  if (axis.length() < 0.02) axis.copy(hingeAxis(figure, hinge));
  const open = Math.acos(Math.min(1, Math.max(-1, up.dot(down))));
  const wanted = Math.acos((above * above + below * below - reach * reach) / (2 * above * below));
  figure.turn(hinge, new Quaternion().setFromAxisAngle(axis.normalize(), wanted - open));
  swing(figure, upper, figure.places[end], to, 1);
  figure.orient(end, facing);
}

/// The axis about which a straight limb bends: shins backwards, forearms forwards.
function hingeAxis(figure: Figure, hinge: number) {
  const name = figure.skeleton.names[hinge];
  const axis = name.endsWith('knee') ? new Vector3(-1, 0, 0)
    : new Vector3(0, name.startsWith('left') ? 1 : -1, 0);
  return axis.applyQuaternion(figure.world[figure.skeleton.parents[hinge]]);
}

/// Turns a joint so that its descendant `from` moves `share` of the way towards `to`.
function swing(figure: Figure, joint: number, from: Vector3, to: Vector3, share: number) {
  const here = from.clone().sub(figure.places[joint]).normalize();
  const there = to.clone().sub(figure.places[joint]).normalize();
  const turn = new Quaternion().setFromUnitVectors(here, there);
  figure.turn(joint, new Quaternion().slerp(turn, share));
}

/// Bends each joint of the spine a little until the head is near the place.
function bendSpine(figure: Figure, to: Vector3) {
  const head = figure.skeleton.find('head');
  const facing = figure.world[head].clone();
  const joints = spine.map((name) => figure.skeleton.find(name));
  for (let round = 0; round < 8; ++round) {
    for (const joint of joints) swing(figure, joint, figure.places[head], to, 0.35);
  }
  figure.orient(head, facing);
}
