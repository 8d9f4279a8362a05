// examples/node, and the calls of client/node, against a real choreod, which $CHOREO_SERVER names.
import assert from 'node:assert/strict';
import { execFile } from 'node:child_process';
import { once } from 'node:events';
import { mkdtemp, readFile, rm, writeFile } from 'node:fs/promises';
import { createServer } from 'node:net';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';
import { setTimeout as sleep } from 'node:timers/promises';
import { fileURLToPath } from 'node:url';
import { ChoreoClient, ChoreoError, pose } from '../../client/node/src/index.js';
import { clicks, live, pcm, wav } from '../../examples/node/music.js';
import { positive, whole } from '../../examples/node/program.js';

const address = process.env.CHOREO_SERVER;
const folder = fileURLToPath(new URL('../../examples/node/', import.meta.url));

/** What a program of the examples says, and how it ends. */
function program(name, ...flags) {
  return new Promise((resolve) => {
    execFile(process.execPath, [join(folder, name), '--server', address, ...flags], (failure, out, err) =>
      resolve({ code: failure?.code ?? 0, out, err }),
    );
  });
}

async function withClient(use) {
  const client = new ChoreoClient(address);
  try {
    await use(client, (await client.info()).models[0]);
  } finally {
    client.close();
  }
}

async function collect(answers) {
  const all = [];
  for await (const answer of answers) all.push(answer);
  return all;
}

/** A dance to silence that goes on until somebody ends it. */
async function* endless() {
  yield { config: { audio_format: pcm } };
  yield { keyframes_complete: {} };
  for (let first_sample = 0; ; first_sample += 735) {
    await sleep(5);
    yield { audio: { data: Buffer.alloc(2 * 735), first_sample } };
  }
}

const framesOf = (answers) => answers.filter((answer) => answer.frames).map((answer) => answer.frames);

test('live music is danced to while it plays, through the keys', async () => {
  await withClient(async (client, { skeleton, model_frame_rate }) => {
    let musicIsOver = false;
    let cameBefore = 0;
    async function* requests() {
      yield { config: { seed: '7', audio_format: pcm, frames: 3 * model_frame_rate } };
      yield { keyframe: { id: 'a', frame: 40, pose: pose(skeleton, { head: [0, 0.5, 0] }, { place: [0, 0.2] }) } };
      yield { keyframes_complete: {} };
      for await (const piece of live(clicks(3), 100)) {
        // The last piece waits for the first frames.
        if (piece.audio.first_sample > 2 * 22050) while (cameBefore === 0) await sleep(5);
        yield piece;
      }
      musicIsOver = true;
      yield { end_of_audio: {} };
    }
    const answers = [];
    for await (const answer of client.streamDance(requests())) {
      answers.push(answer);
      if (answer.frames && !musicIsOver) cameBefore += answer.frames.count;
    }
    assert.ok(cameBefore > 0);
    assert.equal(answers[0].response, 'header');
    assert.equal(answers[0].header.seed, '7');
    let frame = 0;
    for (const { first_frame, count, rotations } of framesOf(answers)) {
      assert.equal(Number(first_frame), frame);
      assert.equal(rotations.length, count * 3 * skeleton.joint_names.length);
      frame += count;
    }
    assert.equal(frame, 90);
    const reached = answers.find((answer) => answer.event?.keyframe_reached);
    assert.equal(reached.event.frame, '40');
    assert.ok(reached.event.keyframe_reached.errors.final_error_m <= 1e-3);
    assert.equal(answers.at(-1).response, 'summary');
  });
});

test('a dance goes on from its continuation, bit for bit, whatever its seed', async () => {
  await withClient(async (client, { skeleton }) => {
    const keys = [20, 40].map((frame) => ({ keyframe: { id: `at ${frame}`, frame, pose: pose(skeleton, { head: [0, frame / 100, 0] }) } }));
    const whole = await collect(client.streamDance([{ config: { seed: '18446744073709551615' } }, ...keys]));
    const { continuation } = whole.find((answer) => answer.continuation);
    const rest = await collect(client.streamDance([{ config: { continuation } }, ...keys]));
    const reached = (answers) => answers.filter(({ event }) => event?.keyframe_reached).map(({ event }) => event);
    assert.equal(reached(rest)[0].keyframe_reached.id, 'at 20');
    assert.deepEqual(reached(rest), reached(whole));
    const numbers = (answers) => framesOf(answers).flatMap(({ rotations }) => rotations);
    const end = numbers(rest);
    assert.ok(end.length > 0);
    assert.deepEqual(end, numbers(whole).slice(-end.length));
  });
});

