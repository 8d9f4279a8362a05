// Key files, as `choreo dance --keyframes` takes them: docs/poses.md.
import { invalid } from './error.js';
import { find } from './poses.js';
import { radians, times, turned } from './turns.js';
import { hint, quoted } from './words.js';

const members = ['id', 'time', 'frame', 'hold', 'hit', 'hands', 'pose', 'place', 'facing', 'joints', 'root_position', 'rotations'];
const limbs = { arms: ['left_shoulder', 'right_shoulder'], legs: ['left_hip', 'right_hip'] };
for (const side of ['left', 'right']) {
  limbs[`${side}_arm`] = [`${side}_shoulder`];
  limbs[`${side}_leg`] = [`${side}_hip`];
}
const bends = { left_knee: -1, right_knee: -1, left_elbow: 1, right_elbow: 1 }; // towards z
const [holdStep, wayFromHold] = [0.2, 0.5]; // seconds
const usualHit = 1; // of a key that is held

/** The keys of a key file as requests of streamDance; index.d.ts says more. */
export function readKeys(file, skeleton) {
  const keys = (typeof file === 'string' || ArrayBuffer.isView(file) ? JSON.parse(file) : file)?.keyframes;
  if (!Array.isArray(keys)) throw invalid('keyframes', `${quoted(keys)} is no list of keys`);
  const read = keys.map((key, at) => readKey(key, `keyframes[${at}]`, `key${at + 1}`, skeleton));
  const starts = read.flatMap(({ key }) => key.time ?? []).sort((a, b) => a - b);
  return read.flatMap(({ key, hold }, at) => [key, ...held(key, hold, starts, `keyframes[${at}].hold`)]).map((keyframe) => ({ keyframe }));
}

/** A Keyframe, and for how long it is held. */
function readKey(value, field, name, skeleton) {
  if (!isObject(value)) throw invalid(field, `${quoted(value)} is no key`);
  for (const member of Object.keys(value)) {
    if (!members.includes(member)) throw invalid(`${field}.${member}`, `is not known; ${hint(member, members)}`);
  }
  const { id = name, hit, hands, joints, hold } = value;
  const when = ['time', 'frame'].filter((member) => member in value);
  if (when.length !== 1) throw invalid(`${field}.time`, when.length ? 'stands beside frame; only one may be there' : 'is missing, and so is frame');
  const key = { id, [when[0]]: number(value[when[0]], `${field}.${when[0]}`) };
  if (hit !== undefined) key.hit = hit;
  if (hands !== undefined) key.hands = `HAND_POSE_${String(hands).toUpperCase()}`;
  const { rotations, root } = readPose(value, field, skeleton);
  key.pose = root ? { root_position: { x: root[0], y: root[1], z: root[2] } } : {};
  if (isObject(joints)) {
    for (const [joint, degrees] of Object.entries(joints)) {
      const at = `${field}.joints.${joint}`;
      rotations[jointOf(joint, skeleton, at)] = turnOf(joint, degrees, skeleton, at);
    }
    if (!('pose' in value) && !('rotations' in value)) key.mask = { joints: ascending(Object.keys(joints).map((joint) => jointOf(joint, skeleton, field))) };
  } else if (joints !== undefined) {
    key.mask = { joints: maskOf(joints, skeleton, `${field}.joints`) };
  }
  key.pose.rotations = rotations.flat();
  return { key, hold };
}

