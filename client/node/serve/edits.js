// What pages may ask for while a dance is made, as its requests.
import { readAndWarn } from '../src/keys.js';
import { pose } from '../src/pose.js';

/**
 * A key as in key files, by its pose's name; or by the `rotations` of the joints that it sets. Whatever is wrong with the latter the page hears as an
 * event, because of reject_invalid_keys, but for rotations that make no pose: of those pose() tells. `warn(id, message)` hears of a key that will not
 * be danced as it looks.
 */
export function editsOf(body, skeleton, warn) {
  const { id, time, rotations, pose: name } = Object(body);
  if (name !== undefined) return readAndWarn({ keyframes: [body] }, skeleton, warn);
  const turns = rotations ?? {};
  const joints = skeleton.joint_names.flatMap((joint, at) => (Object.hasOwn(turns, joint) ? at : []));
  return [{ keyframe: { id, time, pose: pose(skeleton, turns), mask: { joints } } }]; // wherever the dancer is then
}
