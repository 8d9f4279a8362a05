import { invalid } from './error.js';
import { isObject, place, requireSkeleton, requireWhere } from './fields.js';
import { hint, quoted } from './words.js';

/** Makes a pose: the rest pose of `skeleton` with these `rotations`; index.d.ts documents it. */
export function pose(skeleton, rotations = {}, where = {}) {
  requireSkeleton(skeleton);
  const names = skeleton.joint_names;
  if (!isObject(rotations)) throw invalid('rotations', `${quoted(rotations)} is not {joint name: [x, y, z]}`);
  for (const [joint, turn] of Object.entries(rotations)) {
    if (!names.includes(joint)) throw invalid(`rotations.${joint}`, `no joint of ${skeleton.name || 'the skeleton'}; ${hint(joint, names)}`);
    const fine = turn?.length === 3 && Array.from(turn).every(Number.isFinite);
    if (!fine) throw invalid(`rotations.${joint}`, `${quoted(turn)} is not [x, y, z], three finite numbers`);
  }
  requireWhere(where, '{ place: [x, z] }', ['place']);
  const numbers = names.flatMap((joint) => Array.from(rotations[joint] ?? [0, 0, 0]));
  if (where.place === undefined) return { rotations: numbers };
  const [x, z] = place(where.place, 'where.place');
  return { root_position: { x, y: skeleton.pelvis_height, z }, rotations: numbers };
}
