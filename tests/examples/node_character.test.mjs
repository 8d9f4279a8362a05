// client/node/character: dances on characters, as `choreo convert --character` puts them there. $CHOREO is the program, $WRITE_CHARACTERS writes rigs.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtemp, readFile, rm, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { rigs } from '../../client/node/character/bone_names.js';
import { bonesByNames } from '../../client/node/character/human_bones.js';
import { bonesOf, Character, gltfBones, smplPoses } from '../../client/node/character/index.js';

const root = fileURLToPath(new URL('../../', import.meta.url));
let scratch;
let body; // SMPL's, as a header has it
let dance; // as messages have it, by quaternions

/** A .glb: {json, tracks}, its animation's tracks by node and path. */
async function readGlb(path) {
  const bytes = await readFile(path);
  const length = bytes.readUInt32LE(12);
  const json = JSON.parse(bytes.toString('utf8', 20, 20 + length));
  const binary = 20 + length + 8;
  const numbers = (index) => {
    const { bufferView, byteOffset = 0, count, type, componentType } = json.accessors[index];
    assert.equal(componentType, 5126);
    const at = binary + (json.bufferViews[bufferView].byteOffset ?? 0) + byteOffset;
    return Array.from({ length: count * { SCALAR: 1, VEC3: 3, VEC4: 4 }[type] }, (_, i) => bytes.readFloatLE(at + 4 * i));
  };
  const tracks = new Map();
  for (const { channels, samplers } of json.animations ?? []) {
    for (const { sampler, target } of channels) tracks.set(`${target.node} ${target.path}`, numbers(samplers[sampler].output));
  }
  return { json, tracks };
}

const choreo = (...args) => execFileSync(process.env.CHOREO, args, { cwd: scratch, stdio: 'pipe' });

/** Poses in which hands touch and knees bend, so that all of the inverse kinematics has something to do. */
const poses = ['hands_on_head', 'kneel', 'hands_on_hips', 'high_kick', 'arms_crossed', 'crouch', 'bow'];

before(async () => {
  scratch = await mkdtemp(join(tmpdir(), 'choreo-'));
  execFileSync(process.env.WRITE_CHARACTERS, [scratch]);
  const keyframes = poses.map((pose, i) => ({ id: pose, time: 0.8 * (i + 1), pose, facing: 50 * i, place: [0.3 * i, -0.2 * i] }));
  await writeFile(join(scratch, 'keys.json'), JSON.stringify({ keyframes }));
  choreo('dance', '--server', process.env.CHOREO_SERVER, '--keyframes', 'keys.json', '--out', 'dance.npz', '--seconds', '6.4');
  choreo('convert', 'dance.npz', 'smpl.glb');
  const { json, tracks } = await readGlb(join(scratch, 'smpl.glb'));
  const nodes = gltfBones(json).slice(0, 24);
  body = {
    name: 'smpl24',
    joint_names: nodes.map(({ name }) => name),
    parents: nodes.map(({ parent }, at) => (at === 0 ? -1 : parent)),
    offsets: nodes.flatMap(({ position }, at) => (at === 0 ? [0, 0, 0] : position)),
    pelvis_height: 0,
  };
  let lowest = 0;
  const heights = [0];
  for (let joint = 1; joint < 24; ++joint) {
    heights[joint] = heights[body.parents[joint]] + nodes[joint].position[1];
    lowest = Math.min(lowest, heights[joint]);
  }
  body.pelvis_height = 0.02 - lowest; // the lower toes stand 2 cm above the floor
  const places = tracks.get('0 translation');
  const count = places.length / 3;
  const turns = nodes.map((_, joint) => tracks.get(`${joint} rotation`));
  const rotations = Array.from({ length: count }, (_, frame) => turns.flatMap((track) => track.slice(4 * frame, 4 * frame + 4))).flat();
  dance = { first_frame: '0', count, root_positions: places, rotations };
});
after(() => rm(scratch, { recursive: true }));

/** A part of the dance, as a message. */
function part(from, to) {
  const cut = (list, width) => list.slice(width * from, width * Math.min(to, dance.count));
  return { first_frame: String(from), count: Math.min(to, dance.count) - from, root_positions: cut(dance.root_positions, 3), rotations: cut(dance.rotations, 96) };
}

