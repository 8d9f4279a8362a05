// Dances on a character of one's own, as `choreo convert --character` puts them there.
import { makeBody } from './body.js';
import { findBones } from './find_bones.js';
import { curlFingers } from './fingers.js';
import { positive, requireObject, requireOptions } from './given.js';
import { bonesByNames } from './human_bones.js';
import { fromQuaternion, fromVector, identity, inverse, minus, nearestRotation, stretched, times, toQuaternion, turned } from './linear.js';
import { orderOf, transform, within } from './rig.js';
import { Skeleton } from './skeleton.js';
import { Transfer } from './transfer.js';

const whole = { shape: identity, at: [0, 0, 0] };
const flattest = 1e-9; // a determinant that counts as none

/** SMPL's poses in a message's frames: {frame, root, local}. */
function* posesIn({ first_frame, count, root_positions, rotations }, joints) {
  const width = rotations.length / (count * joints); // of a rotation, by its encoding
  const read = { 3: fromVector, 4: fromQuaternion, 9: (matrix) => matrix }[width];
  if (!read || root_positions.length !== 3 * count) throw new TypeError(`frames: ${rotations.length} rotations are not of ${count} frames of ${joints} joints`);
  for (let i = 0; i < count; ++i) {
    const turn = (joint) => read(Array.from(rotations.slice((i * joints + joint) * width, (i * joints + joint + 1) * width)));
    const local = Array.from({ length: joints }, (_, joint) => turn(joint));
    yield { frame: Number(first_frame) + i, root: Array.from(root_positions.slice(3 * i, 3 * i + 3)), local };
  }
}

/** The frames of a message as poses of SMPL's own joints. */
export function smplPoses(frames, { joint_names }) {
  return Array.from(posesIn(frames, joint_names.length), ({ frame, root, local }) => ({ frame, turns: local.flatMap(toQuaternion), places: root }));
}

export class Character {
  bones;
  turning;
  moving;
  #rig; // as it was given
  #order; // of the bones and all above them, parents first
  #rest; // their transforms at rest, in the world
  #body;
  #jointOf = new Map(); // by node
  #moves; // the joints whose nodes move in their parents
  #smpl;
  #transfer;
  #inPlace;
  #fingers; // turns, which stay

  constructor(rig, skeleton, options = {}) {
    if (!Array.isArray(rig)) throw new TypeError(`bones: ${rig} is not a list of bones, as bonesOf(scene).bones or gltfBones(json)`);
    requireObject('skeleton', skeleton, "a dance's header.skeleton");
    requireOptions(options, ['map', 'inPlace', 'hands']);
    const { map, inPlace = false, hands = 'relaxed' } = options;
    this.#rig = rig;
    this.#inPlace = inPlace;
    const order = orderOf(rig);
    const table = rig.some(({ humanoid }) => humanoid) ? bonesByNames(rig.map(({ humanoid }) => humanoid ?? '')) : {};
    this.bones = findBones(rig, map, table);
    this.#rest = [];
    for (const node of order) this.#rest[node] = within(this.#rest[rig[node].parent] ?? whole, transform(rig[node]));
    this.#smpl = Skeleton.of(skeleton);
    this.#body = makeBody(this.bones, this.#rest.map(({ at }) => at), this.#smpl);
    this.#transfer = new Transfer(this.#body.skeleton, this.#smpl);
    const above = new Set();
    this.#body.nodes.forEach((node, joint) => {
      if (node >= 0) this.#jointOf.set(node, joint);
      for (let at = node; at >= 0; at = rig[at].parent) above.add(at);
    });
    this.#order = order.filter((node) => above.has(node));
    this.turning = this.#body.nodes.filter((node) => node >= 0);
    this.#moves = new Set(this.turning.map((node) => this.#jointOf.get(node)).filter((joint) => this.#isApart(joint)));
    this.moving = this.turning.filter((node) => this.#moves.has(this.#jointOf.get(node)));
    for (const node of this.turning) {
      const size = Math.cbrt(Math.abs(volume(this.#rest[node].shape)));
      if (!(size > flattest)) throw new TypeError(`bones[${node}].scale: is zero`);
    }
    const fingers = curlFingers(rig, this.#rest, this.bones, hands);
    this.turning.push(...fingers.keys());
    this.#fingers = [...fingers.values()].flat();
  }

  dance(header) {
    requireObject('header', header, "a dance's header");
    const frameRate = positive('header.frame_rate', header.frame_rate);
    const reach = Transfer.reach(frameRate);
    let standing = []; // of which `told` are told: hands depend on those before, too
    let told = 0;
    const tell = (until) => {
      const poses = [];
      for (; told < until; ++told) poses.push({ frame: standing[told].frame, ...this.#pose(this.#transfer.reachOut(standing, told, frameRate)) });
      const past = Math.max(0, told - reach);
      standing = standing.slice(past);
      told -= past;
      return poses;
    };
    return {
      add: (frames) => {
        for (const { frame, root, local } of posesIn(frames, this.#smpl.names.length)) {
          const next = standing.length > 0 ? standing.at(-1).frame + 1 : frame;
          if (frame !== next) throw new TypeError(`frames.first_frame: ${frame}, the next one is ${next}`);
          standing.push({ frame, ...this.#transfer.stand(root, local) });
        }
        return tell(standing.length - reach);
      },
      end: () => tell(standing.length),
    };
  }

  show(pose, objects) {
    if (!pose) return; // none has come
    const { turns, places } = pose;
    this.turning.forEach((node, i) => objects[node].quaternion.fromArray(turns, 4 * i));
    this.moving.forEach((node, i) => objects[node].position.fromArray(places, 3 * i));
  }

  /** The turns and places of the bones' nodes. */
  #pose({ root: place, local }) {
    const root = this.#inPlace ? [0, place[1], 0] : place;
    const { positions, rotations } = this.#body.skeleton.place(root, local);
    const world = [];
    const turns = new Map();
    const places = new Map();
    for (const node of this.#order) {
      const above = world[this.#rig[node].parent] ?? whole;
      const placed = { ...this.#rig[node] };
      const joint = this.#jointOf.get(node);
      if (joint !== undefined) {
        const inFrame = inverse(above.shape);
        const goal = times(rotations[joint], times(this.#body.turns[joint], this.#rest[node].shape));
        // The nearest rotation, as scales may differ by axis.
        const turn = nearestRotation(stretched(times(inFrame, goal), placed.scale.map((one) => 1 / one)));
        placed.rotation = toQuaternion(turn);
        if (this.#moves.has(joint)) placed.position = turned(inFrame, minus(positions[joint], above.at));
        turns.set(node, placed.rotation);
        places.set(node, placed.position);
      }
      world[node] = within(above, transform(placed));
    }
    const danced = [...this.turning.slice(0, turns.size).flatMap((node) => turns.get(node)), ...this.#fingers];
    return { turns: danced, places: this.moving.flatMap((node) => places.get(node)) };
  }

  /** Whether a joint is the pelvis, or its node does not hang from the bone above. */
  #isApart(joint) {
    const above = this.#body.skeleton.parents[joint];
    if (above < 0) return true;
    let node = this.#rig[this.#body.nodes[joint]].parent;
    while (node >= 0 && !this.#jointOf.has(node)) node = this.#rig[node].parent;
    return node < 0 || this.#jointOf.get(node) !== above;
  }
}

const volume = ([a, b, c, d, e, f, g, h, i]) => a * (e * i - f * h) + b * (f * g - d * i) + c * (d * h - e * g);
