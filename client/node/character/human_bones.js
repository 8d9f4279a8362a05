// Which names are which bones of a human body. model/fit/bones/human_bones.cpp, in JavaScript; the names themselves are a copy that
// scripts/bone_names.py makes.
import { limbBones, rigs } from './bone_names.js';

const mostSpines = 6;
const mostNecks = 3;
const mostEnds = 4; // "_bind_jnt" has two
const mostPrefixes = 8;

const spineName = (number) => `spine${number}`;
const neckName = (number) => (number === 1 ? 'neck' : `neck${number}`);
const upTo = (most, name) => Array.from({ length: most }, (_, at) => name(at + 1));

/** All bones that a map may name. */
export const allBones = [
  'pelvis',
  ...upTo(mostSpines, spineName),
  ...upTo(mostNecks, neckName),
  'head',
  ...['left_', 'right_'].flatMap((side) => limbBones.map((bone) => side + bone)),
];

const split = (names) => names.split('|').filter(Boolean);
const onSide = (name, rig, left) => name.replaceAll('*', rig.sides[left ? 0 : 1]).replaceAll('@', left ? 'left' : 'right');
/** Without separators, in lower case: tools spell one name in several ways. */
const plain = (name) => name.replace(/[_.\-:| ]/g, '').replace(/[A-Z]/g, (letter) => letter.toLowerCase());
/** Without the number that makes it unique, as in "Hips_012" or "Hips.001". */
const withoutNumber = (name) => name.replace(/(?<=.)[_.]\d+$/, '');

function findIn(rig, prefix, index, spell) {
  const bones = {};
  const at = (name) => index.get(prefix + spell(name));
  const any = (bone, candidates, left) => {
    for (const candidate of split(candidates)) {
      const node = at(onSide(candidate, rig, left));
      if (node !== undefined) return (bones[bone] = node);
    }
  };
  const all = (name, candidates) => {
    const nodes = split(candidates).map(at).filter((node) => node !== undefined);
    nodes.forEach((node, i) => (bones[name(i + 1)] = node));
  };
  any('pelvis', rig.pelvis, true);
  any('head', rig.head, true);
  all(spineName, rig.spine);
  all(neckName, rig.neck);
  for (const left of [true, false]) limbBones.forEach((bone, i) => any((left ? 'left_' : 'right_') + bone, rig.limbs[i], left));
  return bones;
}

/** Whether this may stand before all names of a rig. */
const isPrefix = (text) => text === '' || text.startsWith('mixamorig') || /[:_\-|. ]$/.test(text);

/** Prefixes under which the left thigh exists, or else the right one. Rigify's DEF- bones move the mesh. */
function prefixesOf(rig, names, spell) {
  const isPlain = spell === plain;
  const prefixes = ['', isPlain ? 'def' : 'DEF-'];
  const thighs = [true, false].flatMap((left) => split(rig.limbs[0]).map((candidate) => onSide(candidate, rig, left)));
  for (const thigh of thighs.map(spell)) {
    for (const name of names) {
      if (!name.endsWith(thigh) || prefixes.length === mostPrefixes) continue;
      const prefix = name.slice(0, name.length - thigh.length);
      if ((isPlain || isPrefix(prefix)) && !prefixes.includes(prefix)) prefixes.push(prefix);
    }
  }
  return prefixes;
}

/** Without the common ending of most names, as in "LeftArm_jnt". A side is no ending. */
function withoutCommonEnd(names) {
  let now = names;
  const endOf = (name) => /(?<=.)[_.\-:| ][^_.\-:| ]*$/.exec(name)?.[0] ?? '';
  for (let ends = 0; ends < mostEnds; ++ends) {
    const times = new Map();
    for (const end of now.map(endOf)) if (end) times.set(end, (times.get(end) ?? 0) + 1);
    const most = Math.max(0, ...times.values());
    if (2 * most <= now.length) return now;
    const common = [...times].find(([, count]) => count === most)[0];
    now = now.map((name) => (endOf(name) === common ? name.slice(0, -common.length) : name));
  }
  return now;
}

/** How many of the bones that dancing needs there are, then of all. */
function score(bones) {
  const needed = ['hip', 'knee', 'ankle', 'shoulder', 'elbow', 'wrist'].flatMap((bone) => [`left_${bone}`, `right_${bone}`]);
  const found = needed.filter((bone) => bone in bones).length + ('head' in bones || 'neck' in bones ? 1 : 0);
  return 1000 * found + Object.keys(bones).length;
}

function findSpelt(names, spell) {
  const index = new Map();
  names.forEach((name, at) => index.has(name) || index.set(name, at)); // the first of each name
  let best = {};
  for (const rig of rigs) {
    for (const prefix of prefixesOf(rig, names, spell)) {
      const found = findIn(rig, prefix, index, spell);
      if (score(found) > score(best)) best = found;
    }
  }
  return best;
}

const isWhole = (bones) => score(bones) >= 13000;

/** Node by bone, of the rig whose names match most, under any common prefix. Other spellings count only where they give a whole body. */
export function bonesByNames(names) {
  const exact = (name) => name;
  const best = findSpelt(names, exact);
  if (isWhole(best)) return best;
  const unnumbered = names.map(withoutNumber);
  const respelt = [unnumbered, withoutCommonEnd(names), withoutCommonEnd(unnumbered)];
  for (const spelling of respelt) {
    const found = findSpelt(spelling, exact);
    if (isWhole(found)) return found;
  }
  for (const spelling of [names, ...respelt]) {
    const found = findSpelt(spelling.map(plain), plain);
    if (isWhole(found)) return found;
  }
  return best;
}
