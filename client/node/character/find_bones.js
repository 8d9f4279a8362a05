// Which nodes of a rig are the bones of its body. model/fit/bones/find_bones.cpp, in JavaScript, for rigs that have one body.
import { allBones, bonesByNames } from './human_bones.js';
import { chain, missingBones } from './body.js';

function isBelow(node, above, bones) {
  let at = node;
  while (at >= 0 && at !== above) at = bones[at].parent;
  return at === above;
}

/** The names; of the nodes with one name the node that is most like a bone keeps it. */
function uniqueNames(bones) {
  const parents = new Set(bones.map(({ parent }) => parent));
  const anyBone = bones.some(({ isBone }) => isBone);
  const rank = (node) => {
    const { isBone, isMesh } = bones[node];
    return 4 * (anyBone && isBone ? 1 : 0) + 2 * (isMesh ? 0 : 1) + (parents.has(node) ? 1 : 0);
  };
  const best = new Map();
  bones.forEach(({ name }, node) => {
    if (name && (!best.has(name) || rank(node) > rank(best.get(name)))) best.set(name, node);
  });
  return bones.map(({ name }, node) => (best.get(name) === node ? name : ''));
}

function choose(bone, choice, bones, found) {
  if (!allBones.includes(bone)) throw new TypeError(`map.${bone}: is none of ${allBones.join(', ')}`);
  delete found[bone];
  if (choice === null) return;
  if (Number.isInteger(choice)) {
    if (choice < 0 || choice >= bones.length) throw new TypeError(`map.${bone}: ${choice}, must be a name or a number below ${bones.length}`);
    found[bone] = choice;
    return;
  }
  const nodes = bones.flatMap(({ name }, node) => (name === choice ? node : []));
  const alike = nodes.filter((node) => bones[node].isBone && !bones[node].isMesh);
  if (nodes.length === 0) throw new TypeError(`map.${bone}: "${choice}" is none of the bones`);
  if (nodes.length > 1 && alike.length !== 1) throw new TypeError(`map.${bone}: "${choice}" names several bones: give its number, from 0 on`);
  found[bone] = nodes.length > 1 ? alike[0] : nodes[0];
}

/** The lowest node above the first one that is above the second one, too; one that is no bone yet. */
function carrier(left, right, bones, found) {
  let node = bones[left].parent;
  while (node >= 0 && !isBelow(right, node, bones)) node = bones[node].parent;
  return node >= 0 && !Object.values(found).includes(node) ? node : -1;
}

/** Hips hang from the pelvis, whatever its name. */
function findPelvis(bones, found) {
  if ('pelvis' in found || !('left_hip' in found) || !('right_hip' in found)) return;
  const node = carrier(found.left_hip, found.right_hip, bones, found);
  if (node >= 0) found.pelvis = node;
}

/** The node that carries both arms is the chest, the last of the spine, whatever its name. */
function findChest(bones, found) {
  const [left, right] = ['left_', 'right_'].map((side) => found[`${side}collar`] ?? found[`${side}shoulder`]);
  if (left === undefined || right === undefined || !('pelvis' in found)) return;
  const node = carrier(left, right, bones, found);
  const spine = chain(found, 'spine');
  const next = `spine${spine.length + 1}`;
  if (node >= 0 && isBelow(node, found[spine.at(-1) ?? 'pelvis'], bones) && allBones.includes(next)) found[next] = node;
}

/** Node by bone: of `map`, then of `table`, which a file itself has, then by the names. */
export function findBones(bones, map = {}, table = {}) {
  let found = { ...table };
  if (missingBones(found).length > 0) {
    const taken = Object.values(table);
    found = Object.fromEntries(Object.entries(bonesByNames(uniqueNames(bones))).filter(([, node]) => !taken.includes(node)));
    Object.assign(found, table);
  }
  for (const [bone, choice] of Object.entries(map)) choose(bone, choice, bones, found);
  if (!('pelvis' in map)) findPelvis(bones, found);
  if (!Object.keys(map).some((bone) => bone.startsWith('spine'))) findChest(bones, found);
  requireBones(bones, found);
  return found;
}

const few = 6; // names in an error

function listed(names) {
  const more = names.length > few ? ` and ${names.length - few} more` : '';
  return names.slice(0, few).join(', ') + more;
}

/** Throws where needed bones are missing, and names those that may be them: near the root, as limbs are, before fingers. */
function requireBones(bones, found) {
  const missing = missingBones(found);
  if (missing.length === 0) return;
  const depth = (node) => (node < 0 ? 0 : 1 + depth(bones[node].parent));
  const taken = Object.values(found);
  const others = bones.map(({ name }, node) => ({ name, node })).filter(({ name, node }) => name && !taken.includes(node));
  const names = others.map(({ name, node }) => [depth(node), name]).sort(([a], [b]) => a - b).map(([, name]) => name);
  const seen = names.length > 0 ? `the others are ${listed(names)}` : 'no others have names';
  throw new TypeError(`bones: none of them is the ${listed(missing)}; ${seen}: say which is by { map: { ${missing[0]}: name } }`);
}
