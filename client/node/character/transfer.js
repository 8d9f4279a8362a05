// A dance of SMPL's body on a character's, whose rest pose is SMPL's. model/fit/bones/transfer.cpp, in JavaScript.
import { add, cross, fromQuaternion, length, middle, minus, scaled, slerp, times, toQuaternion, transposed, turned, unit } from './linear.js';
import { placeEnd, placeToes } from './limb.js';

// Metres at SMPL's size: a hand nearer than the first touches, one farther than the second is free.
const touches = 0.12;
const free = 0.32;
// Seconds of smoothing, so that a hand that swings past the hips does not jerk.
const draws = 0.08;
const noWay = 1e-6;

/** Which of SMPL's turns in the world a character's joints take. */
function takesOf(character, smpl) {
  const count = (name) => character.names.filter((one) => one.startsWith(name)).length;
  const along = (chain, part, parts) => {
    const way = (part * (chain.length - 1)) / parts;
    const below = Math.floor(way);
    const above = Math.min(below + 1, chain.length - 1);
    return { from: smpl.find(chain[below]), to: smpl.find(chain[above]), share: way - below };
  };
  const [spines, necks] = ['spine', 'neck'].map(count);
  let [spine, neck] = [0, 0];
  return character.names.map((name) => {
    if (name.startsWith('spine')) return along(['pelvis', 'spine1', 'spine2', 'spine3'], ++spine, spines);
    if (name.startsWith('neck')) return along(['neck', 'head'], neck++, necks);
    return { from: smpl.find(name), share: 0 };
  });
}

function legHeight({ sides, offsets }) {
  const drops = sides.map(({ knee, ankle }) => -offsets[knee][1] - offsets[ankle][1]);
  return (drops[0] + drops[1]) / 2;
}

/** The axis about which an elbow bends, in the frame of the bone above at rest. */
function elbowHinge({ offsets }, { elbow }) {
  const axis = cross(offsets[elbow], [0, 0, 1]);
  return length(axis) > 1e-6 ? unit(axis) : [0, 0, 0];
}

/** 1 where a hand touches, 0 where it is free, smooth in between. */
function nearness(distance) {
  const share = Math.min(1, Math.max(0, (free - distance) / (free - touches)));
  return share * share * (3 - 2 * share);
}

export class Transfer {
  #character;
  #smpl;
  #size; // the character's, over SMPL's: the scale of its travel
  #takes;
  #rest;
  #ourRest;
  #hinges; // of the elbows
  #anchors; // what hands touch: {ours, theirs}

  constructor(character, smpl) {
    this.#character = character;
    this.#smpl = smpl;
    this.#size = legHeight(character) / legHeight(smpl);
    this.#takes = takesOf(character, smpl);
    this.#rest = character.rest();
    this.#ourRest = smpl.rest();
    this.#hinges = character.sides.map((side) => elbowHinge(character, side));
    this.#anchors = ['head', 'left_hip', 'right_hip', 'left_knee', 'right_knee']
      .map((name) => ({ ours: smpl.find(name), theirs: character.find(name) }))
      .filter(({ theirs }) => theirs >= 0);
  }

  /** How many frames before and after one its hands depend on. */
  static reach(frameRate) {
    return Math.floor(3 * draws * frameRate);
  }

  /**
   * {root, local, shifts}: the pose with its feet in place, and how far each hand has yet to go. `root` and `local`, a matrix a joint, are SMPL's.
   */
  stand(root, local) {
    const ours = this.#smpl.place(root, local);
    const pose = this.#copy(ours);
    const placement = this.#character.place(pose.root, pose.local);
    this.#character.sides.forEach((side, at) => {
      const ourToes = this.#smpl.sides[at].toes;
      const toes = scaled(ours.positions[ourToes], this.#size);
      toes[1] += this.#rest[side.toes][1] - this.#size * this.#ourRest[ourToes][1];
      placeToes(side, this.#character, placement, toes, pose.local);
    });
    // Hands on knees follow the knees' present place.
    const now = this.#character.place(pose.root, pose.local).positions;
    return { ...pose, shifts: [0, 1].map((side) => this.#shift(side, ours.positions, now)) };
  }

  /** Moves the hands of the frame `at` of those that stand(), by the shifts of its neighbours, too. */
  reachOut(frames, at, frameRate) {
    const { root, local } = frames[at];
    const placement = this.#character.place(root, local);
    this.#character.sides.forEach(({ shoulder, elbow, wrist }, side) => {
      const way = smoothed(frames, at, side, frameRate);
      if (length(way) < noWay * this.#size) return;
      const { positions, rotations } = placement;
      const goal = minus(add(positions[wrist], way), positions[shoulder]);
      placeEnd([shoulder, elbow, wrist], turned(rotations[shoulder], this.#hinges[side]), this.#character, placement, goal, local);
    });
    return { root, local };
  }

  /** Copies the turns, and the hips' place, scaled. */
  #copy(ours) {
    const world = this.#takes.map(({ from, to, share }) => {
      if (share === 0) return ours.rotations[from];
      return fromQuaternion(slerp(toQuaternion(ours.rotations[from]), toQuaternion(ours.rotations[to]), share));
    });
    const local = world.map((turn, joint) => (joint === 0 ? turn : times(transposed(world[this.#character.parents[joint]]), turn)));
    const hips = scaled(this.#smpl.hips(ours.positions), this.#size);
    hips[1] += this.#character.hips(this.#rest)[1] - this.#size * this.#smpl.hips(this.#ourRest)[1];
    return { root: minus(hips, this.#character.hips(this.#character.place([0, 0, 0], local).positions)), local };
  }

  /** From where a hand is to where it keeps SMPL's distance, scaled, from what it touches: the other hand, the head, the thighs or the floor. */
  #shift(side, smpl, now) {
    const [ours, theirs] = [this.#smpl, this.#character].map(({ sides }) => [sides[side].wrist, sides[1 - side].wrist]);
    const [ourHand, hand] = [smpl[ours[0]], now[theirs[0]]];
    let way = [0, 0, 0];
    let weights = 0;
    const draw = (goal, weight) => {
      way = add(way, scaled(minus(goal, hand), weight));
      weights += weight;
    };
    // Hands that touch meet in their middle: each moves half of the way.
    const apart = minus(ourHand, smpl[ours[1]]);
    draw(add(middle(hand, now[theirs[1]]), scaled(apart, this.#size / 2)), nearness(length(apart)));
    for (const anchor of this.#anchors) {
      const from = minus(ourHand, smpl[anchor.ours]);
      draw(add(now[anchor.theirs], scaled(from, this.#size)), nearness(length(from)));
    }
    draw([hand[0], this.#size * ourHand[1], hand[2]], nearness(ourHand[1]));
    return scaled(way, 1 / Math.max(1, weights));
  }
}

/** The mean of a hand's shifts about a frame, weighted by a Gaussian. */
function smoothed(frames, at, side, frameRate) {
  const sigma = draws * frameRate;
  const reach = Transfer.reach(frameRate);
  let sum = [0, 0, 0];
  let weights = 0;
  for (let i = Math.max(0, at - reach); i <= Math.min(frames.length - 1, at + reach); ++i) {
    const weight = Math.exp(-0.5 * ((i - at) / sigma) ** 2);
    sum = add(sum, scaled(frames[i].shifts[side], weight));
    weights += weight;
  }
  return scaled(sum, 1 / weights);
}