/** All poses, of messages of so many frames. */
function danceOn(character, frames = 12) {
  const stream = character.dance({ frame_rate: 30 });
  const poses = [];
  for (let from = 0; from < dance.count; from += frames) poses.push(...stream.add(part(from, from + frames)));
  return [...poses, ...stream.end()];
}

const angle = (a, b) => 2 * Math.asin(Math.min(1, Math.min(distance(a, b), distance(a, b.map((one) => -one))) / 2));
const distance = (a, b) => Math.hypot(...a.map((one, i) => one - b[i]));

async function compare(name, ...flags) {
  choreo('convert', 'dance.npz', 'out.glb', '--character', `${name}.glb`, '--hands', 'rest', ...flags);
  const map = flags.length > 0 ? JSON.parse(await readFile(join(scratch, flags.at(-1)), 'utf8')).bones : {};
  const { tracks } = await readGlb(join(scratch, 'out.glb'));
  const { json } = await readGlb(join(scratch, `${name}.glb`));
  const character = new Character(gltfBones(json), body, { map });
  const poses = danceOn(character);
  assert.equal(poses.length, dance.count);
  const expected = [...character.turning.map((node) => `${node} rotation`), ...character.moving.map((node) => `${node} translation`)];
  assert.deepEqual(expected.sort(), [...tracks.keys()].sort());
  let [worst, farthest] = [0, 0];
  poses.forEach(({ frame, turns, places }, at) => {
    assert.equal(frame, at);
    character.turning.forEach((node, i) => {
      worst = Math.max(worst, angle(turns.slice(4 * i, 4 * i + 4), tracks.get(`${node} rotation`).slice(4 * at, 4 * at + 4)));
    });
    character.moving.forEach((node, i) => {
      const size = Math.hypot(...json.nodes[node].translation);
      farthest = Math.max(farthest, distance(places.slice(3 * i, 3 * i + 3), tracks.get(`${node} translation`).slice(3 * at, 3 * at + 3)) / size);
    });
  });
  return { worst, farthest, character, json };
}

for (const name of ['mixamo', 'child', 'long']) {
  test(`the bones of ${name}.glb turn as choreo has them turn`, async (t) => {
    const { worst, farthest } = await compare(name);
    t.diagnostic(`${worst} rad, ${farthest} of the hips' height`);
    assert.ok(worst < 1e-4, `${worst} rad`);
    assert.ok(farthest < 1e-4, `${farthest}`);
  });
}

/** The file of a character with fingers, which the others lack. */
async function giveFingers(from, to) {
  const bytes = await readFile(join(scratch, from));
  const length = bytes.readUInt32LE(12);
  const json = JSON.parse(bytes.toString('utf8', 20, 20 + length));
  const grow = (above, name, translation, rotation = [0.1, 0.2, -0.1, 0.9695]) => {
    (json.nodes[above].children ??= []).push(json.nodes.length);
    return json.nodes.push({ name: `mixamorig:${name}`, translation, rotation }) - 1;
  };
  for (const side of ['Left', 'Right']) {
    const find = (name) => json.nodes.findIndex((node) => node.name === `mixamorig:${side}Hand${name}`);
    const [x, y, z] = json.nodes[find('Middle1')].translation; // from the wrist
    const [ahead, across] = [[x, y, z], [-y, x, 0.3 * z].map((one) => (side === 'Left' ? one : -one))];
    const along = (a, b) => ahead.map((one, i) => a * one + b * across[i]);
    for (const [finger, knuckle] of [['Thumb', along(0.4, 0.6)], ['Index', along(1, 0.3)], ['Ring', along(1, -0.3)], ['Pinky', along(0.9, -0.6)]]) {
      let above = grow(find(''), `${side}Hand${finger}1`, knuckle, [0, 0, 0, 1]);
      for (const joint of [2, 3, 4]) above = grow(above, `${side}Hand${finger}${joint}`, along(0.3, 0.03 * joint));
    }
    grow(grow(find('Middle1'), `${side}HandMiddle2`, along(0.35, 0)), `${side}HandMiddle3`, along(0.3, 0.1));
  }
  const text = Buffer.from(JSON.stringify(json));
  const chunk = Buffer.concat([text, Buffer.alloc(-text.length & 3, ' ')]);
  const out = Buffer.concat([bytes.subarray(0, 20), chunk, bytes.subarray(20 + length)]);
  out.writeUInt32LE(out.length, 8);
  out.writeUInt32LE(chunk.length, 12);
  await writeFile(join(scratch, to), out);
}

