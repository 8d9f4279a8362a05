// Converts what a page sends during a dance to the dance's requests.
import { readAndWarn } from '../src/keys.js';
import { pose } from '../src/pose.js';

/**
 * Reads a key that names a library pose, as in key files, or gives the `rotations` of some joints. pose() throws for rotations that make no pose;
 * other faults of such a key reach the page as an event (reject_invalid_keys). Calls `warn(id, message)` for a key that will be danced differently
 * than its pose suggests. A `place` of 'here' is `here`, [x, z], where the dancer is now.
 */
export function editsOf(body, skeleton, here, warn) {
  const { id, time, rotations, pose: name, place } = Object(body);
  if (name !== undefined) return readAndWarn({ keyframes: [place === 'here' ? { ...body, place: here } : body] }, skeleton, warn);
  const turns = rotations ?? {};
  const joints = skeleton.joint_names.flatMap((joint, at) => (Object.hasOwn(turns, joint) ? at : []));
  return [{ keyframe: { id, time, pose: pose(skeleton, turns), mask: { joints } } }]; // wherever the dancer is then
}
