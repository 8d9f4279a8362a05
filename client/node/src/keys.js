// Reads key files as `choreo dance --keyframes` does; docs/poses.md describes them.
import { invalid } from './error.js';
import { isObject, number, place as placeOf, requireSkeleton, requireWhere, vector } from './fields.js';
import { find } from './poses.js';
import { radians, times, turned } from './turns.js';
import { hint, quoted } from './words.js';

const members = ['id', 'time', 'frame', 'hold', 'hit', 'hands', 'pose', 'place', 'facing', 'joints', 'root_position', 'rotations'];
const limbs = { arms: ['left_shoulder', 'right_shoulder'], legs: ['left_hip', 'right_hip'] };
for (const side of ['left', 'right']) {
  limbs[`${side}_arm`] = [`${side}_shoulder`];
  limbs[`${side}_leg`] = [`${side}_hip`];
}
const bends = { left_knee: -1, right_knee: -1, left_elbow: 1, right_elbow: 1 }; // direction along z
const [holdStep, wayFromHold] = [0.2, 0.5]; // seconds
const usualHit = 1; // default for a held key
const mostHit = 3;
const handPoses = ['rest', 'relaxed', 'open', 'fist', 'point'];
const [mostSeconds, mostFrame] = [1e9, 1e9];
const folded = 165; // degrees: the largest bend
// Limits of turns about each axis, in degrees either way, by a part of the joint's name. Other joints may turn by 180 degrees. The limits are
// the same in model/motion/kinematics/joint_angles.cpp.
const mostTurn = { collar: 60, wrist: 90, ankle: 80, foot: 60, toe: 60, spine: 60, neck: 80, head: 80 };

/** Reads the keys of a key file as requests for streamDance; index.d.ts documents it. */
export function readKeys(file, skeleton) {
  return readAndWarn(file, skeleton, (id, message) => console.warn(`warning: key "${id}": ${message}`));
}

/** Reads the keys of a key file. Calls `warn(id, message)` for keys that will not be danced as written. */
export function readAndWarn(file, skeleton, warn) {
  requireSkeleton(skeleton);
  const keys = (typeof file === 'string' || ArrayBuffer.isView(file) ? parsed(file) : file)?.keyframes;
  if (!Array.isArray(keys)) throw invalid('file', 'has no list "keyframes"');
  if (keys.length === 0) throw invalid('keyframes', 'is empty');
  const read = keys.map((key, at) => readKey(key, `keyframes[${at}]`, `key${at + 1}`, skeleton, warn));
  const ids = new Set();
  read.forEach(({ key: { id } }, at) => {
    if (ids.has(id)) throw invalid(`keyframes[${at}].id`, `"${id}" is already the id of an earlier key`);
    ids.add(id);
  });
  const starts = read.flatMap(({ key }) => (key.time === undefined ? [] : key)).sort((a, b) => a.time - b.time);
  const timed = read.flatMap(({ key, hold }, at) => [key, ...held(key, hold, starts, `keyframes[${at}].hold`, warn)]);
  for (const when of ['time', 'frame']) if (timed.every((key) => when in key)) timed.sort((a, b) => a[when] - b[when]);
  return timed.map((keyframe) => ({ keyframe }));
}

function parsed(file) {
  try {
    return JSON.parse(typeof file === 'string' ? file : new TextDecoder().decode(file));
  } catch (error) {
    const isPath = typeof file === 'string' && /^[^{}\n]*[./\\][^{}\n]+$/.test(file);
    throw invalid('file', isPath ? `${quoted(file)} is a path: read it, and give its text` : `is not JSON: ${error.message}`);
  }
}

/** Returns a pose of the library as a Pose; index.d.ts documents it. */
export function libraryPose(name, skeleton, where = {}) {
  requireSkeleton(skeleton);
  requireWhere(where, '{ place: [x, z], facing: degrees }', ['place', 'facing']);
  const { place, facing } = where;
  const value = { pose: name, ...(place !== undefined && { place }), ...(facing !== undefined && { facing }) };
  const read = readPose(value, 'libraryPose', skeleton);
  if (read.lostJump) console.warn(`warning: libraryPose: ${read.lostJump}`);
  return poseOf(read);
}

const poseOf = ({ rotations, root }) => ({ ...(root && { root_position: { x: root[0], y: root[1], z: root[2] } }), rotations: rotations.flat() });