test('errors name code, field and value', async () => {
  await withClient(async (client, { skeleton }) => {
    const bad = pose(skeleton);
    bad.rotations[0] = 1000;
    const dance = collect(client.streamDance([{ config: {} }, { keyframe: { id: 'a', frame: 9, pose: bad } }]));
    await assert.rejects(dance, (error) => {
      assert.ok(error instanceof ChoreoError);
      assert.equal(error.code, 'INVALID_ARGUMENT');
      assert.equal(error.violations[0].field, 'keyframe.pose.rotations[0]');
      assert.match(error.violations[0].description, /^1000 rad/);
      assert.match(error.message, /^requests\[1\]\.keyframe\.pose\.rotations\[0\]: 1000 rad/);
      return true;
    });
    // The numbers that were sent are counted, in the encoding of their pose.
    const quaternions = { root_position: { x: 0, y: 1, z: 0 }, encoding: 'ROTATION_ENCODING_QUATERNION' };
    quaternions.rotations = skeleton.joint_names.flatMap((_, joint) => [0, 0, 0, joint === 5 ? 2 : 1]);
    const turns = pose(skeleton, { [skeleton.joint_names[5]]: [0, 7, 0] });
    const sent = [
      [turns, 'rotations[15]'],
      [quaternions, 'rotations[20]'],
    ];
    for (const [wanted, field] of sent) {
      const requests = [{ config: {} }, { keyframe: { id: 'b', frame: 40, pose: turns } }];
      requests.splice(1, 1, { keyframe: { id: 'a', frame: 20, pose: wanted } });
      const of = { keyframeId: 'a', joint: 5, request: 1, field: `keyframe.pose.${field}` };
      await assert.rejects(collect(client.streamDance(requests)), ({ violations: [{ description, ...named }] }) => {
        assert.deepEqual(named, of);
        return true;
      });
      requests[0].config = { frames: 30, reject_invalid_keys: true };
      const rejected = (await collect(client.streamDance(requests))).find(({ event }) => event?.keyframe_rejected).event.keyframe_rejected;
      assert.deepEqual([rejected.id, rejected.field], ['a', of.field]);
      const after = collect(client.generateTransition({ config: {}, frames: 9, target: wanted }));
      await assert.rejects(after, ({ violations: [{ field: path }] }) => path === `target.${field}`);
    }
    const early = collect(client.streamDance([{ config: {} }, { keyframe: { id: 'c', frame: 'soon' } }]));
    await assert.rejects(early, ({ violations: [{ keyframeId }] }) => keyframeId === 'c');
    const unknown = collect(client.generateTransition({ config: { model: 'nobody' }, frames: 9 }));
    await assert.rejects(unknown, { code: 'NOT_FOUND', message: /nobody/ });
  });
});

test('keys come in order of time, or in any without grants', async () => {
  await withClient(async (client, { skeleton }) => {
    const keys = [40, 20].map((frame) => ({ keyframe: { id: `at ${frame}`, frame, pose: pose(skeleton) } }));
    const reached = async (config) => {
      const events = (await collect(client.streamDance([{ config: { frames: 60, ...config } }, ...keys]))).map(({ event }) => event);
      return [events.flatMap((event) => event?.keyframe_reached?.id ?? []), events.flatMap((event) => event?.keyframe_rejected?.id ?? [])];
    };
    assert.deepEqual(await reached({}), [['at 40'], ['at 20']]);
    assert.deepEqual(await reached({ generate_until: 0 }), [['at 20', 'at 40'], []]);
  });
});

