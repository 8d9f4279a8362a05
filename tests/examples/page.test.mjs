// client/node/serve and client/node/page: a back end and a page out of the package alone. $CHOREO_SERVER names a choreod, $CHOREOD the program of it.
import assert from 'node:assert/strict';
import { EventEmitter, once } from 'node:events';
import { spawn } from 'node:child_process';
import { mkdir, mkdtemp, readFile, rm, symlink, writeFile } from 'node:fs/promises';
import { connect } from 'node:net';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';
import { setTimeout as sleep } from 'node:timers/promises';
import { fileURLToPath } from 'node:url';
import { clicks, pcm, song, wav } from '../../examples/node/music.js';
import { connectDance } from '../../client/node/page/index.js';
import { serveDance } from '../../client/node/serve/index.js';
import { ChoreoClient, libraryPose } from '../../client/node/src/index.js';
import { withBackEnd } from './back_end.mjs';
import { withServer } from './servers.mjs';

const server = process.env.CHOREO_SERVER;
const silent = { seconds: 6, speed: 3, config: { seed: '7' } };

/** A page's dance to its end: what it heard, and the place of each frame, in order. `each(dance, seconds that came)` acts on the way. */
async function watch(url, each = () => {}) {
  const heard = [];
  const over = new EventEmitter();
  const end = once(over, 'end');
  const tell = (name) => (news) => heard.push([name, news]);
  const onEnd = (error) => (heard.push(['end', error?.message]), over.emit('end'));
  const dance = connectDance(url, { onKey: tell('key'), onWarning: tell('warning'), onMoved: tell('moved'), onLost: tell('lost'), onEnd });
  const { frame_rate: rate } = await dance.begun;
  dance.wear();
  const places = [];
  const look = async () => {
    for (let shown; (shown = dance.at(places.length / rate)).state === 'playing'; ) places.push(shown.pose.places);
    await each(dance, places.length / rate);
  };
  while (!dance.over) await Promise.race([look().then(() => sleep(20)), end]);
  await look();
  return { heard, places };
}

test('a page shows a dance, asks for keys, moves one and takes one back, and a killed replica costs no frame', () =>
  withServer([], (one) =>
    withBackEnd(
      () => ({ ...silent, seconds: 8, speed: 1 }), // in time for its keys on a busy machine, too
      async ({ url }) => {
        const asked = [];
        const { heard, places } = await watch(url, async (dance, seconds) => {
          if (seconds > 1 && asked.length === 0) {
            asked.push(await dance.setKey({ id: 'kick', time: 5, pose: 'kick' }));
            asked.push(await dance.setKey({ id: 'kick', time: 5.5, pose: 'kick' }));
            asked.push(await dance.setKey({ id: 'no', time: 6.5, rotations: { head: [0, 0.4, 0] } }));
            asked.push(await dance.setKey({ rotations: { head: [0, -0.4, 0] } }));
            await dance.removeKey('no');
            one.kill();
          }
        });
        assert.equal(places.length, 240);
        const soon = asked[3];
        assert.ok(soon.id === 'key 4' && soon.time >= 2 && soon.time < 5, JSON.stringify(soon));
        const [[, moved]] = heard.filter(([event]) => event === 'moved');
        assert.deepEqual(Object.keys(moved), ['frame']);
        const others = heard.filter(([event]) => event !== 'moved');
        assert.deepEqual(
          others.map(([event, news]) => [event, news?.id, news?.refused]),
          [['key', 'key 4', undefined], ['key', 'kick', undefined], ['end', undefined, undefined]],
        );
        assert.equal(others[1][1].time, 5.5);
      },
      { servers: [one.address, server] },
    ),
  ));

test('a lost connection costs no frame', () =>
  withBackEnd(
    () => silent,
    async ({ url, http }) => {
      let cut = 0;
      const { heard, places } = await watch(url, (_, seconds) => {
        if (seconds > 2 * (cut + 1) && cut < 2) (++cut, http.closeAllConnections());
      });
      assert.deepEqual([places.length, heard.map(([event]) => event)], [180, ['lost', 'lost', 'end']]);
    },
  ));

