// examples/node/web.js: a back end whose page watches a dance and changes it. $CHOREO_SERVER names a choreod, $CHOREOD the program of it.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { once } from 'node:events';
import { mkdtemp, rm, writeFile } from 'node:fs/promises';
import { connect } from 'node:net';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { createInterface } from 'node:readline';
import { test } from 'node:test';
import { setTimeout as sleep } from 'node:timers/promises';
import { fileURLToPath } from 'node:url';
import { ChoreoClient } from '../../client/node/src/index.js';
import { withServer } from './servers.mjs';

const other = process.env.CHOREO_SERVER;
const program = fileURLToPath(new URL('../../examples/node/web.js', import.meta.url));

/** The back end, with dances of six seconds, until `use(address)` is done. */
async function withBackend(servers, use) {
  const flags = [...servers.flatMap((server) => ['--server', server]), '--port', '0', '--seconds', '6', '--speed', '2'];
  const backend = spawn(process.execPath, [program, ...flags], { stdio: ['ignore', 'pipe', 'inherit'] });
  const over = once(backend, 'exit');
  try {
    const [address] = await once(createInterface({ input: backend.stdout }), 'line');
    await use(address);
  } finally {
    backend.kill('SIGINT');
  }
  assert.deepEqual(await over, [0, null], 'Ctrl-C ends it');
}

/** What a page hears: [event, data, id]. */
async function* eventsOf(response) {
  let text = '';
  for await (const piece of response.body.pipeThrough(new TextDecoderStream())) {
    text += piece;
    for (let end; (end = text.indexOf('\n\n')) >= 0; text = text.slice(end + 2)) {
      const [, id, event, data] = /^id: (\S+)\nevent: (\w+)\ndata: (.*)$/.exec(text.slice(0, end)) ?? [];
      if (event) yield [event, JSON.parse(data), id];
    }
  }
}

/** Watches a dance to its end. `each(seconds that have come, its id)` acts on the way. */
async function watch(address, each = () => {}) {
  const response = await fetch(`${address}/dance?seed=7`);
  assert.equal(response.headers.get('content-type'), 'text/event-stream');
  let id;
  let frames = 0;
  const heard = [];
  for await (const [event, data] of eventsOf(response)) {
    if (event === 'dance') id = data.id;
    if (event !== 'frames') heard.push([event, data]);
    else {
      assert.equal(data.first, frames, 'no frame is missing, none comes twice');
      assert.equal(data.turns.length / data.places.length, (4 * 24) / 3);
      frames += data.places.length / 3;
      await each(frames / 30, id);
    }
  }
  return { frames, heard: heard.slice(1) };
}

const key = (id, time, rotations = { left_shoulder: [0, 0, 1], head: [0, 0.4, 0] }) => ({ id, time, rotations });

async function ask(address, id, body) {
  const answer = await fetch(`${address}/dance/${id}/keys`, { method: 'POST', body: typeof body === 'string' ? body : JSON.stringify(body) });
  const text = await answer.text();
  return [answer.status, answer.ok ? JSON.parse(text).id : text];
}

test('a page adds and moves keys while it watches, and a replica that is killed costs no frame', () =>
  withServer([], (one) =>
    withBackend([one.address, other], async (address) => {
      const asked = [];
      let killed = false;
      const { frames, heard } = await watch(address, async (second, id) => {
        if (asked.length === 0 && second > 1) asked.push(await ask(address, id, key('wave', 4)));
        if (asked.length === 1 && second > 1.3) asked.push(await ask(address, id, key('wave', 4.5)));
        if (!killed && second > 2) killed = (one.kill(), true);
        if (asked.length === 2 && second > 2.5) asked.push(await ask(address, id, key('bow', 5.5, { spine1: [0.5, 0, 0] })));
      });
      assert.deepEqual(asked, [[202, 'wave'], [202, 'wave'], [202, 'bow']]);
      assert.equal(frames, 180);
      assert.deepEqual(heard[0], ['moved', { frame: heard[0][1].frame }]);
      assert.ok(heard[0][1].frame > 60, heard[0][1].frame);
      assert.deepEqual(heard.slice(1), [['key', { id: 'wave', time: 4.5 }], ['key', { id: 'bow', time: 5.5 }], ['over', { frames: 180 }]]);
    }),
  ));

