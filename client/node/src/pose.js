import { invalid } from './error.js';
import { hint, quoted } from './words.js';

/**
 * The body of `skeleton` standing at rest, where and however `rotations` ({joint name: [x, y, z] in radians}) turn it. Throws ChoreoError for
 * joints that it lacks, and what is no rotation.
 */
export function pose(skeleton, rotations = {}, { x = 0, z = 0 } = {}) {
  const names = skeleton?.joint_names;
  if (!names) throw invalid('skeleton', `${skeleton} is none, as in (await client.info()).models[0].skeleton`);
  for (const [joint, turn] of Object.entries(rotations)) {
    if (!names.includes(joint)) throw invalid(`rotations.${joint}`, `no joint of ${skeleton.name || 'the skeleton'}; ${hint(joint, names)}`);
    const fine = turn?.length === 3 && Array.from(turn).every(Number.isFinite);
    if (!fine) throw invalid(`rotations.${joint}`, `${quoted(turn)} is not [x, y, z], three finite numbers`);
  }
  for (const [axis, place] of Object.entries({ x, z })) {
    if (!Number.isFinite(place)) throw invalid(axis, `${place} is no finite number`);
  }
  return {
    root_position: { x, y: skeleton.pelvis_height, z },
    rotations: names.flatMap((joint) => Array.from(rotations[joint] ?? [0, 0, 0])),
  };
}