test('music comes as a file, or while it sounds', () =>
  withBackEnd(
    ({ searchParams }) => {
      if (searchParams.has('file')) return { ...silent, music: wav(song(6)), keys: [] };
      const pieces = Array.from({ length: 60 }, (_, i) => ({ audio: { data: clicks(6).subarray(4410 * i, 4410 * (i + 1)) } }));
      return { ...silent, music: pieces, config: { seed: '7', audio_format: pcm } };
    },
    async ({ url }) => {
      const dances = [await watch(`${url}?file`), await watch(url)];
      assert.deepEqual(dances.map(({ places, heard }) => [places.length, heard]), Array(2).fill([180, [['end', undefined]]]));
      assert.notDeepEqual(dances[0].places, dances[1].places);
    },
  ));

test('music waits for the dancer', () =>
  withBackEnd(
    () => silent,
    async ({ url }) => {
      const audio = { currentTime: 0, paused: true, ended: false, play: () => (audio.paused = false), pause: () => (audio.paused = true) };
      const dance = connectDance(url);
      assert.deepEqual(dance.follow(audio), { state: 'waiting', ahead: 0 });
      assert.ok(audio.paused);
      assert.throws(() => dance.wear(), /has not begun/);
      await dance.begun;
      dance.wear();
      while (audio.paused) (await sleep(10), dance.follow(audio));
      audio.currentTime = 5.9;
      assert.deepEqual([dance.follow(audio).state, audio.paused], ['starved', true]);
      while (audio.paused) (await sleep(10), dance.follow(audio));
      audio.pause(); // by a listener
      while (!dance.over) await sleep(10);
      dance.follow(audio);
      assert.ok(audio.paused);
    },
  ));

/** What a handler writes to; nobody takes it until `flow()`. */
class Stuck extends EventEmitter {
  text = '';
  isStuck = true;
  writableNeedDrain = false;
  writeHead = (status) => ((this.status = status), this);
  write = (text) => ((this.text += text), !this.isStuck);
  end = () => this.emit('ended');
  flow = () => ((this.isStuck = false), this.emit('drain'));
  seconds = () => [...this.text.matchAll(/"places":\[([^\]]*)\]/g)].reduce((sum, [, list]) => sum + list.split(',').length / 90, 0);
}

test('a dance waits for a page that takes nothing', () =>
  withBackEnd(
    () => ({ ...silent, seconds: 20, speed: 20 }),
    async ({ dance, client }) => {
      const response = new Stuck();
      const answer = dance({ url: '/dance', method: 'GET', headers: {} }, response);
      while (response.seconds() === 0) (await sleep(10), response.emit('drain'));
      await sleep(2000); // twice as long as it lasts
      assert.equal((await client.info()).active_streams, 1, 'it is not over');
      response.flow();
      assert.equal(await answer, true);
      assert.ok(Math.abs(response.seconds() - 20) < 1e-6, response.seconds());
      assert.match(response.text, /event: over\n/);
    },
    { behind: 2 },
  ));

test('a page reads the answers to its keys, else its browser would show them as cancelled', () =>
  withBackEnd(
    () => silent,
    async ({ url }) => {
      const answers = [];
      const heard = async (...asked) => {
        const answer = await fetch(...asked);
        answers.push(answer);
        return answer;
      };
      const dance = connectDance(url, { fetch: heard });
      await dance.setKey({ id: 'dab', time: 4, pose: 'dab' });
      await dance.removeKey('dab');
      assert.deepEqual(answers.slice(-2).map(({ status, bodyUsed }) => [status, bodyUsed]), Array(2).fill([202, true]));
      dance.close();
    },
  ));