/** Reads a Keyframe, and for how long it is held. */
function readKey(value, field, name, skeleton, warn) {
  if (!isObject(value)) throw invalid(field, `${quoted(value)} is not a key`);
  for (const member of Object.keys(value)) {
    if (!members.includes(member)) throw invalid(`${field}.${member}`, `is not known; ${hint(member, members)}`);
  }
  const { id = name, hit, hands, joints, hold } = value;
  const when = ['time', 'frame'].filter((member) => member in value);
  if (when.length !== 1) throw invalid(`${field}.time`, when.length ? 'cannot be combined with frame' : 'is missing, and so is frame');
  if (typeof id !== 'string' || id === '') throw invalid(`${field}.id`, `${quoted(id)} is not a name`);
  const key = { id, [when[0]]: moment(value[when[0]], when[0], `${field}.${when[0]}`) };
  if (hit !== undefined) {
    key.hit = number(hit, `${field}.hit`);
    if (!(hit >= 0 && hit <= mostHit)) throw invalid(`${field}.hit`, `${hit} is not a number from 0 (gently) to ${mostHit} (late and fast)`);
  }
  if (hands !== undefined) {
    if (!handPoses.includes(hands)) throw invalid(`${field}.hands`, `${quoted(hands)} is none of ${handPoses.join(', ')}`);
    key.hands = `HAND_POSE_${hands.toUpperCase()}`;
  }
  const read = readPose(value, field, skeleton);
  const { rotations } = read;
  if (isObject(joints)) {
    if (Object.keys(joints).length === 0) throw invalid(`${field}.joints`, 'names no joint');
    for (const [joint, degrees] of Object.entries(joints)) {
      const at = `${field}.joints.${joint}`;
      rotations[jointOf(joint, skeleton, at)] = turnOf(joint, degrees, skeleton, at);
    }
    if (!('pose' in value) && !('rotations' in value)) key.mask = { joints: ascending([...('facing' in value ? [0] : []), ...Object.keys(joints).map((joint) => jointOf(joint, skeleton, field))]) };
  } else if (joints !== undefined) {
    key.mask = { joints: maskOf(joints, skeleton, `${field}.joints`) };
  }
  if (read.lostJump && setsFeet(key.mask, skeleton)) warn(id, read.lostJump);
  key.pose = poseOf(read);
  return { key, hold };
}

/** Whether a key determines how far below the root its feet are, and so the root's height when it stands. */
function setsFeet(mask, { feet, parents }) {
  const isSet = (joint) => joint < 0 || (mask.joints.includes(joint) && isSet(parents[joint]));
  return !mask || feet.every((foot) => isSet(parents[foot]));
}

/** Reads the rotations of all joints, the root's position, if any, and a warning for a jump that will be danced standing. */
function readPose(value, field, skeleton) {
  const { facing = 0 } = value;
  if (Math.abs(number(facing, `${field}.facing`)) > 360) throw invalid(`${field}.facing`, `${facing} degrees, must be -360 to 360`);
  const at = 'place' in value ? placeOf(value.place, `${field}.place`) : undefined;
  const count = skeleton.joint_names.length;
  if ('rotations' in value) {
    if ('pose' in value) throw invalid(`${field}.rotations`, 'cannot be combined with pose');
    if (!Array.isArray(value.rotations) || value.rotations.length !== count) throw invalid(`${field}.rotations`, `${quoted(value.rotations)} is not one vector for each of ${count} joints`);
    const rotations = value.rotations.map((one, at) => rotationOf(one, `${field}.rotations[${at}]`));
    const root = 'root_position' in value ? vector(value.root_position, 3, `${field}.root_position`) : undefined;
    if (at && !root) throw invalid(`${field}.place`, 'needs a root_position, which says how high the pose is');
    return placed({ rotations, root }, at, value.facing);
  }
  if ('root_position' in value) throw invalid(`${field}.rotations`, 'is missing beside root_position');
  if (!('pose' in value)) {
    if (!isObject(value.joints)) throw invalid(`${field}.rotations`, 'is missing, and so is pose');
    return placed({ rotations: skeleton.joint_names.map(() => [0, 0, 0]), root: at && [0, skeleton.pelvis_height, 0] }, at, value.facing);
  }
  if (skeleton.name !== 'smpl24') throw invalid(`${field}.pose`, `poses of the library are of smpl24, not of ${skeleton.name || 'this skeleton'}`);
  const named = find(value.pose, `${field}.pose`);
  const heading = [0, radians(facing), 0];
  const rotations = named.rotations.map((one, joint) => (joint === 0 ? times(heading, one) : [...one]));
  if (!at) {
    const lostJump = `${named.id} is in the air, but without a place it stands on the floor; give it one: "place": [x, z]`;
    return { rotations, ...(named.tags.includes('jump') && { lostJump }) };
  }
  const root = turned(heading, named.root_position);
  return { rotations, root: [root[0] + at[0], root[1], root[2] + at[1]] };
}

/** Moves a pose so that its root is above a place, and turns it there so that its root faces that way. */
function placed({ rotations: [pelvis, ...others], root }, at, facing) {
  const ahead = turned(pelvis, [0, 0, 1]);
  const turn = facing === undefined ? 0 : radians(facing) - Math.atan2(ahead[0], ahead[2]);
  return { rotations: [turn === 0 ? pelvis : times([0, turn, 0], pelvis), ...others], root: at ? [at[0], root[1], at[1]] : root };
}