test('a key that cannot be danced is refused, and the dance goes on', () =>
  withBackend([other], async (address) => {
    const refused = [];
    const { frames, heard } = await watch(address, async (second, id) => {
      if (second < 1 || refused.length > 0) return;
      for (const body of [
        key('wave', 5),
        key('now', 0.5),
        key('near', 5.03),
      ]) {
        assert.deepEqual(await ask(address, id, body), [202, body.id]);
      }
      const long = key('long', 4, { head: 'x'.repeat(70000) });
      const wrong = [key('', 3), key(7, 3), key('text', 'soon'), key('none', 4, {}), key('turn', 4, { head: [0, 0, 7] })];
      for (const body of ['no JSON', key('end', 6), key('tail', 4, { tail: [0, 0, 1] }), key('text', 4, { head: 'up' }), long, ...wrong]) {
        refused.push(await ask(address, id, body));
      }
    });
    const said = refused.map(([status, text]) => `${status} ${text.trimEnd()}`);
    assert.match(said.shift(), /^400 .*JSON/);
    assert.equal(said.shift(), '400 time: 6 s is not before the end of the dance, 6 s');
    assert.match(said.shift(), /^400 rotations\.tail: no joint of smpl24; there are pelvis, /);
    const ofKeys = [
      '400 id: has 0 bytes, not 1 to 256',
      '400 id: 7 is not a text',
      "400 time: 'soon' is not a number",
      '400 rotations: names no joint',
      '400 rotations.head: 7 rad exceeds 2π; angles are in radians',
    ];
    assert.deepEqual(said, ["400 rotations.head: 'up' is not [x, y, z], three finite numbers", '413 more than 65536 characters', ...ofKeys]);
    const events = heard.map(([, { id, refused }]) => [id, refused]);
    assert.match(events.splice(0, 1)[0].join(), /^now,too late: all before [\d.]+ s is settled$/);
    assert.deepEqual(events.slice(0, -2), [['near', 'time: frame 151 is closer than 2 frames to key "wave" at 150']]);
    assert.deepEqual(heard.slice(-2), [['key', { id: 'wave', time: 5 }], ['over', { frames: 180 }]]);
    assert.equal(frames, 180);
    assert.deepEqual(await ask(address, 'nobody', key('late', 4)), [404, 'nobody dances nobody\n']);
    const song = Buffer.from(await (await fetch(`${address}/song.wav`)).arrayBuffer());
    assert.deepEqual([song.toString('latin1', 0, 4), song.length], ['RIFF', 44 + 2 * 22050 * 6]);
    assert.ok(song.subarray(44).some((byte) => byte > 0));
    const skeleton = await (await fetch(`${address}/dance/skeleton`)).json();
    assert.deepEqual([skeleton.name, skeleton.joint_names.length], ['smpl24', 24]);
    for (const [path, status] of [['/', 200], ['/favicon.ico', 404], ['/dance?seed=x', 400]]) {
      const answer = await fetch(address + path);
      assert.equal(answer.status, status, await answer.text());
    }
  }));

test('a page hears warnings, each with its key', () =>
  withBackend([other], async (address) => {
    let asked;
    const { heard } = await watch(address, async (second, id) => {
      if (second > 1) asked ??= await ask(address, id, key('backwards', 4, { left_knee: [-2, 0, 0] }));
    });
    assert.deepEqual(asked, [202, 'backwards']);
    const [[event, { id, message }], reached] = heard;
    assert.deepEqual([event, id, reached], ['warning', 'backwards', ['key', { id: 'backwards', time: 4 }]]);
    assert.match(message, /left_knee/);
  }));