test('a page hears of jumps that stand, of the end at once, and of what is too late in seconds', () =>
  withBackEnd(
    () => ({ ...silent, speed: 1 }), // in time for its keys on a busy machine, too
    async ({ url }) => {
      let refused;
      const { heard } = await watch(url, async (dance, seconds) => {
        if (seconds < 1 || refused) return;
        refused = dance.setKey({ id: 'end', time: 6, pose: 'dab' }).then(assert.fail, ({ message }) => message);
        await dance.setKey({ id: 'jump', time: 5, pose: 'star_jump' });
        await dance.setKey({ id: 'placed', time: 5.5, pose: 'star_jump', place: [0, 0] });
        await dance.setKey({ id: 'there', time: 4, pose: 'star_jump', place: 'here' });
        await dance.setKey({ id: 'late', time: 0.5, pose: 'dab' });
      });
      assert.equal(await refused, 'time: 6 s is not before the end of the dance, 6 s');
      const [warning, ...more] = heard.filter(([event]) => event === 'warning');
      assert.equal(warning[1].id, 'jump');
      assert.match(warning[1].message, /^star_jump is in the air, but without a place it stands on the floor/);
      assert.ok(more.every(([, { message }]) => !message.includes('without a place')), JSON.stringify(more));
      assert.ok(heard.some(([event, news]) => event === 'key' && news.id === 'there' && news.time === 4), JSON.stringify(heard));
      const [, late] = heard.find(([event, { id }]) => event === 'key' && id === 'late');
      assert.match(late.refused, /^too late: all before \d(\.\d+)? s is settled$/);
    },
  ));