/** Says that a hold ends at `now`, and not at `was`, because of the key `id` at `at` seconds. */
export function heldUpTo(now, was, id, at) {
  const [to, planned, then] = [now, was, at].map((seconds) => `${Math.round(100 * seconds) / 100} s`);
  return `it is held up to ${to}, not ${planned}: the key "${id}" comes at ${then}`;
}

/** Returns the keys that hold this one. Sets the key's hit unless it has one. Warns where another key ends the hold. */
function held(key, hold, starts, field, warn) {
  if (hold === undefined) return [];
  number(hold, field);
  if (key.time === undefined) throw invalid(field, 'goes with time');
  if (!(hold >= 0.1 && hold <= 60)) throw invalid(field, `${hold} s, must be 0.1 to 60`);
  const { hit, ...other } = key;
  key.hit = hit ?? usualHit;
  const steps = Math.max(1, Math.floor(hold / holdStep + 1e-9));
  const after = starts.find(({ time }) => time > key.time);
  const end = key.time + hold;
  const last = after?.time <= end ? after.time - wayFromHold : Infinity; // leaves time to reach a key within the hold
  const holding = Array.from({ length: steps }, (_, at) => ({ ...other, id: `${key.id} held ${at + 1}`, time: key.time + (hold * (at + 1)) / steps }));
  const kept = holding.filter(({ time }) => time <= last);
  if (kept.length < steps) warn(key.id, heldUpTo(kept.at(-1)?.time ?? key.time, end, after.id, after.time));
  return kept;
}

const ascending = (numbers) => [...new Set(numbers)].sort((a, b) => a - b);

function moment(value, kind, field) {
  if (kind === 'frame') {
    if (Number.isInteger(value) && value >= 0 && value <= mostFrame) return value;
    throw invalid(field, `${quoted(value)} is not a whole number from 0 to ${mostFrame}`);
  }
  if (number(value, field) < 0) throw invalid(field, `${value} s is before 0`);
  if (value > mostSeconds) throw invalid(field, `${value} s is beyond ${mostSeconds} s`);
  return value;
}

function rotationOf(value, field) {
  const angle = Math.hypot(...vector(value, 3, field));
  if (angle > 2 * Math.PI) throw invalid(field, `${Number(angle.toPrecision(6))} rad exceeds 2π; angles are in radians`);
  return value;
}

function jointOf(name, { name: body, joint_names: names }, field) {
  const joint = names.indexOf(name);
  if (joint < 0) throw invalid(field, `${quoted(name)} is not a joint of ${body || 'the skeleton'}; ${hint(String(name), names)}`);
  return joint;
}

/** Makes a mask of the joints with these names, some of which are whole limbs. */
function maskOf(names, skeleton, field) {
  if (!Array.isArray(names) || names.length === 0) throw invalid(field, `${quoted(names)} is not a list of joint names`);
  return ascending(
    names.flatMap((name) => {
      if (typeof name !== 'string') throw invalid(field, `${quoted(name)} is not a joint's name`);
      if (!Object.hasOwn(limbs, name)) return jointOf(name, skeleton, field);
      const limb = new Set(limbs[name].map((root) => jointOf(root, skeleton, field)));
      skeleton.parents.forEach((parent, joint) => limb.has(parent) && limb.add(joint)); // parents precede their children
      return [...limb];
    }),
  );
}

/** Makes a rotation from degrees: the bend of a knee or elbow, or another joint's turns about x, then y, then z. */
function turnOf(joint, degrees, skeleton, field) {
  const at = 3 * jointOf(joint, skeleton, field);
  if (!Object.hasOwn(bends, joint)) {
    const most = Object.entries(mostTurn).find(([part]) => joint.includes(part))?.[1] ?? 180;
    const turns = vector(degrees, 3, field);
    turns.forEach((turn, axis) => requireRange(joint, turn, ` about ${'xyz'[axis]}`, -most, most, field));
    const [x, y, z] = turns.map(radians);
    return times([0, 0, z], [0, y, 0], [x, 0, 0]);
  }
  requireRange(joint, number(degrees, field), '', 0, folded, field);
  const [x, y] = skeleton.offsets.slice(at, at + 2);
  const bend = (radians(degrees) * bends[joint]) / Math.hypot(x, y);
  return [bend * y, -bend * x, 0]; // about the cross product of the bone and z
}

function requireRange(joint, degrees, about, low, high, field) {
  if (!(degrees >= low && degrees <= high)) throw invalid(field, `${joint} is at ${degrees} degrees${about}, must be ${low} to ${high}`);
}