test('hands take their poses as choreo has them', async () => {
  await giveFingers('mixamo.glb', 'fingers.glb');
  const { json } = await readGlb(join(scratch, 'fingers.glb'));
  for (const hands of [undefined, 'relaxed', 'open', 'fist', 'point', 'rest']) {
    choreo('convert', 'dance.npz', 'out.glb', '--character', 'fingers.glb', ...(hands ? ['--hands', hands] : []));
    const { tracks } = await readGlb(join(scratch, 'out.glb'));
    const character = new Character(gltfBones(json), body, { hands });
    assert.deepEqual(character.turning.map((node) => `${node} rotation`).sort(), [...tracks.keys()].filter((key) => key.endsWith('rotation')).sort());
    const { turns } = danceOn(character)[7];
    const fingers = character.turning.slice(22);
    assert.equal(fingers.length >= 20, hands !== 'rest');
    fingers.forEach((node, i) => {
      assert.ok(angle(turns.slice(4 * (22 + i), 4 * (23 + i)), tracks.get(`${node} rotation`).slice(0, 4)) < 1e-4, `${hands} ${json.nodes[node].name}`);
    });
  }
  assert.throws(() => new Character(gltfBones(json), body, { hands: 'claw' }), { message: 'hands: claw is none of rest, relaxed, open, fist, point' });
});

test('what is in place, and what a map names, is as choreo has it', async () => {
  choreo('convert', 'dance.npz', 'still.glb', '--character', 'mixamo.glb', '--hands', 'rest', '--root-motion', 'in-place');
  const { tracks } = await readGlb(join(scratch, 'still.glb'));
  const { json } = await readGlb(join(scratch, 'mixamo.glb'));
  const still = new Character(gltfBones(json), body, { inPlace: true });
  const [pelvis] = still.moving;
  danceOn(still).forEach(({ places }, at) => {
    assert.ok(distance(places, tracks.get(`${pelvis} translation`).slice(3 * at, 3 * at + 3)) < 1e-3, at); // of 94, as its unit is a centimetre
  });
  assert.throws(() => choreo('convert', 'dance.npz', 'out.glb', '--character', 'nameless.glb')); // yet it writes a guess
  const { worst } = await compare('nameless', '--map', 'out.map.json');
  assert.ok(worst < 1e-4, worst);
});

test('the names of rigs are those that choreo knows', () => {
  execFileSync('python3', [join(root, 'scripts/bone_names.py'), '--check']);
  assert.ok(rigs.length > 30);
});

const needed = ['hip', 'knee', 'ankle', 'shoulder', 'elbow', 'wrist'].flatMap((bone) => [`left_${bone}`, `right_${bone}`]);

test('every rig is found by its names, and as tools respell them', () => {
  const first = (names) => names.split('|')[0];
  for (const { name, sides, pelvis, spine, neck, head, limbs } of rigs) {
    const limb = (text) => sides.map((side, i) => first(text).replaceAll('*', side).replaceAll('@', i === 0 ? 'left' : 'right'));
    const names = [first(pelvis), ...spine.split('|'), first(neck), first(head), ...limbs.filter(Boolean).flatMap(limb)];
    const respelt = {
      'as it is': names,
      'with a prefix': names.map((one) => `hero:${one}`),
      'with numbers': names.map((one, at) => `${one}_${String(at).padStart(3, '0')}`),
      // Two common endings are one too many.
      'with an ending': names.map((one) => (/_(JNT|joint)$/.test(one) ? one : `${one}_jnt`)),
      // GLTFLoader of three.js takes these signs out.
      'without signs': names.map((one) => one.replace(/\s/g, '_').replace(/[[\].:/]/g, '')),
    };
    for (const [how, all] of Object.entries(respelt)) {
      const bones = bonesByNames(all);
      for (const bone of ['pelvis', 'head', ...needed]) assert.ok(bone in bones, `${name} ${how}: ${bone}`);
    }
    const bones = bonesByNames(names);
    assert.deepEqual([bones.pelvis, names[bones.left_knee], names[bones.right_wrist]], [0, limb(limbs[1])[0], limb(limbs[7])[1]], name);
  }
});

