// client/node, the package: who may come, and dances that outlive their server. $CHOREO_SERVER names a choreod, $CHOREOD the
// program of it.
import assert from 'node:assert/strict';
import { createHash } from 'node:crypto';
import { mkdtemp, readFile, rm, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';
import { setTimeout as sleep } from 'node:timers/promises';
import { ChoreoClient, pose } from '../../client/node/src/index.js';
import { noAnswer } from '../../client/node/src/connect_faults.js';
import { firstOutputFrame } from '../../client/node/src/header.js';
import { Journal } from '../../client/node/src/journal.js';
import { Patience } from '../../client/node/src/replicas.js';
import { clicks, live, pcm } from '../../examples/node/music.js';
import { collect, danceAndKill, told, undisturbed, withClient } from './killed_dance.mjs';
import { authority, withServer } from './servers.mjs';

const other = process.env.CHOREO_SERVER;

async function withFolder(use) {
  const folder = await mkdtemp(join(tmpdir(), 'choreo-'));
  try {
    return await use(folder);
  } finally {
    await rm(folder, { recursive: true });
  }
}

const info = (address, options) => withClient(address, { retry: 0, ...options }, (client) => client.info());

const tokenLine = (token, name) => `${createHash('sha256').update(token).digest('hex')} ${name}\n`;

test('a token is sent, read again for each call, and a wrong one refused', () =>
  withFolder(async (folder) => {
    const [tokens, mine] = [join(folder, 'tokens'), join(folder, 'mine')];
    await writeFile(tokens, tokenLine('secret', 'alice'));
    await withServer(['--tokens', tokens], async ({ address }) => {
      await assert.rejects(info(address), { code: 'UNAUTHENTICATED', message: /^a token is needed; send the metadata/ });
      await assert.rejects(info(address, { token: 'guessed' }), { code: 'UNAUTHENTICATED', message: /^that token is unknown/ });
      assert.ok((await info(address, { token: 'secret' })).models.length > 0);
      await withClient(address, { tokenFile: mine }, async (client) => {
        await assert.rejects(client.info(), { code: 'INVALID_ARGUMENT', message: `tokenFile: no file ${mine}` });
        await writeFile(mine, 'guessed\n');
        const dance = () => collect(client.streamDance([{ config: { frames: 30 } }]));
        await assert.rejects(dance(), { code: 'UNAUTHENTICATED' });
        await writeFile(mine, 'secret\n');
        assert.equal((await dance()).at(-1).response, 'summary');
        assert.equal((await collect(client.generateTransition({ config: {}, frames: 9 }))).at(-1).response, 'summary');
      });
    });
  }));

test('what pages tell of the music is danced to', async () => {
  for (const name of ['client/node/README.md', 'docs/api.md']) {
    const page = await readFile(new URL(`../../${name}`, import.meta.url), 'utf8');
    const [, told] = /(\{ ?"?music_dynamics[^\]]+\][^\]]+\][^\]]+\] ?\})/.exec(page);
    const heard = Function(`return ${told}`)();
    const beats = [];
    await withClient(other, {}, (client) =>
      collect(client.streamDance([{ config: { frames: 45, ...heard } }]), ({ event }) => event?.beat && beats.push([event.time, event.beat.downbeat])),
    );
    assert.deepEqual(beats, heard.music_beats.map((time) => [time, heard.music_downbeats.includes(time)]), name);
    assert.ok(heard.variation > 0 && heard.music_passages.length > 0, name);
  }
});

test('TLS: authority, certificate of the client, name of the server', () =>
  withFolder(async (folder) => {
    const { ca, issue } = authority(folder);
    const server = issue('server', 'DNS:choreod');
    const own = issue('client', 'DNS:client');
    const flags = ['--tls-cert', server.cert, '--tls-key', server.key, '--tls-client-ca', ca.cert];
    await withServer(flags, async ({ address }) => {
      const all = { tls: true, caCertificate: ca.cert, clientCertificate: own.cert, clientKey: own.key, serverName: 'choreod' };
      assert.ok((await info(address, all)).models.length > 0);
      const texts = { ...all, caCertificate: await readFile(ca.cert, 'utf8'), clientCertificate: await readFile(own.cert, 'utf8'), clientKey: await readFile(own.key, 'utf8') };
      assert.ok((await info(address, texts)).models.length > 0);
      const refused = (options, message = /./) => assert.rejects(info(address, options), { code: 'UNAVAILABLE', message });
      await refused({ ...all, caCertificate: undefined }, /certificate is not trusted \(.*(?:unable to verify|self-signed).*\(caCertificate\)$/);
      await refused({ ...all, serverName: undefined }, /certificate is of .*, not of 127\.0\.0\.1: say of which as serverName$/);
      await refused({ ...all, clientCertificate: undefined, clientKey: undefined });
      await refused({}, /the server there wants TLS: set tls$/);
    });
  }));

test('what only other options can mend is told at once, in one line', () =>
  withFolder(async (folder) => {
    const { ca, issue } = authority(folder);
    const server = issue('server', 'DNS:choreod');
    const patient = { retry: 3600 };
    const trusting = { ...patient, tls: true, caCertificate: ca.cert };
    const refused = (address, options, what) =>
      assert.rejects(info(address, options), { code: 'UNAVAILABLE', message: new RegExp(`^${[address].flat().at(-1)}: ${what}$`) });
    await refused(other, trusting, 'the server there speaks no TLS: leave out tls');
    await refused('nobody.invalid:50051', patient, 'no host of that name is known \\(addresses\\)');
    await withServer(['--tls-cert', server.cert, '--tls-key', server.key], async ({ address }) => {
      await refused(address, patient, 'the server there wants TLS: set tls');
      await refused(address, { ...patient, tls: true }, "the server's certificate is not trusted \\(.*\\): name the PEM file of its authority \\(caCertificate\\)");
      const elsewhere = { ...trusting, serverName: 'elsewhere' };
      const wrongName = "the server's certificate is of choreod, not of elsewhere: say of which as serverName";
      await refused(address, elsewhere, wrongName);
      await refused([address, address], elsewhere, wrongName);
      assert.ok((await info(address, { ...trusting, serverName: 'choreod' })).models.length > 0);
    });
    await assert.rejects(info('127.0.0.1:1'), { code: 'UNAVAILABLE', message: '127.0.0.1:1: no server can be reached: connection refused' });
    const both = ['127.0.0.1:1', '127.0.0.1:2'];
    await assert.rejects(info(both, { retry: 1 }), { code: 'UNAVAILABLE', message: '127.0.0.1:1, 127.0.0.1:2: no server can be reached: connection refused' });
  }));

test('options that cannot be used are named', () =>
  withFolder(async (folder) => {
    const { ca, issue } = authority(folder);
    const own = issue('client', 'DNS:client');
    const far = '192.0.2.1:50051';
    for (const [addresses, options, message] of [
      [[], {}, 'addresses: none is given'],
      ['localhost:70000', {}, 'addresses: localhost:70000: port 70000 is not in [1, 65535]'],
      [far, { token: 'secret' }, `token: a token is sent to ${far} only over TLS`],
      [`ipv4:127.0.0.1:1,${far}`, { token: 'secret' }, `token: a token is sent to ipv4:127.0.0.1:1,${far} only over TLS`],
      [far, { tls: true, token: 'two words' }, 'token: it is not one line of visible ASCII characters'],
      [far, { caCertificate: ca.cert }, `caCertificate: "${ca.cert}" needs TLS, which is off`],
      [far, { tls: true, caCertificate: join(folder, 'absent') }, `caCertificate: no file ${join(folder, 'absent')}`],
      [far, { tls: true, clientKey: own.key }, 'clientCertificate: missing; a certificate and its key go together'],
      [far, { tls: true, caCertificate: ca.key }, new RegExp(`^caCertificate: ${ca.key} holds no certificate in PEM`)],
      [far, { tls: true, clientCertificate: own.cert, clientKey: ca.key }, new RegExp(`^clientKey: ${ca.key} is not the key of ${own.cert}`)],
      [far, { connectTimeout: 0 }, 'connectTimeout: 0 s leave no time to connect'],
      [far, { silence: 1 }, 'silence: 1 s is neither 0 nor at least 2 s'],
      [far, { retry: -1 }, 'retry: -1 is not a finite number >= 0'],
      [far, { tls: 'yes' }, "tls: 'yes' is not a boolean"],
      [far, { token_file: 'x' }, 'token_file: no option; did you mean tokenFile?'],
      [far, { tsl: true }, 'tsl: no option; did you mean tls?'],
      [far, { patience: 1 }, /^patience: no option; there are tls, caCertificate, /],
      ['http://one:50051', {}, 'addresses: http://one:50051 is a URL; use HOST:PORT, and the option tls for TLS'],
      ['dns:///one', {}, 'addresses: dns:///one has no port; use HOST:PORT'],
      [undefined, {}, 'addresses: undefined is not a HOST:PORT'],
      [far, { tls: true, token: 'secret\n' }, 'token: it begins or ends with spaces or a newline; trim it'],
      [far, { tls: true, token: Buffer.from('secret') }, 'token: Buffer is not a string'],
      [other, { token: '' }, 'token: it is not one line of visible ASCII characters'],
      [far, { tls: true, caCertificate: await readFile(ca.key, 'utf8') }, /^caCertificate: the text holds no certificate in PEM: (?!.*-----)/s],
      [far, { tls: true, clientCertificate: own.cert, clientKey: await readFile(ca.key, 'utf8') }, /^clientKey: the text is not the key of (?!.*-----)/s],
    ]) {
      assert.throws(() => new ChoreoClient(addresses, options), { code: 'INVALID_ARGUMENT', message });
    }
  }));

/** Keys that the package refuses itself, but for the third and two removals, and what is wrong with them. Two would move a key that is there. */
const badKeys = [
  { keyframe: { id: 'moved', time: 'soon' } },
  { keyframe: { id: 'blank', frame: 160, pose: { rotations: [0, NaN] } } },
  { keyframe: { id: 'blank' } },
  { keyframe: { id: 5, frame: 160 } },
  { keyframe: 'wave' },
  { keyframe: { id: 'hurried', time: 0.5, tim: 3 } },
  { keyframe: { id: 'twice', frame: 9, time: 3 } },
  { keyframe: { id: 'next', frame: 45, pose: 5 } },
  { keyframe: { id: 'after', interval_after_previous: 15, pose: 5 } },
  { keyframe: { id: 'half \ud83d', frame: 160 } },
  { remove_keyframe: { id: 'next' } },
  { remove_keyframe: { id: 'nobody' } },
  { keyframe: null },
  { remove_keyframe: undefined },
  { keyframe: undefined, remove_keyframe: { id: 5 } },
  { remove_keyframe: 'zz' },
  { remove_keyframe: { id: 'early', idd: 's' } },
];
const refusedHere = [
  ['moved', 'REJECTION_CODE_INVALID', 'keyframe.time', -1],
  ['blank', 'REJECTION_CODE_INVALID', 'keyframe.pose.rotations[1]', 160],
  ['blank', 'REJECTION_CODE_INVALID', 'keyframe', -1],
  ['', 'REJECTION_CODE_INVALID', 'keyframe.id', 160],
  ['', 'REJECTION_CODE_INVALID', 'keyframe', -1],
  ['hurried', 'REJECTION_CODE_INVALID', 'keyframe.tim', 15],
  ['twice', 'REJECTION_CODE_INVALID', 'keyframe.time', -1],
  ['next', 'REJECTION_CODE_INVALID', 'keyframe.pose', 45],
  ['after', 'REJECTION_CODE_INVALID', 'keyframe.pose', 60],
  ['half \ufffd', 'REJECTION_CODE_INVALID', 'keyframe.id', 160],
  ['next', 'REJECTION_CODE_FROZEN', '', 50],
  ['nobody', 'REJECTION_CODE_INVALID', 'remove_keyframe.id', -1],
  ['', 'REJECTION_CODE_INVALID', 'keyframe', -1],
  ['', 'REJECTION_CODE_INVALID', 'remove_keyframe', -1],
  ['', 'REJECTION_CODE_INVALID', 'remove_keyframe.id', -1],
  ['', 'REJECTION_CODE_INVALID', 'remove_keyframe', -1],
  ['early', 'REJECTION_CODE_INVALID', 'remove_keyframe.idd', -1],
];

/** A dance to live music whose keys change on the way, one of them too late. Its last second waits for `goOn`. */
async function* edited(skeleton, { goOn, frame_rate } = {}) {
  yield { config: { seed: '5', audio_format: pcm, frames: 180, frame_rate, generate_until: 0, reject_invalid_keys: true } };
  const key = (id, when, turn) => ({ keyframe: { id, ...when, pose: pose(skeleton, { head: [0, turn, 0] }) } });
  yield key('early', { frame: 30 }, 0.2);
  yield key('next', { interval_after_previous: 20 }, 0.4);
  for await (const piece of live(clicks(6), 1000)) {
    const second = piece.audio.first_sample / pcm.sample_rate;
    if (second === 2) yield key('moved', { time: 3.5 }, 0.1);
    if (second === 3) yield key('moved', { time: 4 }, 0.3);
    if (second === 3) yield key('late', { frame: 20 }, 0.3);
    if (second === 3) yield* [{ frame: 20 }, { frame: 150 }].map((when) => ({ keyframe: { id: 'bodiless', ...when, pose: { rotations: [0.1] } } }));
    if (second === 3) yield key('timeless', { time: -1 }, 0.3);
    if (second === 3) yield* badKeys;
    if (second === 5) await goOn;
    yield { generate_until: { frame: Math.round(30 * second) } };
    yield piece;
  }
  yield { end_of_audio: {} };
  yield { keyframes_complete: {} };
}

/** A dance without keys, which has no continuation for seconds. */
async function* unkeyed(skeleton, { goOn, ...config } = {}) {
  yield { config: { audio_format: pcm, frames: 90, seed: '9', generate_until: 0, ...config } };
  for await (const piece of live(clicks(3), 1000)) {
    const second = piece.audio.first_sample / pcm.sample_rate;
    if (second === 2) await goOn;
    yield piece;
    yield { generate_until: { frame: Math.round(30 * second) } };
  }
}

for (const frame_rate of [30, 50]) {
  test(`a dance goes on where its server is killed, bit for bit: ${frame_rate} frames a second`, async () => {
    const source = (skeleton, more) => edited(skeleton, { frame_rate, ...more });
    const whole = await undisturbed(source);
    const refused = whole.flatMap(({ event }) => (event?.keyframe_rejected ? [[event.keyframe_rejected, Number(event.frame)]] : []));
    assert.deepEqual(
      refused.map(([{ id, code, field }, frame]) => [id, code, field, frame]),
      [
        ['late', 'REJECTION_CODE_TOO_LATE', '', 20],
        ['bodiless', 'REJECTION_CODE_INVALID', 'keyframe.pose.rotations', 20],
        ['bodiless', 'REJECTION_CODE_INVALID', 'keyframe.pose.rotations', 150],
        ['timeless', 'REJECTION_CODE_INVALID', 'keyframe.time', -1],
        ...refusedHere,
      ],
    );
    const reasons = refused.slice(-refusedHere.length).map(([{ reason }]) => reason);
    assert.deepEqual(reasons.slice(0, 2), ["'soon' is not a finite number", 'NaN is not a finite number']);
    assert.match(reasons[2], /^none of frame, time/);
    assert.match(reasons[4], /^'wave' is not a Keyframe, /);
    assert.match(reasons.at(-5), /^null is not a Keyframe, /);
    const enough = (all) => all.filter((answer) => answer.continuation).length > 1 && all.at(-1).frames?.first_frame > 3.5 * frame_rate;
    const { answers, resumes } = await danceAndKill(source, enough);
    assert.equal(resumes.length, 1);
    const [{ address, exact, frame, because }] = resumes;
    assert.deepEqual([address, exact], [other, true]);
    // A stream that is cut in mid-frame has broken, too.
    assert.ok(['UNAVAILABLE', 'INTERNAL', 'UNKNOWN'].includes(because.code), because.code);
    assert.ok(frame > 3.5 * frame_rate, frame);
    assert.deepEqual(told(answers), told(whole));
  });
}

test('the first frame of a dance is 0, and not -0', () => assert.equal(firstOutputFrame({ first_frame: '0', frame_rate: 30, model_frame_rate: 30 }), 0));

test('a dance whose server is killed before its first continuation goes on, too', async () => {
  const { answers, resumes } = await danceAndKill(unkeyed, (all) => all.at(-1).frames);
  assert.equal(resumes.length, 1);
  assert.deepEqual(told(answers), told(await undisturbed(unkeyed)));
});

test('the log of a server that goes on with a dance names the call in which it began', () =>
  withServer([], async ({ address, log }) => {
    const { resumes } = await danceAndKill(unkeyed, (all) => all.at(-1).frames, address);
    assert.equal(resumes.length, 1);
    while (!log().includes(' from ')) await sleep(5);
    const [, id] = /resumes stream ([0-9a-f]{16}) at frame 0/.exec(log());
    assert.match(log(), new RegExp(` stream [0-9a-f]{16} from ${id}: OK`));
  }));

test('before its first continuation a dance begins anew on another fingerprint where that is allowed', () =>
  withServer(
    [],
    async ({ address }) => {
      const lose = (allow_inexact_resume, options) =>
        danceAndKill((skeleton, more) => unkeyed(skeleton, { allow_inexact_resume, ...more }), (all) => all.at(-1).frames, address, options);
      const { answers, resumes } = await lose(true);
      assert.equal(told(answers).frames, '90');
      assert.deepEqual(resumes.map(({ exact }) => exact), [false]);
      await assert.rejects(lose(false, { retry: 0.5 }), ({ code, message, violations: [{ field, description }] }) => {
        assert.equal(code, 'FAILED_PRECONDITION');
        assert.equal(field, 'config.continuation.fingerprint');
        assert.match(description, /^begun by ".*"; \S+ has "another", which config\.allow_inexact_resume would let go on$/);
        assert.equal(message, `${field}: ${description}`);
        return true;
      });
    },
    { FAKE_FINGERPRINT: 'another' },
  ));

test('calls wait for a server, and give up in time', async () => {
  const refused = withClient('127.0.0.1:1', { retry: 0.3 }, (client) => client.info());
  await assert.rejects(refused, { code: 'UNAVAILABLE', message: /^127\.0\.0\.1:1: .*connection refused/ });
  const signal = AbortSignal.timeout(50);
  await assert.rejects(withClient('127.0.0.1:1', {}, (client) => client.info({ signal })), { code: 'CANCELLED' });
  await withClient(['127.0.0.1:1', other], {}, async (client) => {
    const transition = await collect(client.generateTransition({ config: { seed: '3' }, frames: 20, candidates: 2 }));
    assert.equal(transition.reduce((sum, { frames }) => sum + (frames?.count ?? 0), 0), 40);
  });
});

test('a full server that asks to wait longer than a call tries is asked once', () =>
  withServer(['--max-streams', '1'], async ({ address, log }) => {
    let stop;
    const over = new Promise((resolve) => (stop = resolve));
    async function* silence() {
      yield { config: { audio_format: pcm } };
      await over;
    }
    await withClient(address, {}, async (holder) => {
      await holder.streamDance(silence()).next();
      const refused = withClient(address, { retry: 0.5 }, (client) => collect(client.streamDance([{ config: { frames: 30 } }])));
      await assert.rejects(refused, ({ code, retryAfter }) => code === 'RESOURCE_EXHAUSTED' && retryAfter > 0.5);
      await info(address);
      while (!log().includes('GetServerInfo')) await sleep(20);
      assert.equal(log().match(/StreamDance .*RESOURCE_EXHAUSTED/g)?.length, 1);
      stop();
    });
  }));

test('who reads too slowly is told the limit', () =>
  withServer(['--unread-seconds', '0.5', '--outbox-kib', '16'], ({ address, log }) =>
    withClient(address, {}, async (client) => {
      const dance = client.streamDance([{ config: { frames: 60000 } }]);
      await dance.next();
      while (!log().includes('DEADLINE_EXCEEDED')) await sleep(20);
      const rest = async () => {
        for await (const answer of dance) assert.ok(answer);
      };
      await assert.rejects(rest, { code: 'DEADLINE_EXCEEDED', message: /limits\.unread_s \(--unread-seconds\): read faster, or resume/ });
    }),
  ));

test('calls take turns at the addresses of a list', () =>
  withServer([], (one) =>
    withServer([], (two) =>
      withClient(`ipv4:${one.address},${two.address}`, {}, async (client) => {
        const stop = new AbortController();
        async function* silence() {
          yield { config: { audio_format: pcm } };
          await new Promise((resolve) => stop.signal.addEventListener('abort', resolve));
        }
        const busy = async () => [(await info(one.address)).active_streams, (await info(two.address)).active_streams];
        const dances = [];
        // Connections are made one after the other: turns are taken once both are there.
        while ((await busy()).includes(0)) {
          assert.ok(dances.length < 40, 'all calls went to one server');
          dances.push(collect(client.streamDance(silence(), { signal: stop.signal })));
          await sleep(50);
        }
        stop.abort();
        for (const { reason } of await Promise.allSettled(dances)) assert.equal(reason.code, 'CANCELLED');
      }),
    ),
  ));

test('a server that drains says so, and is left at once', () =>
  withServer(['--drain-seconds', '60'], (one) =>
    withServer([], (two) =>
      withClient(one.address, { retry: 0 }, async (holder) => {
        async function* silence() {
          yield { config: { audio_format: pcm } };
          await new Promise(() => {});
        }
        const held = holder.streamDance(silence());
        await held.next();
        assert.equal((await info(one.address)).draining, false);
        one.drain();
        while (!(await info(one.address)).draining) await sleep(20);
        const refused = withClient(one.address, { retry: 0 }, (client) => collect(client.streamDance([{ config: { frames: 30 } }])));
        await assert.rejects(refused, { code: 'UNAVAILABLE', reason: 'DRAINING' });
        const error = await refused.catch((failure) => failure);
        const patience = new Patience({ retry: 60, firstBackoff: 2 }, undefined, 2);
        assert.equal(patience.next(error, true, one.address), 0);
        assert.ok(patience.next(error, true, two.address) > 0, 'both drain');
        const alone = new Patience({ retry: 60, firstBackoff: 2 }, undefined, 1);
        alone.next(error, false, one.address);
        alone.next(noAnswer('connect ECONNREFUSED 127.0.0.1:1'), false, one.address);
        assert.equal(alone.verdict, error, 'why it is gone');
        await withClient([one.address, two.address], {}, async (client) => {
          const answers = await collect(client.streamDance([{ config: { frames: 30 } }]));
          assert.ok(answers.at(-1).summary);
        });
        one.kill();
        await held.next().catch(() => {});
      }),
    ),
  ));

test('a journal forgets the music that is past, and nothing else', async () => {
  const music = (first_sample) => ({ audio: { data: Buffer.alloc(40), first_sample } });
  const said = [{ config: { audio_format: { ...pcm, first_sample: 0 } } }, music(0), { keyframe: { id: 'a', frame: 9 } }, music(20), music(40)];
  const journal = new Journal(said);
  for (let at = 0; await journal.at(at); ++at);
  journal.forgetMusicBefore(39, 5);
  assert.deepEqual(await Promise.all([0, 1, 2, 3].map((at) => journal.at(at))), [said[0], null, said[2], said[3]]);
  assert.equal(journal.firstSample(), 20);
  journal.forgetMusicBefore(100, 4); // the server has not been sent the last piece
  assert.equal(journal.firstSample(), 40);
});
