// Two-bone inverse kinematics. model/motion/kinematics/limb.cpp, in JavaScript.
import { about, add, between, column, cross, dot, length, minus, scaled, times, transposed, turned, unit } from './linear.js';

// The last share of a limb's length, over which it straightens softly: near full length a millimetre of reach is six degrees of bend.
const softShare = 0.04;
// Sine of the bend below which the hinge's axis, not the bend, determines the plane.
const hingeWeight = 0.02;

const clamped = (value, least, most) => Math.min(most, Math.max(least, value));

/** A knee or elbow between bones of lengths `a` and `b`; only the share `inPlane` of the lower one turns. */
class Knee {
  #a;
  #b;
  #inPlane;
  #straight;

  constructor(a, b, inPlane) {
    this.#a = a;
    this.#b = b;
    this.#inPlane = inPlane;
    this.#straight = Math.sqrt(a * a + b * b + 2 * a * b * inPlane);
  }

  /** The bend at this distance between its ends: exact except in a soft zone, where it straightens ever more slowly and never fully. */
  #softBend(distance) {
    const zone = softShare * this.#straight;
    const beyond = distance - (this.#straight - zone);
    const soft = beyond > 0 ? this.#straight - zone * Math.exp(-beyond / zone) : distance;
    const [a, b] = [this.#a, this.#b];
    return Math.acos(clamped((soft * soft - a * a - b * b) / (2 * a * b * this.#inPlane), -1, 1));
  }

  /** The bend at `distance` for a knee that is bent by `bend` at `present`: near there its present bend, further away the soft one. */
  bendFrom(bend, present, distance) {
    const fades = 4 * softShare * this.#straight;
    const near = Math.max(0, 1 - Math.abs(distance - present) / fades);
    return this.#softBend(distance) + near * near * (bend - this.#softBend(present));
  }
}

/** A bent limb's plane counts as far as it bends like its hinge. */
function findBend([upper, middle, end], hinge, { positions }) {
  const thigh = minus(positions[middle], positions[upper]);
  const shin = minus(positions[end], positions[middle]);
  const along = unit(thigh);
  const plane = scaled(cross(along, shin), 1 / length(shin));
  const forward = Math.max(0, dot(plane, hinge)) / Math.max(length(plane), 1e-12);
  const level = minus(hinge, scaled(along, dot(hinge, along)));
  const axis = unit(add(scaled(plane, forward), scaled(level, hingeWeight)));
  return { thigh, shin, axis, bend: Math.atan2(dot(axis, cross(along, shin)), dot(along, shin)) };
}

/**
 * Turns the upper two of the joints `limb` so that the third reaches `goal`, given relative to the first, and keeps the third's turn in the world.
 * A straight limb bends about `hinge`. `placement` is of `local`, which changes.
 */
export function placeEnd(limb, hinge, { parents }, placement, goal, local) {
  const [upper, middle, end] = limb;
  const { rotations } = placement;
  const { thigh, shin, axis, bend } = findBend(limb, hinge, placement);
  const [a, b] = [length(thigh), length(shin)];
  const distance = Math.max(length(goal), Math.abs(a - b) + 0.05 * b);
  const inPlane = Math.max(0.1, length(minus(shin, scaled(axis, dot(shin, axis)))) / b);
  const wanted = clamped(new Knee(a, b, inPlane).bendFrom(bend, length(add(thigh, shin)), distance), -Math.PI, Math.PI);
  const knee = about(axis, wanted - bend);
  const swing = between(add(thigh, turned(knee, shin)), goal);
  const newUpper = times(swing, rotations[upper]);
  const newMiddle = times(swing, times(knee, rotations[middle]));
  local[upper] = times(transposed(rotations[parents[upper]]), newUpper);
  local[middle] = times(transposed(newUpper), newMiddle);
  local[end] = times(transposed(newMiddle), rotations[end]);
}

/** Turns hip and knee so that the toes reach `toes` and the foot keeps its turn in the world. */
export function placeToes({ hip, knee, ankle, toes: tip }, skeleton, placement, toes, local) {
  const { positions, rotations } = placement;
  const goal = minus(minus(toes, minus(positions[tip], positions[ankle])), positions[hip]);
  placeEnd([hip, knee, ankle], column(rotations[hip], 0), skeleton, placement, goal, local);
}
