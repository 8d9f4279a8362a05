// The bones of a character as a file or a scene has them: {name, parent, position, rotation, scale, isBone, isMesh, humanoid}.
import { add, fromQuaternion, nearestRotation, stretched, times, toQuaternion, transposed, turned } from './linear.js';

/**
 * The bones of what lies below `root`, an Object3D of three.js or alike, in its frame, as they rest now; `objects` are their nodes. `humanoid`: of
 * a VRM, {hips: {node}, ...}, as three-vrm has it.
 */
export function bonesOf(root, humanoid = {}) {
  const objects = [];
  const parents = [];
  const collect = (object, parent) => {
    const at = objects.push(object) - 1;
    parents.push(parent);
    for (const child of object.children) collect(child, at);
  };
  for (const child of root.children) collect(child, -1);
  const called = new Map(Object.entries(humanoid).map(([name, bone]) => [bone?.node, name]));
  const bones = objects.map((object, at) => ({
    // GLTFLoader keeps the file's name there, and takes some signs out of its own.
    name: object.userData?.name ?? object.name,
    parent: parents[at],
    position: object.position.toArray(),
    rotation: object.quaternion.toArray(),
    scale: object.scale.toArray(),
    isBone: object.isBone === true,
    isMesh: object.isMesh === true,
    humanoid: called.get(object),
  }));
  return { bones, objects };
}

/** The nodes of a glTF file's JSON, in its order. */
export function gltfBones({ nodes = [], skins = [], extensions = {} }) {
  const parents = new Map(nodes.flatMap(({ children = [] }, at) => children.map((child) => [child, at])));
  const joints = new Set(skins.flatMap((skin) => skin.joints ?? []));
  const called = new Map();
  const { humanBones } = (extensions.VRMC_vrm ?? extensions.VRM)?.humanoid ?? {};
  for (const [name, { bone, node }] of Object.entries(humanBones ?? {})) called.set(node, bone ?? name); // before VRM 1 it was a list
  return nodes.map((node, at) => ({
    name: node.name ?? '',
    parent: parents.get(at) ?? -1,
    ...placement(node),
    isBone: joints.has(at),
    isMesh: node.mesh !== undefined,
    humanoid: called.get(at),
  }));
}

function placement({ matrix: m, translation = [0, 0, 0], rotation = [0, 0, 0, 1], scale = [1, 1, 1] }) {
  if (!m) return { position: translation, rotation, scale };
  const shape = [m[0], m[4], m[8], m[1], m[5], m[9], m[2], m[6], m[10]];
  const turn = nearestRotation(shape);
  const scaling = times(transposed(turn), shape);
  return { position: m.slice(12, 15), rotation: toQuaternion(turn), scale: [scaling[0], scaling[4], scaling[8]] };
}

/** The transform of a bone in its parent: {shape, at}. */
export function transform({ position, rotation, scale }) {
  const norm = Math.hypot(...rotation);
  return { shape: stretched(fromQuaternion(rotation.map((one) => one / norm)), scale), at: position };
}

/** A transform in a frame. */
export const within = (frame, { shape, at }) => ({ shape: times(frame.shape, shape), at: add(frame.at, turned(frame.shape, at)) });

/** Throws for what is no tree of bones. Returns their numbers, parents first. */
export function orderOf(bones) {
  const order = [];
  const children = bones.map(() => []);
  bones.forEach(({ parent }, at) => {
    if (!Number.isInteger(parent) || parent < -1 || parent >= bones.length) throw new TypeError(`bones[${at}].parent: ${parent} is not a bone, and not -1`);
    if (parent < 0) order.push(at);
    else children[parent].push(at);
  });
  for (let i = 0; i < order.length; ++i) order.push(...children[order[i]]);
  if (order.length !== bones.length) throw new TypeError('bones: some are their own ancestors');
  bones.forEach((bone, at) => {
    for (const [field, count] of [['position', 3], ['rotation', 4], ['scale', 3]]) {
      if (bone[field]?.length !== count || !bone[field].every(Number.isFinite)) {
        throw new TypeError(`bones[${at}].${field}: ${bone[field]} is not ${count} finite numbers`);
      }
    }
  });
  return order;
}