test('warnings name their key', async () => {
  await withClient(async (client, { skeleton }) => {
    const key = { id: 'far', frame: 10, pose: pose(skeleton, {}, { place: [50, 0] }) };
    const warned = (await collect(client.streamDance([{ config: {} }, { keyframe: key }]))).filter(({ event }) => event?.warning);
    assert.deepEqual(warned.map(({ event }) => event.warning.keyframe_id), ['far', 'far']);
    const [planned, danced] = warned.map(({ event }) => event);
    assert.deepEqual([planned.warning.code, planned.frame], ['WARNING_CODE_INTERVAL_TOO_SHORT', '10']);
    assert.equal(danced.warning.code, 'WARNING_CODE_JOINT_TOO_FAST');
    assert(danced.warning.figure > danced.warning.limit, danced.warning.message);
  });
});

test('cards come on request', async () => {
  await withClient(async (client, { card }) => {
    assert.equal(card, '');
    assert.notEqual((await client.info({ cards: true })).models[0].card, '');
  });
});

test('a mistake in the requests ends the call with that mistake', async () => {
  await withClient(async (client) => {
    async function* requests() {
      yield { config: { audio_format: pcm } };
      throw new Error('the microphone is gone');
    }
    await assert.rejects(collect(client.streamDance(requests())), /the microphone is gone/);
  });
});

test('an aborted call ends here and on the server', async () => {
  await withClient(async (client) => {
    const stop = new AbortController();
    const read = async () => {
      for await (const answer of client.streamDance(endless(), { signal: stop.signal })) if (answer.frames) stop.abort(why);
    };
    const why = new Error('the page was closed');
    await assert.rejects(read(), { code: 'CANCELLED', cause: why });
    // So does one that is no longer read.
    for await (const answer of client.streamDance(endless())) if (answer.frames) break;
    while ((await client.info()).active_streams > 0) await sleep(5);
  });
});

test('a client that is closed ends its calls, and begins no others', async () => {
  const client = new ChoreoClient(address);
  const closed = { code: 'CANCELLED', message: 'the client is closed' };
  const dance = async () => {
    for await (const answer of client.streamDance(endless())) if (answer.frames) client.close();
  };
  await assert.rejects(dance(), closed);
  await assert.rejects(client.info(), closed);
  await assert.rejects(collect(client.streamDance([{ config: {} }])), closed);
  await assert.rejects(collect(client.generateTransition({ config: {}, frames: 9 })), closed);
});

test('a call that waits for its connection ends where nobody wants it any more', async () => {
  const mute = createServer().listen(0, '127.0.0.1'); // accepts, and never answers
  await once(mute, 'listening');
  try {
    const client = new ChoreoClient(`127.0.0.1:${mute.address().port}`, { connectTimeout: 600 });
    const stop = new AbortController();
    const [aborted, closed] = [client.info({ signal: stop.signal }), client.info()];
    const [socket] = await once(mute, 'connection');
    stop.abort('no longer');
    await assert.rejects(aborted, { code: 'CANCELLED', message: 'the call was cancelled', cause: 'no longer' });
    client.close();
    await assert.rejects(closed, { code: 'CANCELLED', message: 'the client is closed' });
    socket.destroy();
  } finally {
    mute.close();
  }
});

test('neither many calls nor many tries leave listeners of which Node.js warns', async () => {
  const warnings = [];
  const hear = (warning) => warnings.push(warning.message);
  process.on('warning', hear);
  const { signal } = new AbortController();
  await withClient(async (client) => {
    const calls = Array.from({ length: 12 }, () => collect(client.streamDance([{ config: { frames: 30 } }], { signal })));
    for (const answers of await Promise.all(calls)) assert.equal(answers.at(-1).response, 'summary');
  });
  const away = new ChoreoClient(Array(20).fill('127.0.0.1:1'), { retry: 0.5, firstBackoff: 0.001 }); // tries often
  await assert.rejects(away.info(), { code: 'UNAVAILABLE' });
  away.close();
  await sleep(0); // warnings come on the next tick
  process.off('warning', hear);
  assert.deepEqual(warnings, []);
});