test('the back end hears of its wrong orders, and by default so does its console', async () => {
  const wrong = {
    musik: [{ ...silent, musik: [] }, 'musik: no field of an order; did you mean music?'],
    none: [undefined, 'order: undefined is not {seconds, music, config, keys, speed}'],
    endless: [{}, 'seconds: undefined is not a number above 0'],
    past: [{ seconds: -3 }, 'seconds: -3 is not a number above 0'],
    still: [{ ...silent, speed: 0 }, 'speed: 0 is not a number above 0'],
    path: [{ ...silent, music: 'song.mp3' }, "music: 'song.mp3' is text; give the file's bytes, as readFile() does"],
    number: [{ ...silent, music: 5 }, /^music: 5 is neither a file's bytes, .* nor requests/],
    object: [{ ...silent, music: {} }, /^music: {} is neither/],
    promise: [{ ...silent, music: Promise.resolve() }, /^music: Promise .* is neither/],
    long: [{ ...silent, seconds: 1e9 }, 'seconds: 1000000000 s is more than an hour, 3600 s'],
    keyed: [{ ...silent, keys: { keyframes: [] } }, 'keys: { keyframes: [] } is not a list of requests, as readKeys() gives it'],
    file: [{ ...silent, keys: [{ keyframe: {} }, { id: 'kick', time: 2 }] }, /^keys\[1\]\.id: no field of StreamDanceRequest; there are config, /],
    nothing: [{ ...silent, keys: [null] }, /^keys\[0\]: null is not a StreamDanceRequest/],
    granted: [{ ...silent, keys: [{ generate_until: { frame: 5 } }] }, "keys[0].generate_until: is not yours to say: the page's clock says it"],
    complete: [{ ...silent, keys: [{ keyframes_complete: {} }] }, 'keys[0].keyframes_complete: is not yours to say: it comes at the end'],
    again: [{ ...silent, keys: [{ config: {} }] }, "keys[0].config: is not yours to say: it is the order's config"],
    frames: [{ ...silent, config: { frames: 90 } }, 'config.frames: is not yours to set: say seconds'],
    turns: [{ ...silent, config: { encoding: 'ROTATION_ENCODING_MATRIX' } }, 'config.encoding: is not yours to set: pages get quaternions'],
    until: [{ ...silent, config: { generate_until: 90 } }, "config.generate_until: is not yours to set: the page's clock says it"],
    seed: [{ ...silent, config: { seed: 'abc' } }, "config.seed: 'abc' is not a whole number"],
  };
  const begin = ({ searchParams }) => {
    const name = searchParams.get('wrong');
    if (name === 'broken') throw new TypeError('ours');
    if (name === 'stranger') throw Object.assign(new Error('log in first'), { status: 401 });
    return wrong[name][0];
  };
  const heard = [];
  const ask = async ({ url }) => {
    for (const [name, [, words]] of Object.entries(wrong)) {
      const answer = await fetch(`${url}?wrong=${name}`);
      const said = (await answer.text()).trim();
      assert.deepEqual([answer.status, heard.pop()], [400, said]);
      if (words instanceof RegExp) assert.match(said, words);
      else assert.equal(said, words);
    }
    assert.equal((await fetch(`${url}?wrong=broken`)).status, 500);
    assert.equal((await fetch(`${url}?wrong=stranger`)).status, 401);
    assert.deepEqual(heard.splice(0), ['ours']);
  };
  await withBackEnd(begin, ask, { onFailed: (error) => heard.push(error.message) });
  const { error } = console;
  console.error = (_, failure) => heard.push(failure.message);
  try {
    await withBackEnd(begin, ask);
  } finally {
    console.error = error;
  }
});

test('what a page may not have is refused, with a status', () =>
  withBackEnd(
    ({ searchParams }) => {
      if (searchParams.has('stranger')) throw Object.assign(new Error('log in first'), { status: 401 });
      return { ...silent, config: { seed: searchParams.get('seed') ?? '7' } };
    },
    async ({ url }) => {
      const status = async (...asked) => {
        const answer = await fetch(...asked);
        return [answer.status, (await answer.text()).trim()];
      };
      assert.deepEqual(await status(`${url}?stranger`), [401, 'log in first']);
      assert.deepEqual(await status(`${url}?seed=x`), [400, "config.seed: 'x' is not a whole number"]);
      const refused = (promise) => promise.then(assert.fail, ({ status, code, message }) => [status, code, message.slice(0, 12)]);
      assert.deepEqual(await refused(connectDance(`${url}?stranger`).begun), [401, undefined, 'log in first']);
      assert.deepEqual(await refused(connectDance(`${url}?seed=x`).begun), [400, 'INVALID_ARGUMENT', 'config.seed:']);
      assert.deepEqual(await refused(new Promise((_, onEnd) => connectDance(`${url}?stranger`, { onEnd }))), [401, undefined, 'log in first']);
      assert.deepEqual(await status(`${url}/nobody/keys`, { method: 'POST', body: '{}' }), [404, 'nobody dances nobody']);
      assert.deepEqual(await status(url.replace('/dance', '/dances')), [404, '']);
      assert.deepEqual(await status(`${url}/nobody/keyes`, { method: 'POST' }), [404, 'nothing is at /dance/nobody/keyes']);
      assert.deepEqual(await status(`${url}/nobody`), [404, 'nothing is at /dance/nobody']);
      for (const [path, method, allowed] of [['/nobody/keys', 'PUT', 'POST'], ['/nobody/keys/a', 'GET', 'DELETE'], ['', 'DELETE', 'GET'], ['/skeleton', 'POST', 'GET']]) {
        const answer = await fetch(url + path, { method });
        assert.deepEqual([answer.status, answer.headers.get('Allow'), await answer.text()], [405, allowed, `/dance${path} takes ${allowed}, not ${method}\n`]);
      }
      assert.deepEqual(await status(`${url}/%zz/keys`), [400, 'URI malformed']);
      const joints = JSON.parse((await status(`${url}/skeleton`))[1]).joint_names;
      assert.equal(joints.length, 24);
      const page = connectDance(url);
      await page.begun;
      await assert.rejects(page.setKey({ pose: 'kik' }), /^DanceError: pose: 'kik' is not a pose of the library; .*kick/);
      assert.deepEqual(await refused(page.setKey({ pose: 'kik' })), [400, 'INVALID_ARGUMENT', "pose: 'kik' "]);
      await assert.rejects(page.setKey({ rotations: { tail: [0, 0, 1] } }), /^DanceError: rotations\.tail: no joint/);
      page.close();
      assert.throws(() => connectDance(url, { onKeys: () => {} }), /^TypeError: options\.onKeys: is none of headers, /);
    },
  ));

test("of a dance's events the latest are kept", () =>
  withBackEnd(
    () => silent,
    async ({ url }) => {
      const page = connectDance(url);
      const { id } = await page.begun;
      while (!page.over) await sleep(20);
      const again = (last) => fetch(url, { headers: { 'Last-Event-ID': `${id}/${last}` } });
      assert.equal((await again(0)).status, 204);
      assert.equal((await again(9999)).status, 400);
    },
    { keep: 50000 },
  ));

test('a page that closes ends its dance, and so does the back end', async () => {
  for (const close of [(page) => page.close(), (_, dance) => dance.close()]) {
    await withServer([], ({ address }) =>
      withBackEnd(
        () => ({ ...silent, speed: 0.1 }),
        async ({ url, dance, client }) => {
          const page = connectDance(url);
          await page.begun;
          assert.equal((await client.info()).active_streams, 1);
          close(page, dance);
          while ((await client.info()).active_streams > 0) await sleep(20);
        },
        { servers: [address], away: 0.1 },
      ),
    );
  }
});

test('what cannot be served is said at once', () => {
  const client = new ChoreoClient(server);
  assert.throws(() => serveDance(client), /^ChoreoError: begin: undefined is not a function/);
  assert.throws(() => serveDance(client, () => silent, { pathh: '/x' }), /^ChoreoError: pathh: no option; did you mean path/);
  client.close();
});

/** The status that a server answers a path with, of which a browser would make another one. */
function statusOf(port, path) {
  return new Promise((resolve, reject) => {
    const socket = connect(port, '127.0.0.1', () => socket.write(`GET ${path} HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n`));
    socket.once('data', (data) => (resolve(Number(/^HTTP\/1.1 (\d+)/.exec(data)[1])), socket.destroy()));
    socket.once('error', reject);
  });
}

test('the back end of docs/web.md answers 404 for what is not there, and shows nothing else', async () => {
  const root = fileURLToPath(new URL('../../', import.meta.url));
  const [, program] = /^```js\n([^]*?)^```/m.exec(await readFile(join(root, 'docs/web.md'), 'utf8'));
  const folder = await mkdtemp(join(tmpdir(), 'choreo-'));
  let backEnd;
  try {
    await mkdir(join(folder, 'node_modules/three/build'), { recursive: true });
    await writeFile(join(folder, 'node_modules/three/build/three.module.js'), '');
    await symlink(join(root, 'client/node'), join(folder, 'node_modules/choreo-client'));
    await writeFile(join(folder, 'package.json'), '{ "type": "module" }');
    await writeFile(join(folder, 'index.html'), '<p>');
    const telling = "listen(0, '127.0.0.1', function () { process.send(this.address().port); });";
    await writeFile(join(folder, 'serve.js'), program.replace("listen(8080, '127.0.0.1');", telling));
    backEnd = spawn(process.execPath, ['serve.js'], { cwd: folder, stdio: ['ignore', 'inherit', 'inherit', 'ipc'] });
    const [port] = await once(backEnd, 'message');
    const paths = ['/three/missing.js', '/hero.glb', '/three/../../serve.js', '/three/build/three.module.js', '/choreo-client/page/index.js', '/?a=b'];
    const statuses = [];
    for (const path of paths) statuses.push(await statusOf(port, path).catch((error) => error.message));
    assert.deepEqual(statuses, [404, 404, 404, 200, 200, 200]);
  } finally {
    backEnd?.kill();
    await rm(folder, { recursive: true });
  }
});
