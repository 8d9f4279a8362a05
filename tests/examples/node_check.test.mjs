// client/node: requests and options that are not known are refused by field, value and what is allowed. $CHOREO_SERVER names a choreod.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { setTimeout as sleep } from 'node:timers/promises';
import { ChoreoClient, ChoreoError, pose } from '../../client/node/src/index.js';
import { clicks, pcm, wav } from '../../examples/node/music.js';
import { withServer } from './servers.mjs';

const skeleton = { name: 'two', joint_names: ['pelvis', 'left_shoulder'], pelvis_height: 1 };

async function withClient(use) {
  const client = new ChoreoClient(process.env.CHOREO_SERVER);
  try {
    await use(client);
  } finally {
    client.close();
  }
}

async function collect(answers) {
  const all = [];
  for await (const answer of answers) all.push(answer);
  return all;
}

const frames = (answers) => answers.reduce((sum, answer) => sum + (answer.frames?.count ?? 0), 0);
const config = { config: { frames: 30 } };
const keyframe = (fields) => [config, { keyframe: { id: 'a', time: 0.5, ...fields } }];

test('a request that the API does not know is refused by its path', () =>
  withClient(async (client) => {
    for (const [requests, field, description, width = 3] of [
      [[{ config: { frameRate: 60 } }], 'config.frameRate', 'no field of DanceConfig; did you mean frame_rate?'],
      [[{ config: { rate: undefined } }], 'config.rate', 'no field of DanceConfig; did you mean frame_rate?'],
      [[{ config: { audio_format: { zoom: 1 } } }], 'config.audio_format.zoom', /^no field of AudioFormat; there are encoding, sample_rate, /],
      [keyframe({ when: { time: 2 } }), 'keyframe.when', /^no field of Keyframe; there are id, frame, time, /],
      [[{ config: { encoding: 'QUATERNION' } }], 'config.encoding', "'QUATERNION' is not a RotationEncoding; did you mean ROTATION_ENCODING_QUATERNION?"],
      [[{ config: { encoding: 77 } }], 'config.encoding', /^77 is not a RotationEncoding; there are ROTATION_ENCODING_UNSPECIFIED, /],
      [keyframe({ hands: 'fist' }), 'keyframe.hands', "'fist' is not a HandPose; did you mean HAND_POSE_FIST?"],
      [keyframe({ pose: { root_position: [0, 1, 0] } }), 'keyframe.pose.root_position', '[ 0, 1, 0 ] is not a Vector3, {x, y, z}'],
      [keyframe({ pose: Promise.resolve({}) }), 'keyframe.pose', /is not a Pose/],
      [keyframe({ pose: { rotations: [0, NaN] } }), 'keyframe.pose.rotations[1]', 'NaN is not a finite number'],
      [keyframe({ pose: { rotations: [...Array(7).fill(0), NaN] } }), 'keyframe.pose.rotations[7]', 'NaN is not a finite number'],
      [keyframe({ pose: { encoding: 'ROTATION_ENCODING_QUATERNION', rotations: [...Array(7).fill(0), NaN] } }), 'keyframe.pose.rotations[7]', 'NaN is not a finite number', 4],
      [keyframe({ pose: { rotations: [[0, 0, 0]] } }), 'keyframe.pose.rotations[0]', '[ 0, 0, 0 ] is not a number; rotations is one flat list: give lists.flat()'],
      [keyframe({ pose: { rotations: new DataView(new ArrayBuffer(8)) } }), 'keyframe.pose.rotations', /is not an array$/],
      [keyframe({ pose: { rotations: new Float32Array([0, NaN]) } }), 'keyframe.pose.rotations[1]', 'NaN is not a finite number'],
      [keyframe({ pose: { rotations: 'none' } }), 'keyframe.pose.rotations', "'none' is not an array"],
      [keyframe({ mask: { joints: ['head'] } }), 'keyframe.mask.joints[0]', "'head' is not a whole number"],
      [keyframe({ time: '6' }), 'keyframe.time', "'6' is not a finite number"],
      [keyframe({ hit: '1' }), 'keyframe.hit', "'1' is not a finite number"],
      [keyframe({ pose: { rotations: ['0'] } }), 'keyframe.pose.rotations[0]', "'0' is not a finite number"],
      [keyframe({ mask: { joints: ['1'] } }), 'keyframe.mask.joints[0]', "'1' is not a whole number"],
      [keyframe({ id: 5 }), 'keyframe.id', '5 is not a string'],
      [keyframe({ id: 'a\ud800' }), 'keyframe.id', "'a\\ud800' has half a character, a surrogate without its pair"],
      [[{ config: { style: '\udc83\ud83d' } }], 'config.style', / has half a character, /],
      [keyframe({ pose: { rotations: [0, 0, 0, 1e300] } }), 'keyframe.pose.rotations[3]', '1e+300 is beyond the numbers of 32 bits, which end at 3.4e38'],
      [keyframe({ frame: 3 }), 'keyframe.frame', 'given beside time; there is one of frame, time, interval_after_previous'],
      [[{ config: {}, end_of_audio: {} }], 'end_of_audio', /^given beside config; there is one of config, audio, /],
      [[{ config: { allow_inexact_resume: 'no' } }], 'config.allow_inexact_resume', "'no' is not a boolean"],
      ...[1.5, '1e3', true, []].map((seed) => [[{ config: { seed } }], 'config.seed', / is not a whole number$/]),
      [[{ config: { seed: -1 } }], 'config.seed', '-1 is less than 0'],
      [[{ config: { seed: '18446744073709551616' } }], 'config.seed', "'18446744073709551616' is more than 18446744073709551615"],
      [[{ config: { frames: 1.5 } }], 'config.frames', '1.5 is not a whole number'],
      [[{ config: { seed: 2 ** 64 } }], 'config.seed', /; numbers above 2\^53 go as text$/],
      [[config, { keyframe: null }], 'keyframe', /^null is not a Keyframe, /],
      [[config, { remove_keyframe: undefined }], 'remove_keyframe', /^undefined is not a RemoveKeyframe, /],
      [[config, undefined], 'requests[1]', /^undefined is not a StreamDanceRequest, {config, audio, /],
      [[config, [config]], 'requests[1]', /is not a StreamDanceRequest/],
      [undefined, 'requests', 'undefined is not an iterable of messages'],
      [null, 'requests', 'null is not an iterable of messages'],
    ]) {
      await assert.rejects(collect(client.streamDance(requests)), (error) => {
        assert.ok(error instanceof ChoreoError, error);
        assert.deepEqual([error.code, error.reason], ['INVALID_ARGUMENT', 'INVALID_VALUE']);
        assert.equal(error.violations[0].field, field);
        const number = /rotations\[(\d+)\]$/.exec(field)?.[1];
        assert.equal(error.violations[0].joint, number && Math.floor(number / width));
        const said = error.violations[0].description;
        if (typeof description === 'string') assert.equal(said, description);
        else assert.match(said, description);
        const at = requests ? Array.from(requests).length - 1 : undefined;
        assert.equal(error.message, `${requests && !field.startsWith('requests') ? `requests[${at}].` : ''}${field}: ${said}`);
        assert.equal(error.violations[0].request, at);
        return true;
      });
    }
    const ranked = collect(client.generateTransition({ config: {}, frames: 9, rank_by: 'LIKELIHOOD' }));
    await assert.rejects(ranked, { message: "rank_by: 'LIKELIHOOD' is not a RankBy; did you mean RANK_BY_LIKELIHOOD?" });
    await assert.rejects(collect(client.generateTransition({ frames: 9, candidates: -1 })), { message: 'candidates: -1 is less than 0' });
    await assert.rejects(collect(client.generateTransition()), { message: /^request: undefined is not a GenerateTransitionRequest/ });
  }));

test('a fault in one of several requests is told with its index', () =>
  withClient(async (client) => {
    const open = { config: { frames: 99, generate_until: 0 } };
    const heard = { config: { frames: 99, audio_format: { encoding: 'AUDIO_ENCODING_PCM_S16LE', sample_rate: 16000, channels: 1 } } };
    const piece = { data: new Uint8Array(100) };
    for (const [requests, message] of [
      [[open, {}], /^requests\[1\]: is empty; there are config, audio, /],
      [[open, { keyframe: undefined, controls: undefined }], /^requests\[1\]\.keyframe: undefined is not a Keyframe/],
      [[open, { generate_until: { frame: 9 } }, { config: {} }], 'requests[2].config: came before; it may come only once'],
      [[heard, { audio: piece }, { audio: { ...piece, first_sample: 500 } }, { audio: piece }], 'requests[2].audio.first_sample: 500 leaves a gap: the sample expected is 50'],
      [[open, { generate_until: { frame: 20 } }, { generate_until: { frame: 10 } }], 'requests[2].generate_until.frame: 10 is not in [20, 108000]: it may only grow'],
      // Without its music the dance does not end before the second arrives.
      [[heard, { keyframes_complete: {} }, { keyframes_complete: {} }], 'requests[2].keyframes_complete: comes after the keys are complete'],
      [[heard, { end_of_audio: {} }, { audio: piece }], 'requests[1].end_of_audio: no sample came before'],
    ]) {
      await assert.rejects(collect(client.streamDance(requests)), { code: /^(INVALID_ARGUMENT|OUT_OF_RANGE)$/, message });
    }
  }));

test('one request is not a list', async () => {
  const client = new ChoreoClient(process.env.CHOREO_SERVER);
  await assert.rejects(client.streamDance({ config: {} }).next(), { message: 'requests: is one object: put it in a list, [{ config }, ...]' });
  await assert.rejects(client.streamDance(Promise.resolve([{ config: {} }])).next(), { message: 'requests: is a Promise: await it first' });
  client.close();
});

test('with reject_invalid_keys a request that is wrong beside its key ends the dance, too', () =>
  withClient(async (client) => {
    const lenient = { config: { frames: 30, reject_invalid_keys: true } };
    for (const [wrong, field] of [
      [{ keyfarme: {} }, 'keyfarme'],
      [{ end_of_audio: {}, keyframe: { id: 5 } }, 'keyframe'],
      [{ keyframe: { id: 5 }, end_of_audio: {} }, 'keyframe.id'],
      [{ remove_keyframe: { id: 5 }, end_of_audio: {} }, 'remove_keyframe.id'],
    ]) {
      await assert.rejects(collect(client.streamDance([lenient, wrong])), (error) => error.violations[0].field === field);
    }
  }));

test('options of calls that cannot be used are named before the call', () =>
  withClient(async (client) => {
    const calls = [
      (options) => client.info(options),
      (options) => collect(client.streamDance([{ config: { frames: 9 } }], options)),
      (options) => collect(client.generateTransition({ config: {}, frames: 9 }, options)),
    ];
    for (const [options, message] of [
      [{ deadline: new Date('nonsense') }, 'deadline: Invalid Date is not a date'],
      [{ deadline: NaN }, 'deadline: NaN is not a date'],
      [{ deadline: 'soon' }, "deadline: 'soon' is not a date"],
      [{ deadline: new Date(8.64e15) }, 'deadline: +275760-09-13T00:00:00.000Z is not a date within 10 000 years'],
      [{ deadline: 500 }, 'deadline: 500 is not a date of today; numbers are milliseconds since 1970, as Date.now() + 500'],
      [{ deadlin: new Date() }, 'deadlin: no option of this call; did you mean deadline?'],
      [{ timeout: 3 }, /^timeout: no option of this call; there are signal, deadline/],
      [{ signal: 5 }, 'signal: 5 is not an AbortSignal'],
      ['x', /^options: 'x' is not an object {signal, deadline/],
      [null, /^options: null is not an object {signal, deadline/],
    ]) {
      for (const call of calls) await assert.rejects(call(options), { name: 'ChoreoError', code: 'INVALID_ARGUMENT', message });
    }
    const [info, dance] = calls;
    await assert.rejects(dance({ on_resume: () => {} }), { message: 'on_resume: no option of this call; did you mean onResume?' });
    await assert.rejects(dance({ onResume: 5 }), { message: 'onResume: 5 is not a function' });
    await assert.rejects(info({ onResume: () => {} }), { message: /^onResume: no option of this call; there are signal, deadline, cards$/ });
    await assert.rejects(info({ cards: 'all' }), { message: "cards: 'all' is neither true nor false" });
    const soon = Date.now() + 60000;
    for (const deadline of [new Date(soon), soon, Infinity, undefined, null]) {
      for (const call of calls) await call({ deadline, signal: new AbortController().signal });
    }
    for (const call of calls) await assert.rejects(call({ deadline: new Date(0) }), { code: 'DEADLINE_EXCEEDED' });
  }));

test('what is refused here begins no call', () =>
  withServer([], async ({ address, log }) => {
    const client = new ChoreoClient(address);
    const wrong = { config: { sead: 1 } };
    async function* late(...requests) {
      for (const request of requests) yield sleep(5, request);
    }
    for (const requests of [[wrong], [config, { keyframe: { id: 5 } }], [wrong].values(), late(wrong)]) {
      await assert.rejects(collect(client.streamDance(requests)), { code: 'INVALID_ARGUMENT' });
    }
    // Nobody waits longer for a request than for a call.
    const never = () => late(new Promise(() => {}));
    await assert.rejects(collect(client.streamDance(never(), { deadline: Date.now() + 50 })), { code: 'DEADLINE_EXCEEDED' });
    await assert.rejects(collect(client.streamDance(never(), { signal: AbortSignal.timeout(50) })), { code: 'CANCELLED' });
    assert.equal(frames(await collect(client.streamDance(late(config)))), 30);
    while (!log().includes('OK in')) await sleep(5);
    assert.equal(log().match(/StreamDance .*INVALID/g), null, log());
    assert.equal(log().match(/StreamDance .*: OK/g).length, 1, log());
    client.close();
    const nobody = new ChoreoClient('127.0.0.1:1');
    await assert.rejects(collect(nobody.streamDance([wrong])), { code: 'INVALID_ARGUMENT' });
    nobody.close();
  }));

test('whole numbers come as numbers, text and bigints', () =>
  withClient(async (client) => {
    for (const seed of [7, '7', 7n]) assert.equal((await collect(client.streamDance([{ config: { seed, frames: 30 } }])))[0].header.seed, '7');
  }));

test('lists of numbers may be typed arrays', () =>
  withClient(async (client) => {
    const { skeleton: body } = (await client.info()).models[0];
    const plain = pose(body, { left_shoulder: [0, 0, 0.5] });
    const dance = async (given, joints) => {
      const key = { keyframe: { id: 'a', time: 1, pose: given, mask: { joints } } };
      return (await collect(client.streamDance([{ config: { seed: 1, frames: 60 } }, key]))).flatMap((answer) => answer.frames?.rotations ?? []);
    };
    const typed = await dance({ ...plain, rotations: new Float32Array(plain.rotations) }, new Uint8Array([1, 2]));
    assert.deepEqual(typed, await dance(plain, [1, 2]));
  }));

test('a source whose request is refused is ended', () =>
  withClient(async (client) => {
    let ended = false;
    function* requests() {
      try {
        yield { config: {} };
        yield { keyfarme: {} };
      } finally {
        ended = true;
      }
    }
    await assert.rejects(collect(client.streamDance(requests())), { message: 'requests[1].keyfarme: no field of StreamDanceRequest; did you mean keyframe?' });
    assert.ok(ended);
  }));

test('music is bytes, or the samples that its encoding says', () =>
  withClient(async (client) => {
    const dance = (encoding, data) =>
      collect(client.streamDance([{ config: { audio_format: { encoding, sample_rate: 8000, channels: 1 } } }, { audio: { data } }]));
    const [floats, shorts] = [new Float32Array(8000), new Int16Array(8000)];
    const bytes = [Buffer.from(floats.buffer), new Uint8Array(floats.buffer), floats.buffer, new DataView(floats.buffer)];
    for (const data of [floats, ...bytes]) assert.equal(frames(await dance('AUDIO_ENCODING_PCM_F32LE', data)), 30);
    for (const data of [shorts, shorts.buffer]) assert.equal(frames(await dance('AUDIO_ENCODING_PCM_S16LE', data)), 30);
    assert.equal(frames(await dance(1, floats.subarray(4000))), 15);
    const wrong = /^requests\[1\]\.audio\.data: Float32Array is not what config\.audio_format\.encoding says, AUDIO_ENCODING_PCM_S16LE: that is Int16Array or any bytes$/;
    for (const encoding of ['AUDIO_ENCODING_PCM_S16LE', 2]) await assert.rejects(dance(encoding, floats), { message: wrong });
    for (const data of [[1, 2], 'song.mp3', 5]) {
      await assert.rejects(dance('AUDIO_ENCODING_PCM_S16LE', data), { message: /^requests\[1\]\.audio\.data: .* is not bytes/ });
    }
  }));

test('pieces of music are numbered, of samples and of files, where nobody says where they start', () =>
  withClient(async (client) => {
    const samples = clicks(2);
    const kinds = [
      [{ encoding: 'AUDIO_ENCODING_FILE' }, wav(samples)],
      [pcm, samples],
    ];
    for (const [audio_format, music] of kinds) {
      const config = { seed: 1, frames: 60, generate_until: 0, audio_format };
      const pieces = [music.subarray(0, 30000), music.subarray(30000, 60000), music.subarray(60000)].map((data) => ({ audio: { data } }));
      const whole = { audio: { data: music, first_sample: 0 } };
      const dance = async (audio) => (await collect(client.streamDance([{ config }, ...audio, { end_of_audio: {} }, { keyframes_complete: {} }]))).flatMap((answer) => answer.frames?.rotations ?? []);
      assert.deepEqual(await dance(pieces), await dance([whole]));
      assert.equal(pieces[1].audio.first_sample, undefined, 'the caller sees its own');
    }
  }));

test('music that no message can hold is refused before it is sent', () =>
  withClient(async (client) => {
    const config = { frames: 30, audio_format: { encoding: 'AUDIO_ENCODING_PCM_F32LE', sample_rate: 48000, channels: 1 } };
    const dance = (data) => collect(client.streamDance([{ config }, { audio: { data } }, { end_of_audio: {} }]));
    const wrong = (size, remedy, place = 'requests[1].') => ({
      code: 'INVALID_ARGUMENT',
      message: `${place}audio.data: ${size} MiB; a message has at most 16 MiB in all: ${remedy}`,
    });
    const pieces = 'send it in pieces';
    await assert.rejects(dance(new Uint8Array(17 << 20)), wrong('17.0', pieces));
    await assert.rejects(dance(new Uint8Array(16 << 20)), wrong('16.0', pieces));
    assert.equal(frames(await dance(new Uint8Array((16 << 20) - 32))), 30);
    const transition = collect(client.generateTransition({ config, frames: 9, audio: { data: new Uint8Array(17 << 20) } }));
    await assert.rejects(transition, wrong('17.0', 'send the music of its frames alone, or a compressed file', ''));
  }));

test('a pose of joints that are not there, or of what is no rotation, is refused', () => {
  for (const [rotations, message] of [
    [{ leftShoulder: [0, 0, 1] }, 'rotations.leftShoulder: no joint of two; did you mean left_shoulder?'],
    [{ tail: [0, 0, 1] }, 'rotations.tail: no joint of two; there are pelvis, left_shoulder'],
    [5, 'rotations: 5 is not {joint name: [x, y, z]}'],
    [{ pelvis: 1 }, 'rotations.pelvis: 1 is not [x, y, z], three finite numbers'],
    [{ pelvis: [1, 2] }, 'rotations.pelvis: [ 1, 2 ] is not [x, y, z], three finite numbers'],
    [{ pelvis: [0, NaN, 0] }, 'rotations.pelvis: [ 0, NaN, 0 ] is not [x, y, z], three finite numbers'],
  ]) {
    assert.throws(() => pose(skeleton, rotations), { code: 'INVALID_ARGUMENT', message });
  }
  assert.throws(() => pose(null), { message: /^skeleton: null is none/ });
  assert.deepEqual(pose(skeleton, { left_shoulder: new Float32Array([0, 0, 1]) }).rotations, [0, 0, 0, 0, 0, 1]);
});

test('a pose is wherever the dancer is, or at its place', () => {
  for (const where of [undefined, {}, { place: undefined }]) assert.ok(!('root_position' in pose(skeleton, {}, where)));
  assert.deepEqual(pose(skeleton, {}, { place: [3, 2] }).root_position, { x: 3, y: 1, z: 2 });
  for (const [where, message] of [
    [[1, 2], 'where: [ 1, 2 ] is not { place: [x, z] }'],
    [null, 'where: null is not { place: [x, z] }'],
    [{ X: 1 }, 'where.X: is not known; it is { place: [x, z] }'],
    [{ x: 1, z: 2 }, 'where.x: is not known; it is { place: [x, z] }'],
    [{ place: [1] }, 'where.place: [ 1 ] is not a list of 2 numbers, [x, z] in metres; leave it out, and the pose is taken wherever the dancer is'],
    [{ place: [NaN, 0] }, 'where.place[0]: NaN is not a number'],
  ]) {
    assert.throws(() => pose(skeleton, {}, where), { code: 'INVALID_ARGUMENT', message });
  }
});