/** A scene as three.js has it, of a file's nodes. */
function sceneOf({ nodes, scenes }) {
  const list = (values) => ({ values, toArray: () => values, fromArray(from, at = 0) { this.values = from.slice(at, at + values.length); } });
  const objects = nodes.map(({ name, translation = [0, 0, 0], rotation = [0, 0, 0, 1], scale = [1, 1, 1] }) => ({
    name: name.replace(/[[\].:/]/g, ''),
    userData: { name },
    children: [],
    position: list(translation),
    quaternion: list(rotation),
    scale: list(scale),
  }));
  nodes.forEach(({ children = [] }, at) => objects[at].children.push(...children.map((child) => objects[child])));
  return { scene: { children: scenes[0].nodes.map((top) => objects[top]) }, objects };
}

test('a scene of three.js dances, by its names or as a VRM', async () => {
  const { json } = await readGlb(join(scratch, 'mixamo.glb'));
  const expected = danceOn(new Character(gltfBones(json), body))[40];
  for (const vrm of [false, true]) {
    const { scene, objects } = sceneOf(json);
    const called = Object.fromEntries(objects.map((object, at) => [json.nodes[at].name, object]));
    const names = { hips: 'Hips', spine: 'Spine', chest: 'Spine1', upperChest: 'Spine2', neck: 'Neck', head: 'Head' };
    for (const [side, Side] of [['left', 'Left'], ['right', 'Right']]) {
      const parts = { UpperLeg: 'UpLeg', LowerLeg: 'Leg', Foot: 'Foot', Toes: 'ToeBase', Shoulder: 'Shoulder', UpperArm: 'Arm', LowerArm: 'ForeArm', Hand: 'Hand' };
      for (const [part, name] of Object.entries(parts)) names[side + part] = Side + name;
    }
    const humanoid = Object.fromEntries(Object.entries(names).map(([bone, name]) => [bone, { node: called[`mixamorig:${name}`] }]));
    if (vrm) objects.forEach((object, at) => (object.userData.name = `bone ${at}`));
    const { bones, objects: ours } = bonesOf(scene, vrm ? humanoid : {});
    const character = new Character(bones, body);
    const { frame, turns, places } = danceOn(character)[40];
    assert.equal(frame, 40);
    character.show({ turns, places }, ours);
    const hand = called['mixamorig:LeftForeArm'];
    const node = json.nodes.findIndex(({ name }) => name === 'mixamorig:LeftForeArm');
    const at = new Character(gltfBones(json), body).turning.indexOf(node);
    assert.ok(angle(hand.quaternion.values, expected.turns.slice(4 * at, 4 * at + 4)) < 1e-9);
    assert.deepEqual(called['mixamorig:Hips'].position.values, expected.places);
  }
});

test('messages may be of any size and encoding', async () => {
  const { json } = await readGlb(join(scratch, 'long.glb'));
  const character = new Character(gltfBones(json), body);
  const whole = danceOn(character, dance.count);
  assert.deepEqual(danceOn(character, 1), whole);
  const stream = character.dance({ frame_rate: 30 });
  assert.deepEqual(stream.add(part(0, 7)), [], 'hands look ahead');
  assert.deepEqual(stream.add(part(7, 8)).map(({ frame }) => frame), [0]);
  const vectors = dance.rotations.flatMap((_, i, all) => {
    if (i % 4 > 0) return [];
    const [x, y, z, w] = all.slice(i, i + 4);
    const sine = Math.hypot(x, y, z);
    const scale = sine > 0 ? (2 * Math.atan2(sine, w)) / sine : 2;
    return [scale * x, scale * y, scale * z];
  });
  const other = character.dance({ frame_rate: 30 });
  const poses = [...other.add({ ...part(0, dance.count), rotations: Float64Array.from(vectors) }), ...other.end()];
  poses.forEach(({ turns }, at) => turns.forEach((one, i) => assert.ok(Math.abs(one - whole[at].turns[i]) < 1e-6)));
});

