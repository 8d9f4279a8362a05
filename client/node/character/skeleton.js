// Joints in a tree, parents first, as in the header of a dance: {joint_names, parents, offsets, pelvis_height}.
import { add, times, turned } from './linear.js';

/** A skeleton whose offsets are vectors, with the joints that have a role. */
export class Skeleton {
  constructor(names, parents, offsets, pelvisHeight) {
    Object.assign(this, { names, parents, offsets, pelvisHeight });
    const side = (at) => ({
      hip: this.find(`${at}_hip`),
      knee: this.find(`${at}_knee`),
      ankle: this.find(`${at}_ankle`),
      toes: this.find(`${at}_foot`),
      shoulder: this.find(`${at}_shoulder`),
      elbow: this.find(`${at}_elbow`),
      wrist: this.find(`${at}_wrist`),
    });
    this.sides = [side('left'), side('right')];
  }

  /** The skeleton of a header, which is SMPL's. */
  static of({ name, joint_names, parents, offsets, pelvis_height }) {
    if (name !== 'smpl24') throw new TypeError(`skeleton: ${name} is not smpl24`);
    return new Skeleton(joint_names, parents, joint_names.map((_, joint) => offsets.slice(3 * joint, 3 * joint + 3)), pelvis_height);
  }

  find(name) {
    return this.names.indexOf(name);
  }

  /** Where all joints are, and how they are turned, in the world. `local`: a matrix a joint. */
  place(root, local) {
    const positions = [root];
    const rotations = [local[0]];
    for (let joint = 1; joint < this.parents.length; ++joint) {
      const parent = this.parents[joint];
      positions.push(add(positions[parent], turned(rotations[parent], this.offsets[joint])));
      rotations.push(times(rotations[parent], local[joint]));
    }
    return { positions, rotations };
  }

  /** Where the joints are at rest. */
  rest() {
    const positions = [[0, this.pelvisHeight, 0]];
    for (let joint = 1; joint < this.parents.length; ++joint) positions.push(add(positions[this.parents[joint]], this.offsets[joint]));
    return positions;
  }

  /** The middle of the hips. */
  hips(positions) {
    const [left, right] = this.sides.map(({ hip }) => positions[hip]);
    return left.map((one, i) => (one + right[i]) / 2);
  }
}
