// A character's rig as a skeleton that rests like SMPL's: arms out to the sides, limbs in SMPL's directions, feet flat, in the character's own unit
// and proportions. model/fit/bones/character_body.cpp, in JavaScript.
import { about, add, between, cross, dot, length, middle, minus, scaled, times, turned, unit } from './linear.js';
import { Skeleton } from './skeleton.js';

// Shares of a leg's length.
const mostAnkleHeight = 0.3; // an ankle above this does not stand on y = 0
const sunkenToes = -0.03; // nor do toes below this
const toesHeight = 0.025; // of SMPL's
const ankleHeight = 0.1; // of SMPL's
const leastBone = 1e-4;

const sides = ['left_', 'right_'];
const needed = ['hip', 'knee', 'ankle', 'shoulder', 'elbow', 'wrist'];

/** The needed bones that are missing. */
export function missingBones(bones) {
  const limbs = sides.flatMap((side) => needed.map((bone) => side + bone));
  const missing = ['pelvis', ...limbs].filter((bone) => !(bone in bones));
  return 'head' in bones || 'neck' in bones ? missing : [...missing, 'head'];
}

/** spine1, spine2 ... or neck, neck2 ..., as far as there are, from below. */
export function chain(bones, name) {
  const found = [];
  for (let number = 1; ; ++number) {
    const bone = name === 'neck' && number === 1 ? name : name + number;
    if (!(bone in bones)) return found;
    found.push(bone);
  }
}

/**
 * {skeleton, nodes, turns}: of each joint its node, -1 for toes that are added, and the turn in the world from how it rests in the rig to how it
 * rests in the skeleton. `bones`: node by bone. `places`: of the nodes at rest. `smpl`: SMPL's skeleton.
 */
export function makeBody(bones, places, smpl) {
  for (const name of ['spine', 'neck']) {
    if (Object.keys(bones).filter((bone) => bone.startsWith(name)).length !== chain(bones, name).length) {
      throw new TypeError(`bones: those of the ${name} are not numbered one after the other, from below`);
    }
  }
  const taken = new Map();
  for (const [bone, node] of Object.entries(bones)) {
    if (taken.has(node)) throw new TypeError(`bones: ${taken.get(node)} and ${bone} are one node`);
    taken.set(node, bone);
  }
  return new BodyBuilder(bones, places, smpl).build();
}

class BodyBuilder {
  #bones;
  #places;
  #smpl;
  #rest; // of SMPL's joints
  #upright; // turns the rig upright, facing +Z
  #leg; // its length
  #names = [];
  #parents = [];
  #offsets = [];
  #nodes = [];
  #turns = [];

  constructor(bones, places, smpl) {
    this.#bones = bones;
    this.#places = places;
    this.#smpl = smpl;
    this.#rest = smpl.rest();
  }

  build() {
    this.#stand();
    const chest = this.#addTrunk();
    for (const side of sides) this.#addArm(side, chest);
    for (const side of sides) this.#addLeg(side);
    const skeleton = new Skeleton(this.#names, this.#parents, this.#offsets, this.#pelvisHeight());
    return { skeleton, nodes: this.#nodes, turns: this.#turns };
  }

  #place(bone) {
    return this.#places[this.#bones[bone]];
  }

  #ours(joint) {
    return this.#rest[this.#smpl.find(joint)];
  }