test('a deadline ends a call', async () => {
  await withClient(async (client) => {
    const dance = collect(client.streamDance(endless(), { deadline: new Date(Date.now() + 100) }));
    await assert.rejects(dance, { code: 'DEADLINE_EXCEEDED', message: 'the deadline passed before the end of the call' });
  });
});

test('stream_dance.js dances live and to a song', async () => {
  const scratch = await mkdtemp(join(tmpdir(), 'choreo-'));
  try {
    const out = join(scratch, 'dance.json');
    const live = await program('stream_dance.js', '--seconds', '3', '--speed', '50', '--out', out);
    assert.equal(live.code, 0, live.err);
    assert.match(live.out, /arms up: reached to 0\.\d+ mm/);
    assert.match(live.out, /90 frames/);
    assert.match(live.err, /3\.0 s of 3 s/);
    const dance = JSON.parse(await readFile(out));
    assert.equal(dance.root_positions.length, 3 * 90);

    const song = join(scratch, 'song.wav');
    await writeFile(song, wav(clicks(2)));
    const recorded = await program('stream_dance.js', '--seconds', '2', '--song', song);
    assert.equal(recorded.code, 0, recorded.err);
    assert.match(recorded.out, /60 frames/);
    assert.doesNotMatch(recorded.err, /warning/);
    await writeFile(song, wav(clicks(2)).subarray(0, 40000));
    const cut = await program('stream_dance.js', '--seconds', '2', '--song', song);
    assert.match(cut.err, /warning: the music's file: its header says 88200 bytes of samples, 39956 are there/);
  } finally {
    await rm(scratch, { recursive: true });
  }
});

test('live_edit.js changes keys on the way', async () => {
  const { code, out, err } = await program('live_edit.js', '--seconds', '5', '--speed', '50');
  assert.equal(code, 0, err);
  assert.equal(out, 'second 2: reached\nsecond 4: reached\n150 frames\n');
});

test('options that are no numbers, files of other kinds, and songs that are missing, are named', async () => {
  for (const seconds of ['abc', '-3', '0']) {
    assert.throws(() => positive({ seconds }, 'seconds'), { code: '--seconds', message: `${seconds} is not a number above 0` });
  }
  for (const seed of ['-1', '1.5', 'NaN', '18446744073709551616']) {
    assert.throws(() => whole({ seed }, 'seed'), { code: '--seed', message: `${seed} is not a whole number from 0 to 18446744073709551615` });
  }
  const endless = await program('stream_dance.js', '--seconds=0');
  assert.deepEqual([endless.code, endless.err], [1, '--seconds: 0 is not a number above 0\n']);
  for (const name of ['stream_dance.js', 'live_edit.js', 'transition.js']) {
    const { code, err } = await program(name, '--seed=1.5');
    assert.deepEqual([code, err], [1, '--seed: 1.5 is not a whole number from 0 to 18446744073709551615\n']);
  }
  const wrong = await program('stream_dance.js', '--out', '/absent/dance.npz');
  assert.deepEqual([wrong.code, wrong.err], [1, '--out: /absent/dance.npz does not end with .json\n']);
  const dash = await program('stream_dance.js', '--seconds', '-3');
  assert.equal(dash.code, 1);
  assert.match(dash.err, /^ERR_PARSE_ARGS_INVALID_OPTION_VALUE: Option '--seconds'/);
  const { code, err } = await program('stream_dance.js', '--song', '/absent/song.mp3');
  assert.equal(code, 1);
  assert.match(err, /^ENOENT: no such file or directory, open '\/absent\/song.mp3'\n$/);
});

test('transition.js ranks candidates, and shows the field of an error', async () => {
  const good = await program('transition.js', '--frames', '20', '--candidates', '4');
  assert.equal(good.code, 0, good.err);
  assert.equal(good.out.match(/^candidate \d: 20 frames, steered \d+\.\d cm, without support \d+ %, skating \d+\.\d %$/gm).length, 4);
  const bad = await program('transition.js', '--frames', '5000');
  assert.equal(bad.code, 1);
  assert.match(bad.err, /INVALID_ARGUMENT: frames: 5000/);
  assert.match(bad.err, /field: frames/);
});