test('what is no body says why', async () => {
  const { json } = await readGlb(join(scratch, 'mixamo.glb'));
  const bones = gltfBones(json);
  const refused = (change, message, options) => {
    const copy = structuredClone(bones);
    change(copy);
    assert.throws(() => new Character(copy, body, options), { name: 'TypeError', message });
  };
  const at = (name) => bones.findIndex((bone) => bone.name === `mixamorig:${name}`);
  refused((all) => (all[at('LeftLeg')].name = 'x'), /^bones: none of them is the left_knee; the others are (.*, )?x\b.*: say which is by { map: { left_knee: name } }$/);
  refused((all) => (all[at('LeftUpLeg')].name = 'x'), /^bones: none of them is the left_hip; the others are (.*, )?x\b.*: say which is by { map: { left_hip: name } }$/);
  refused((all) => all.forEach((bone) => (bone.name = '')), /^bones: none of them is the pelvis, left_hip, .* and 8 more; no others have names: say which is by /);
  const renamed = structuredClone(bones);
  renamed[at('LeftUpLeg')].name = 'x';
  assert.deepEqual(new Character(renamed, body, { map: { left_hip: 'x' } }).bones, new Character(bones, body).bones);
  refused((all) => (all[2].parent = 99), 'bones[2].parent: 99 is not a bone, and not -1');
  refused((all) => (all[at('Hips')].parent = at('Spine')), 'bones: some are their own ancestors');
  refused((all) => (all[3].rotation = [0, 0, NaN, 1]), 'bones[3].rotation: 0,0,NaN,1 is not 4 finite numbers');
  refused((all) => (all[at('Head')].scale = [0, 0, 0]), `bones[${at('Head')}].scale: is zero`);
  refused(() => {}, 'map.tail: is none of pelvis, spine1, spine2, spine3, spine4, spine5, spine6, neck, neck2, neck3, head, ' + ['left', 'right'].map((side) => ['hip', 'knee', 'ankle', 'foot', 'collar', 'shoulder', 'elbow', 'wrist', 'hand', 'eye'].map((bone) => `${side}_${bone}`).join(', ')).join(', '), { map: { tail: 'x' } });
  refused(() => {}, 'map.head: "x" is none of the bones', { map: { head: 'x' } });
  refused(() => {}, 'bones: left_knee and right_knee are one node', { map: { right_knee: 'mixamorig:LeftLeg' } });
  refused(() => {}, 'options.inplace: is none of map, inPlace, hands', { inplace: true });
  assert.throws(() => new Character(bones), /^TypeError: skeleton: undefined is not a dance's header\.skeleton$/);
  assert.throws(() => new Character(undefined, body), /^TypeError: bones: undefined is not a list of bones/);
  assert.throws(() => new Character(bones, body).dance(), /^TypeError: header: undefined is not a dance's header$/);
  assert.throws(() => new Character(bones, { ...body, name: 'other' }), /^TypeError: skeleton: other is not smpl24$/);
  const stream = new Character(bones, body).dance({ frame_rate: 30 });
  assert.throws(() => stream.add({ ...part(0, 9), rotations: [1, 2] }), /^TypeError: frames: 2 rotations are not of 9 frames of 24 joints$/);
  stream.add(part(0, 9));
  assert.throws(() => stream.add(part(8, 12)), /^TypeError: frames.first_frame: 8, the next one is 9$/);
});

test("SMPL's own joints may be shown, too", () => {
  const poses = smplPoses(part(30, 50), body);
  assert.deepEqual(poses.map(({ frame }) => frame), Array.from({ length: 20 }, (_, i) => 30 + i));
  const sent = part(30, 50);
  poses.forEach(({ turns, places }, at) => {
    assert.deepEqual(places, sent.root_positions.slice(3 * at, 3 * at + 3));
    for (let i = 0; i < 96; i += 4) assert.ok(angle(turns.slice(i, i + 4), sent.rotations.slice(96 * at + i, 96 * at + i + 4)) < 1e-6);
  });
});