test('a page whose connection is lost hears the rest, and no second dance', () =>
  withBackend([other], async (address) => {
    let [frames, last, heard] = [0, undefined, []];
    // As a browser does, after each second of the dance.
    for (let connection = 0; heard.at(-1) !== 'over'; ++connection) {
      assert.ok(connection < 9, heard);
      const cut = new AbortController();
      const headers = last ? { 'Last-Event-ID': last } : {};
      const response = await fetch(`${address}/dance?seed=7`, { headers, signal: cut.signal });
      assert.equal(response.status, 200);
      const until = frames + 30;
      try {
        for await (const [event, data, id] of eventsOf(response)) {
          if (frames >= until) cut.abort(); // what comes now is lost
          cut.signal.throwIfAborted();
          last = id;
          if (event !== 'frames') heard.push(event);
          else {
            assert.equal(data.first, frames);
            frames += data.places.length / 3;
          }
        }
      } catch (error) {
        if (!cut.signal.aborted) throw error;
      }
    }
    assert.deepEqual([frames, heard], [180, ['dance', 'over']]);
    const gone = await fetch(`${address}/dance?seed=7`, { headers: { 'Last-Event-ID': 'nobody/3' } });
    assert.equal(gone.status, 204);
  }));

/** What a raw request is answered with: a status. */
function statusOf(address, text) {
  const { hostname, port } = new URL(address);
  return new Promise((resolve, reject) => {
    const socket = connect(port, hostname, () => socket.write(`${text}\r\nHost: x\r\nConnection: close\r\n\r\n`));
    socket.on('data', (data) => resolve(Number(/^HTTP\/1.1 (\d+)/.exec(data)[1])) ?? socket.destroy());
    socket.on('error', reject);
  });
}

test('what no browser would ask is refused, and the dance goes on', () =>
  withBackend([other], async (address) => {
    const { frames } = await watch(address, async (second, id) => {
      if (second > 0.5) return;
      for (const last of ['x', '-5', '1.5', '1e9', '99999', '']) {
        assert.equal((await fetch(`${address}/dance`, { headers: { 'Last-Event-ID': `${id}/${last}` } })).status, 400, last);
      }
    });
    assert.equal(frames, 180);
    assert.equal(await statusOf(address, 'GET // HTTP/1.1'), 404);
    assert.equal(await statusOf(address, 'GET /dance/%zz/keys HTTP/1.1'), 400);
    for (const seed of [2n ** 64n, -1, '1e3', '']) assert.equal((await fetch(`${address}/dance?seed=${seed}`)).status, 400, `${seed}`);
    const largest = new AbortController();
    assert.equal((await fetch(`${address}/dance?seed=${2n ** 64n - 1n}`, { signal: largest.signal })).status, 200);
    largest.abort();
  }));

test('a page that is closed ends its dance on the server', () =>
  withServer([], ({ address: server }) =>
    withBackend([server], async (address) => {
      const client = new ChoreoClient(server);
      try {
        for await (const [event] of eventsOf(await fetch(`${address}/dance`))) if (event === 'frames') break;
        while ((await client.info()).active_streams > 0) await sleep(5);
      } finally {
        client.close();
      }
    }),
  ));

test('a page is told that nobody dances', async () => {
  const folder = await mkdtemp(join(tmpdir(), 'choreo-'));
  try {
    await writeFile(join(folder, 'tokens'), `${'0'.repeat(64)} nobody\n`);
    await withServer(['--tokens', join(folder, 'tokens')], ({ address: server }) =>
      withBackend([server], async (address) => {
        const heard = [];
        for await (const told of eventsOf(await fetch(`${address}/dance`))) heard.push(told);
        const [[event, { code, message }]] = heard;
        assert.deepEqual([heard.length, event, code, message], [1, 'failed', 'INTERNAL', 'this went wrong here'], 'no word of tokens');
      }),
    );
  } finally {
    await rm(folder, { recursive: true });
  }
});
