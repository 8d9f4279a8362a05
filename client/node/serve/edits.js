// Reads what a page sends during a dance as the dance's requests. Refuses, by the page's own names, what can be no key.
import { randomUUID } from 'node:crypto';
import { invalid } from '../src/error.js';
import { isObject, number, requireWellFormed } from '../src/fields.js';
import { readAndWarn } from '../src/keys.js';
import { pose } from '../src/pose.js';
import { hint, quoted } from '../src/words.js';

const mostBytesOfId = 256;
const mostBytesOfHeld = mostBytesOfId - ' held 300'.length; // the steps of a hold have ids of their own
const fastest = 5; // metres a second, as in RequiredSpeed of model/dance
const ofRotations = ['id', 'time', 'rotations'];

/**
 * Reads a key that names a library pose, as in key files, or gives the `rotations` of some joints, and returns {id, requests}. A key without an id
 * gets one. Throws ChoreoError, which names the page's field. Calls `warn(id, message)` for a key that will be danced differently than its pose
 * suggests. `dancer`: {here, time}, where the dancer is in the newest frame, [x, z], which is what a `place` of 'here' means.
 */
export function editsOf(body, skeleton, dancer, warn) {
  if (!isObject(body)) throw invalid('key', `${quoted(body)} is neither {id, time, pose} nor {id, time, rotations}`);
  const { id = randomUUID(), time, rotations, place, hold } = body;
  requireId(id, hold === undefined ? mostBytesOfId : mostBytesOfHeld);
  if (!('frame' in body) || isObject(rotations)) requireTime(time);
  if (isObject(rotations)) return { id, requests: [ofJoints({ ...body, id }, skeleton)] };
  if (!['pose', 'rotations', 'joints'].some((member) => member in body)) throw invalid('pose', 'is missing, and so are rotations');
  const requests = asOwn(() => readAndWarn({ keyframes: [{ ...body, id, ...(place === 'here' && { place: dancer.here }) }] }, skeleton, warn));
  if (Array.isArray(place)) requireNear(place, time, dancer);
  return { id, requests };
}

function requireId(id, most) {
  const bytes = typeof id === 'string' ? Buffer.byteLength(id) : undefined;
  if (bytes === undefined) throw invalid('id', `${quoted(id)} is not a text`);
  if (!(bytes >= 1 && bytes <= most)) throw invalid('id', `has ${bytes} bytes, not 1 to ${most}${most < mostBytesOfId ? ', the most of a held key' : ''}`);
  requireWellFormed(id, 'id');
  if (id === '.' || id === '..') throw invalid('id', `"${id}" means a folder in an address, such as that at which a key is taken back`);
}

function requireTime(time) {
  if (time === undefined) throw invalid('time', 'is missing');
  if (number(time, 'time') < 0) throw invalid('time', `${time} s is before 0`);
}

/** A key of some joints, which is taken wherever the dancer is then. */
function ofJoints(body, skeleton) {
  const { id, time, rotations } = body;
  for (const name of Object.keys(body)) if (!ofRotations.includes(name)) throw invalid(name, `does not go with rotations; ${hint(name, ofRotations)}`);
  const taken = pose(skeleton, rotations);
  for (const [joint, turn] of Object.entries(rotations)) {
    const angle = Math.hypot(...turn);
    if (angle > 2 * Math.PI) throw invalid(`rotations.${joint}`, `${Number(angle.toPrecision(6))} rad exceeds 2π; angles are in radians`);
  }
  const joints = skeleton.joint_names.flatMap((joint, at) => (Object.hasOwn(rotations, joint) ? at : []));
  if (joints.length === 0) throw invalid('rotations', 'names no joint');
  return { keyframe: { id, time, pose: taken, mask: { joints } } };
}

/** Calls `read`, which reads the key as a key file of one key. Errors name the fields as the page does, without "keyframes[0]". */
function asOwn(read) {
  try {
    return read();
  } catch (error) {
    const [{ field, description } = {}] = error.violations ?? [];
    throw field === undefined ? error : invalid(field.replace(/^keyframes\[0\]\.?/, '') || 'key', description);
  }
}

function requireNear([x, z], time, dancer) {
  const metres = Math.hypot(x - dancer.here[0], z - dancer.here[1]);
  const left = time - dancer.time;
  if (left > 0 && metres > fastest * left) {
    throw invalid('place', `[${x}, ${z}] is ${metres.toFixed(1)} m from the dancer, ${left.toFixed(1)} s before; people run at most ${fastest} m a second`);
  }
}