/** The rotations of all joints, and where the root is, or nothing. */
function readPose(value, field, skeleton) {
  for (const member of ['place', 'facing']) if (member in value && !('pose' in value)) throw invalid(`${field}.${member}`, 'goes with pose');
  const count = skeleton.joint_names.length;
  if ('rotations' in value) {
    if ('pose' in value) throw invalid(`${field}.rotations`, 'stands beside pose; only one may be there');
    if (value.rotations?.length !== count) throw invalid(`${field}.rotations`, `${quoted(value.rotations)} is not one vector for each of ${count} joints`);
    const rotations = value.rotations.map((one, at) => vector(one, 3, `${field}.rotations[${at}]`));
    return { rotations, root: value.root_position && vector(value.root_position, 3, `${field}.root_position`) };
  }
  if ('root_position' in value) throw invalid(`${field}.rotations`, 'is missing beside root_position');
  if (!('pose' in value)) {
    if (!isObject(value.joints)) throw invalid(`${field}.rotations`, 'is missing, and so is pose');
    return { rotations: skeleton.joint_names.map(() => [0, 0, 0]) };
  }
  if (skeleton.name !== 'smpl24') throw invalid(`${field}.pose`, `poses of the library are of smpl24, not of ${skeleton.name || 'this skeleton'}`);
  const named = find(value.pose, `${field}.pose`);
  const heading = [0, radians(number(value.facing ?? 0, `${field}.facing`)), 0];
  const rotations = named.rotations.map((one, joint) => (joint === 0 ? times(heading, one) : [...one]));
  if (!('place' in value)) return { rotations };
  const [x, z] = vector(value.place, 2, `${field}.place`);
  const root = turned(heading, named.root_position);
  return { rotations, root: [root[0] + x, root[1], root[2] + z] };
}

/** The keys that hold this one, which from then on says how hard it is hit. */
function held(key, hold, starts, field) {
  if (hold === undefined) return [];
  number(hold, field);
  if (key.time === undefined) throw invalid(field, 'goes with time');
  if (!(hold >= 0.1 && hold <= 60)) throw invalid(field, `${hold} s, must be 0.1 to 60`);
  const { hit, ...other } = key;
  key.hit = hit ?? usualHit;
  const steps = Math.max(1, Math.floor(hold / holdStep + 1e-9));
  const after = starts.find((start) => start > key.time) ?? Infinity;
  const last = after > key.time + hold ? Infinity : after - wayFromHold; // who comes meanwhile needs time
  return Array.from({ length: steps }, (_, at) => ({ ...other, id: `${key.id} held ${at + 1}`, time: key.time + (hold * (at + 1)) / steps })).filter(({ time }) => time <= last);
}

const isObject = (value) => typeof value === 'object' && value !== null && !Array.isArray(value);
const ascending = (numbers) => [...new Set(numbers)].sort((a, b) => a - b);

function number(value, field) {
  if (Number.isFinite(value)) return value;
  throw invalid(field, `${quoted(value)} is no number${/c$/.test(value) ? "; counts need a song's beats: say seconds" : ''}`);
}

function vector(value, size, field) {
  if (!Array.isArray(value) || value.length !== size) throw invalid(field, `${quoted(value)} is not a list of ${size} numbers`);
  return value.map((one, at) => number(one, `${field}[${at}]`));
}

function jointOf(name, { name: body, joint_names: names }, field) {
  const joint = names.indexOf(name);
  if (joint < 0) throw invalid(field, `${quoted(name)} is no joint of ${body || 'the skeleton'}; ${hint(String(name), names)}`);
  return joint;
}

/** The joints of these names, whole limbs among them. */
function maskOf(names, skeleton, field) {
  if (!Array.isArray(names) || names.length === 0) throw invalid(field, `${quoted(names)} is not a list of joint names`);
  return ascending(
    names.flatMap((name) => {
      if (!Object.hasOwn(limbs, name)) return jointOf(name, skeleton, field);
      const limb = new Set(limbs[name].map((root) => jointOf(root, skeleton, field)));
      skeleton.parents.forEach((parent, joint) => limb.has(parent) && limb.add(joint)); // which are there before their children
      return [...limb];
    }),
  );
}

/** A rotation: of knees and elbows their bend, of others turns about x, then y, then z. */
function turnOf(joint, degrees, skeleton, field) {
  if (!Object.hasOwn(bends, joint)) {
    const [x, y, z] = vector(degrees, 3, field).map(radians);
    return times([0, 0, z], [0, y, 0], [x, 0, 0]);
  }
  const at = 3 * jointOf(joint, skeleton, field);
  const [x, y] = skeleton.offsets.slice(at, at + 2);
  const bend = (radians(number(degrees, field)) * bends[joint]) / Math.hypot(x, y);
  return [bend * y, -bend * x, 0]; // about the bone's cross product with z
}
