// client/node reads key files as `choreo` does: read_keys.json has the keys of examples/, which KeyFileTest.PackagesReadTheSameKeys compares with
// those of C++. $CHOREO_SERVER names a choreod.
import assert from 'node:assert/strict';
import { once } from 'node:events';
import { readdirSync, readFileSync } from 'node:fs';
import { before, test } from 'node:test';
import { ChoreoClient, libraryPose, poses, readKeys } from '../../client/node/src/index.js';

const read = (path) => readFileSync(new URL(`../../${path}`, import.meta.url), 'utf8');
const known = JSON.parse(read('tests/examples/read_keys.json'));
const client = new ChoreoClient(process.env.CHOREO_SERVER);
let skeleton;
before(async () => ({ skeleton } = (await client.info()).models[0]));

/** The same, but for what rounding to six digits leaves out. */
function rounded(value) {
  if (typeof value === 'number') return Math.round(1e4 * value) / 1e4 + 0;
  if (Array.isArray(value)) return value.map(rounded);
  return typeof value === 'object' ? Object.fromEntries(Object.entries(value).map(([name, one]) => [name, rounded(one)])) : value;
}

test('key files are read as by choreo', () => {
  for (const [name, keys] of Object.entries(known)) {
    const mine = readKeys(read(`examples/${name}`), skeleton).map(({ keyframe }) => keyframe);
    assert.deepEqual(rounded(mine), rounded(keys), name);
  }
});

test('any pose is placed and turned as by choreo', () => {
  for (const { file, root, pelvis, joints } of JSON.parse(read('tests/examples/placed_keys.json'))) {
    const [{ keyframe: { pose, mask } }] = readKeys(file, skeleton);
    const near = (mine, known) => mine.forEach((number, at) => assert.ok(Math.abs(number - known[at]) < 1e-3, `${mine} ${known}`));
    assert.equal('root_position' in pose, root !== undefined);
    if (root) near(Object.values(pose.root_position), root);
    near(pose.rotations.slice(0, 3), pelvis);
    assert.deepEqual(mask?.joints ?? [], joints);
  }
});

test('keys of a file are danced', async () => {
  const reached = [];
  for await (const { event } of client.streamDance([{ config: { frames: 360 } }, ...readKeys(JSON.parse(read('examples/poses.json')), skeleton)])) {
    if (event?.keyframe_reached) reached.push(event.keyframe_reached.id);
  }
  client.close();
  assert.deepEqual(reached, known['poses.json'].map(({ id }) => id));
});

test('a pose of the library is danced', async () => {
  for (const { id } of poses()) {
    const [{ keyframe }] = readKeys({ keyframes: [{ time: 1, pose: id, place: [1, 2], facing: 90 }] }, skeleton);
    assert.deepEqual(libraryPose(id, skeleton, { place: [1, 2], facing: 90 }), keyframe.pose);
  }
  const kick = libraryPose('kick', skeleton);
  assert.ok(!('root_position' in kick));
  const another = new ChoreoClient(process.env.CHOREO_SERVER);
  for await (const answer of another.streamDance([{ config: { frames: 60 } }, { keyframe: { id: 'a', time: 1, pose: kick } }])) assert.ok(answer);
  another.close();
  assert.throws(() => libraryPose('kik', skeleton), { message: "libraryPose.pose: 'kik' is not a pose of the library; did you mean kick?" });
  for (const read of [() => libraryPose('kick'), () => readKeys({ keyframes: [] })]) assert.throws(read, { message: /^skeleton: undefined is none, as in / });
  assert.throws(() => readKeys('keys/no.json', skeleton), { message: "file: 'keys/no.json' is a path: read it, and give its text" });
});

test('a jump without a place, which stands, is warned of once a key', (t) => {
  const warn = t.mock.method(console, 'warn', () => {});
  const said = (make) => {
    warn.mock.resetCalls();
    make();
    return warn.mock.calls.map(({ arguments: [text] }) => text);
  };
  const stands = 'side_leap is in the air, but without a place it stands on the floor; give it one: "place": [x, z]';
  const leap = { id: 'up', time: 1, pose: 'side_leap' };
  const read = (key) => said(() => readKeys({ keyframes: [key] }, skeleton));
  assert.deepEqual(read({ ...leap, hold: 1 }), [`warning: key "up": ${stands}`]);
  assert.deepEqual(read({ ...leap, joints: ['legs', 'pelvis'] }), [`warning: key "up": ${stands}`]);
  assert.deepEqual(said(() => libraryPose('side_leap', skeleton)), [`warning: libraryPose: ${stands}`]);
  for (const fine of [{ place: [0, 0] }, { joints: ['arms'] }, { pose: 'kick' }]) assert.deepEqual(read({ ...leap, ...fine }), []);
  assert.deepEqual(said(() => [libraryPose('side_leap', skeleton, { place: [0, 0] }), libraryPose('kick', skeleton)]), []);
});

test('where a pose of the library is to be has no other members', () => {
  const form = '{ place: [x, z], facing: degrees }';
  for (const [where, message] of [
    [[1, 2], `where: [ 1, 2 ] is not ${form}`],
    [{ plase: [1, 2] }, `where.plase: is not known; it is ${form}`],
  ]) {
    assert.throws(() => libraryPose('kick', skeleton, where), { code: 'INVALID_ARGUMENT', message });
  }
});

