// What hands do: fingers bend towards the palm. model/fit/bones/finger_bones.cpp, in JavaScript.
import { fingerNames, handBends, handPoses } from './bone_names.js';
import { about, add, cross, dot, fromQuaternion, inverse, length, minus, scaled, times, toQuaternion, turned, unit } from './linear.js';

const bentBones = 3; // of a finger
const noDirection = 1e-6; // share of the hand
const thumb = 0;

/** The nodes of each finger, from the knuckle on. */
function findFingers(rig, wrist) {
  const depth = (node) => {
    let steps = 0;
    for (let at = node; at !== wrist; at = rig[at].parent, ++steps) if (at < 0) return -1;
    return steps;
  };
  const isBelow = (node, above) => {
    let at = node;
    while (at >= 0 && at !== above) at = rig[at].parent;
    return at === above;
  };
  const depths = rig.map((_, node) => depth(node));
  const below = rig.flatMap(({ isMesh }, node) => (depths[node] > 0 && !isMesh ? node : []));
  below.sort((a, b) => depths[a] - depths[b]);
  const hand = fingerNames.map(() => []);
  for (const node of below) {
    const name = rig[node].name.toLowerCase();
    const finger = fingerNames.findIndex((tokens, at) => tokens.some((token) => name.includes(token)) && (at === thumb || !name.includes('metacarpal')));
    const chain = hand[finger];
    // Twists and corrections beside the bones do not belong to the chain.
    if (chain && (chain.length === 0 || isBelow(node, chain.at(-1)))) chain.push(node);
  }
  return hand;
}

/** The bent bones of a hand: {node, axis, angle}, the axis in the world at rest. */
function* bent(rig, places, wrist, isLeft, bends) {
  const hand = findFingers(rig, wrist);
  const knuckles = hand.slice(1).flatMap((chain) => (chain.length > 0 ? [places[chain[0]]] : []));
  if (knuckles.length === 0 || (knuckles.length === 1 && hand[thumb].length === 0)) return;
  const first = knuckles.length > 1 ? knuckles[0] : places[hand[thumb][0]];
  const middle = knuckles.reduce((sum, knuckle) => add(sum, scaled(knuckle, 1 / knuckles.length)), [0, 0, 0]);
  const ahead = minus(middle, places[wrist]);
  const across = minus(first, knuckles.at(-1)); // from the last finger to the first, or to the thumb
  const out = isLeft ? cross(ahead, across) : cross(across, ahead);
  const size = length(ahead);
  if (!(length(out) > noDirection * size * size)) return;
  const palm = unit(out);
  for (let finger = 1; finger < hand.length; ++finger) yield* bend(places, hand[finger], palm, bends[finger], ahead, palm);
  if (hand[thumb].length === 0) return;
  // The thumb turns towards a place before the fingers' knuckles.
  const before = minus(add(middle, scaled(palm, 0.35 * size)), places[hand[thumb][0]]);
  if (length(before) > noDirection * size) yield* bend(places, hand[thumb], unit(before), bends[thumb], ahead, palm);
}

/** Bends a finger towards a direction, about one axis. */
function* bend(places, chain, towards, bends, ahead, palm) {
  if (chain.length < 2) return;
  const first = minus(places[chain[1]], places[chain[0]]);
  let axis = cross(first, towards);
  if (!(length(axis) > 0.1 * length(first))) axis = cross(ahead, palm);
  if (!(length(axis) > 0)) return;
  axis = unit(axis);
  let before = first;
  for (let bone = 0; bone < Math.min(chain.length, bentBones); ++bone) {
    // The last node continues like the one before if nothing is behind it.
    const along = bone + 1 < chain.length ? minus(places[chain[bone + 1]], places[chain[bone]]) : before;
    const rests = Math.atan2(dot(axis, cross(before, along)), dot(before, along));
    const angle = (bends[bone] * Math.PI) / 180 - rests;
    if (angle !== 0) yield { node: chain[bone], axis, angle };
    before = along;
  }
}

/** The turns of the fingers' nodes in their parents, by node. `rest`: of all nodes, in the world. Throws for a pose that hands do not have. */
export function curlFingers(rig, rest, bones, hands) {
  if (!handPoses.includes(hands)) throw new TypeError(`hands: ${hands} is none of ${handPoses.join(', ')}`);
  const turns = new Map();
  const bends = handBends[handPoses.indexOf(hands)];
  if (bends.length === 0) return turns; // at rest
  const places = rest.map(({ at }) => at);
  for (const side of ['left', 'right']) {
    for (const { node, axis, angle } of bent(rig, places, bones[`${side}_wrist`], side === 'left', bends)) {
      const { shape } = rest[rig[node].parent];
      const sense = dot(shape.slice(0, 3), cross(shape.slice(3, 6), shape.slice(6))) < 0 ? -1 : 1; // of a mirrored rig
      const turn = about(unit(turned(inverse(shape), axis)), sense * angle);
      turns.set(node, toQuaternion(times(turn, fromQuaternion(rig[node].rotation))));
    }
  }
  return turns;
}