  #stand() {
    const [shoulders, hips] = ['shoulder', 'hip'].map((joint) => sides.map((side) => this.#place(side + joint)));
    const trunk = minus(middle(...shoulders), middle(...hips));
    const sizes = trunk.map(Math.abs);
    const axis = sizes.indexOf(Math.max(...sizes));
    const up = [0, 1, 2].map((i) => (i === axis ? Math.sign(trunk[axis]) : 0));
    let left = add(minus(...shoulders), minus(...hips));
    left = minus(left, scaled(up, dot(left, up)));
    const [hip, knee, ankle] = ['left_hip', 'left_knee', 'left_ankle'].map((bone) => this.#place(bone));
    this.#leg = length(minus(knee, hip)) + length(minus(ankle, knee));
    if (!(length(left) > leastBone * this.#leg) || !(length(trunk) > leastBone * this.#leg)) {
      throw new TypeError('bones: hips and shoulders of left and right stand in one place');
    }
    left = unit(left);
    this.#upright = [...left, ...up, ...cross(left, up)];
    const ahead = sides.filter((side) => this.#hasToes(side)).map((side) => turned(this.#upright, this.#foot(side))[2]);
    if (ahead.reduce((a, b) => a + b, 0) < 0) throw new TypeError('bones: the feet point backwards: left and right are exchanged');
  }

  #foot(side) {
    return minus(this.#place(`${side}foot`), this.#place(`${side}ankle`));
  }

  #hasToes(side) {
    return `${side}foot` in this.#bones && length(this.#foot(side)) > leastBone * this.#leg;
  }

  #add(joint, node, parent, offset, turn) {
    this.#nodes.push(node);
    this.#turns.push(turn);
    this.#parents.push(parent);
    this.#offsets.push(offset);
    return this.#names.push(joint) - 1;
  }

  #addBone(bone, parent, turn) {
    const node = this.#bones[bone];
    const away = parent < 0 ? [0, 0, 0] : minus(this.#places[node], this.#places[this.#nodes[parent]]);
    return this.#add(bone, node, parent, parent < 0 ? away : turned(this.#turns[parent], away), turn);
  }

  /** Returns the chest. */
  #addTrunk() {
    let chest = this.#addBone('pelvis', -1, this.#upright);
    for (const bone of chain(this.#bones, 'spine')) chest = this.#addBone(bone, chest, this.#upright);
    let neck = chest;
    for (const bone of chain(this.#bones, 'neck')) neck = this.#addBone(bone, neck, this.#upright);
    if ('head' in this.#bones) this.#addBone('head', neck, this.#upright);
    return chest;
  }

  /**
   * The turn from the rest pose, already turned by `turn`, to the bone's direction in SMPL: first to `straight`, which SMPL's bones are near, so
   * that no bone rolls on a long way.
   */
  #along(from, to, turn, straight) {
    const bone = turned(turn, minus(this.#place(to), this.#place(from)));
    if (!(length(bone) > leastBone * this.#leg)) throw new TypeError(`bones: ${to} stands where ${from} does`);
    return times(between(straight, minus(this.#ours(to), this.#ours(from))), times(between(bone, straight), turn));
  }

  #addArm(side, chest) {
    let above = chest;
    if (`${side}collar` in this.#bones) above = this.#addBone(`${side}collar`, above, this.#upright);
    const out = [side === 'left_' ? 1 : -1, 0, 0];
    const arm = this.#along(`${side}shoulder`, `${side}elbow`, this.#upright, out);
    const forearm = this.#along(`${side}elbow`, `${side}wrist`, arm, out);
    above = this.#addBone(`${side}shoulder`, above, arm);
    above = this.#addBone(`${side}elbow`, above, forearm);
    this.#addBone(`${side}wrist`, above, forearm); // a hand continues along the forearm
  }

  #addLeg(side) {
    const down = [0, -1, 0];
    const thigh = this.#along(`${side}hip`, `${side}knee`, this.#upright, down);
    const shin = this.#along(`${side}knee`, `${side}ankle`, thigh, down);
    let above = this.#addBone(`${side}hip`, 0, thigh);
    above = this.#addBone(`${side}knee`, above, shin);
    const ours = minus(this.#ours(`${side}foot`), this.#ours(`${side}ankle`));
    if (this.#hasToes(side)) {
      const foot = this.#flat(turned(this.#upright, this.#foot(side)), ours);
      above = this.#addBone(`${side}ankle`, above, foot);
      this.#addBone(`${side}foot`, above, foot);
    } else {
      above = this.#addBone(`${side}ankle`, above, this.#upright);
      const offset = scaled(ours, this.#size());
      offset[1] = toesHeight * this.#leg - this.#ankleHeight(side);
      this.#add(`${side}foot`, -1, above, offset, this.#upright);
    }
  }

  /** A foot is flat at rest, so it turns about the vertical only. */
  #flat(foot, ours) {
    if (Math.hypot(foot[0], foot[2]) < 0.5 * Math.abs(foot[1])) return this.#upright;
    return times(about([0, 1, 0], Math.atan2(ours[0], ours[2]) - Math.atan2(foot[0], foot[2])), this.#upright);
  }

  #height(bone) {
    return turned(this.#upright, this.#place(bone))[1];
  }

  /** Over SMPL's. */
  #size() {
    const [hip, knee, ankle] = ['left_hip', 'left_knee', 'left_ankle'].map((joint) => this.#ours(joint));
    return this.#leg / (length(minus(knee, hip)) + length(minus(ankle, knee)));
  }

  /** The floor's height: 0, or just below the feet if they are elsewhere. */
  #floor() {
    const ankle = Math.min(...sides.map((side) => this.#height(`${side}ankle`)));
    let toes = ankle - (ankleHeight - toesHeight) * this.#leg;
    let stands = ankle > 0 && ankle < mostAnkleHeight * this.#leg;
    if (sides.every((side) => this.#hasToes(side))) {
      toes = Math.min(...sides.map((side) => this.#height(`${side}foot`)));
      stands &&= toes > sunkenToes * this.#leg;
    }
    return stands ? 0 : toes - toesHeight * this.#leg;
  }

  #ankleHeight(side) {
    return this.#height(`${side}ankle`) - this.#floor();
  }

  #pelvisHeight() {
    const heights = sides.map((side) => {
      let height = this.#ankleHeight(side);
      for (let joint = this.#names.indexOf(`${side}ankle`); joint > 0; joint = this.#parents[joint]) height -= this.#offsets[joint][1];
      return height;
    });
    return Math.max(0, ...heights);
  }
}