test('poses have names and tags', () => {
  const files = readdirSync(new URL('../../client/poses', import.meta.url)).map((name) => name.replace('.json', ''));
  assert.deepEqual(poses().map(({ id }) => id), files.sort());
  for (const { id, description, tags, rotations } of poses()) assert.ok(description && tags.length > 0 && rotations.length === 24, id);
});

test('a key that is set into a hold ends it, and a warning says so', (t) => {
  const warn = t.mock.method(console, 'warn', () => {});
  const keys = readKeys({ keyframes: [{ time: 1, pose: 'stand', hold: 2 }, { time: 2.5, pose: 'dab' }] }, skeleton);
  assert.deepEqual(keys.map(({ keyframe: { time } }) => rounded(time)), [1, 1.2, 1.4, 1.6, 1.8, 2, 2.5]);
  const said = warn.mock.calls.map(({ arguments: [text] }) => text);
  assert.deepEqual(said, ['warning: key "key1": it is held up to 2 s, not 3 s: the key "key2" comes at 2.5 s']);
});

test('keys come in order', () => {
  const order = (keyframes, when) => readKeys({ keyframes }, skeleton).map(({ keyframe }) => keyframe[when]);
  assert.deepEqual(order([{ time: 3, pose: 'kick', hold: 0.4 }, { time: 1, pose: 'bow' }, { time: 3.3, pose: 'dab' }], 'time'), [1, 3, 3.3]);
  assert.deepEqual(order([{ frame: 9, pose: 'kick' }, { frame: 3, pose: 'bow' }], 'frame'), [3, 9]);
});

test('what choreo refuses is refused', () => {
  for (const { file, said } of JSON.parse(read('tests/examples/refused_keys.json'))) {
    assert.throws(() => readKeys(JSON.stringify(file), skeleton), ({ name, message }) => {
      assert.equal(name, 'ChoreoError', said);
      const plain = (text) => text.replaceAll("'", '"');
      assert.ok(plain(message).includes(plain(said)), `${message}\n${said}`);
      return true;
    });
  }
});

test('what is no JSON is refused', () => {
  for (const text of ['hello', Buffer.from('ff', 'hex'), '{"keyframes": [']) {
    assert.throws(() => readKeys(text, skeleton), { name: 'ChoreoError', message: /^file: is not JSON: / });
  }
});

test('what cannot be read is named', () => {
  for (const [key, field, said] of [
    [{ pose: 'stand' }, '.time', 'is missing, and so is frame'],
    [{ time: 1, frame: 2, pose: 'stand' }, '.time', 'cannot be combined with frame'],
    [{ time: '9c', pose: 'stand' }, '.time', "'9c' is not a number; counts need a song's beats: say seconds"],
    [{ time: 1, pose: 'stnad' }, '.pose', "'stnad' is not a pose of the library; "],
    [{ time: 1, poze: 'stand' }, '.poze', 'is not known; did you mean pose?'],
    [{ time: 1 }, '.rotations', 'is missing, and so is pose'],
    [{ time: 1, rotations: [[0, 0, 0]] }, '.rotations', 'is not one vector for each of 24 joints'],
    [{ time: 1, pose: 'stand', place: [1] }, '.place', '[ 1 ] is not a list of 2 numbers'],
    [{ time: 1, pose: 'stand', place: 'here' }, '.place', "'here' is not a list of 2 numbers, [x, z] in metres; leave it out, and the pose is taken wherever the dancer is"],
    [{ time: 1, joints: { left_knee: [1, 2, 3] } }, '.joints.left_knee', 'is not a number'],
    [{ time: 1, joints: { tail: [1, 2, 3] } }, '.joints.tail', "'tail' is not a joint of smpl24"],
    [{ time: 1, pose: 'stand', joints: ['tail'] }, '.joints', "'tail' is not a joint of smpl24"],
    [{ frame: 1, pose: 'stand', hold: 1 }, '.hold', 'goes with time'],
    [{ time: 1, pose: 'stand', hold: 61 }, '.hold', '61 s, must be 0.1 to 60'],
  ]) {
    assert.throws(() => readKeys({ keyframes: [key] }, skeleton), (error) => {
      assert.equal(error.violations[0].field, `keyframes[0]${field}`);
      return error.message.includes(said);
    });
  }
});

test('a key that comes too late is not missed', async () => {
  const another = new ChoreoClient(process.env.CHOREO_SERVER);
  const key = (id, time) => ({ keyframe: { id, time, pose: libraryPose('dab', skeleton) } });
  const requests = [{ config: { frames: 90 } }, key('second', 2), key('first', 1)];
  const watch = async (options) => {
    const rejected = [];
    for await (const { event } of another.streamDance(requests, options)) if (event?.keyframe_rejected) rejected.push(event.keyframe_rejected);
    return rejected;
  };
  const warned = once(process, 'warning');
  const [{ code }] = await watch();
  const [warning] = await warned;
  assert.deepEqual([warning.name, warning.code], ['KeyRejectedWarning', code]);
  assert.match(warning.message, /^key "first" is not danced as it was sent: frames before \d+ are frozen/);
  const heard = [];
  const never = (other) => assert.fail(other);
  process.on('warning', never);
  const events = await watch({ onRejected: (one) => heard.push(one) });
  await new Promise(setImmediate);
  process.off('warning', never);
  assert.deepEqual(heard, events);
  assert.equal(heard[0].id, 'first');
  another.close();
});
