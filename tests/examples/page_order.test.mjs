// client/node/serve: what a back end may order, and what its page hears of it. $CHOREO_SERVER names a choreod.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { setTimeout as sleep } from 'node:timers/promises';
import { allow } from '../../client/node/serve/cors.js';
import { serveDance } from '../../client/node/serve/index.js';
import { withBackEnd } from './back_end.mjs';

/** A dance's events, to its end: [event, data]. */
async function eventsOf(url) {
  const text = await (await fetch(url)).text();
  return [...text.matchAll(/^event: (\w+)\ndata: (.*)$/gm)].map(([, event, data]) => [event, JSON.parse(data)]);
}

test('the end tells how many frames came, at the rate of the page', () =>
  withBackEnd(
    () => ({ seconds: 2, speed: 4, config: { seed: '7', frame_rate: 60 } }),
    async ({ url }) => {
      const events = await eventsOf(url);
      const frames = events.reduce((sum, [event, data]) => sum + (event === 'frames' ? data.places.length / 3 : 0), 0);
      assert.ok(frames > 110, `${frames} frames`);
      assert.deepEqual(events.at(-1), ['over', { frames }]);
    },
  ));

test('what serveDance() is given is checked before a page asks', () => {
  const client = { info() {}, streamDance() {} };
  const begin = () => ({ seconds: 2 });
  for (const [given, message] of [
    [[undefined, begin], 'client: undefined is not a ChoreoClient'],
    [[{}, begin], 'client: {} is not a ChoreoClient'],
    [[client], 'begin: undefined is not a function that says what to dance'],
    [[client, begin, { awy: 5 }], 'awy: no option; did you mean away?'],
    ...['dance', '/dance/', '/', '', '//dance', '/dance?', 5].map((path) => [[client, begin, { path }], /^path: .* is not a path such as '\/dance', without/]),
    [[client, begin, { away: 'x' }], /^away: 'x' is not a number from 0 to 2147483\.647$/],
    [[client, begin, { away: Infinity }], /^away: Infinity is not a number/],
    [[client, begin, { keep: -1 }], 'keep: -1 is not a number from 0 to Infinity'],
    [[client, begin, { behind: NaN }], 'behind: NaN is not a number from 0 to Infinity'],
    [[client, begin, { origins: 'https://my.page' }], "origins: 'https://my.page' is not a list of origins, such as ['https://my.page']"],
    [[client, begin, { origins: ['https://my.page/'] }], /^origins: 'https:\/\/my\.page\/' is not an origin such as/],
    [[client, begin, { origins: ['capacitor://localhost/'] }], /is not an origin such as/],
    [[client, begin, { onFailed: 'x' }], "onFailed: 'x' is not a function"],
    [[client, begin, { onResume: 5 }], 'onResume: 5 is not a function'],
  ]) {
    assert.throws(() => serveDance(...given), { name: 'ChoreoError', code: 'INVALID_ARGUMENT', message });
  }
  const unset = { path: undefined, origins: ['https://my.page:8443', 'capacitor://localhost'], away: undefined, keep: Infinity, behind: 0, onFailed: null };
  assert.equal(typeof serveDance(client, begin, unset), 'function');
});

test("a page hears the code and the field of what is wrong in its dance, and no more than INTERNAL of what is the back end's", async () => {
  const wrong = {
    model: [{ seconds: 2, config: { model: 'x' } }, 'NOT_FOUND', 'config.model: no model "x"; this server has "fake"'],
    style: [{ seconds: 2, config: { style: 'waltz' } }, 'INVALID_ARGUMENT', 'config.style: "waltz" is not a style of the model fake; it has calm, wild'],
    continuation: [{ seconds: 2, config: { continuation: {} } }, 'FAILED_PRECONDITION', 'config.continuation.skeleton: "" is not the model\'s, "smpl24"'],
    short: [{ seconds: 0.001 }, 'INVALID_ARGUMENT', 'seconds: 0.001 s leaves no frame to dance: the dance begins at 0 s'],
    past: [{ seconds: 1, config: { history: { poses: [{}], first_frame: '60' } } }, 'INVALID_ARGUMENT', 'seconds: 1 s leaves no frame to dance: the dance begins at 2 s'],
    music: [{ seconds: 2, music: (function* () { throw new Error('no line in'); })() }, 'INTERNAL', 'this went wrong here'],
  };
  const failures = [];
  await withBackEnd(
    ({ searchParams }) => wrong[searchParams.get('wrong')][0],
    async ({ url }) => {
      for (const [name, [, code, message]] of Object.entries(wrong)) {
        const events = await eventsOf(`${url}?wrong=${name}`);
        assert.deepEqual(events.at(-1), ['failed', { code, message }]);
      }
    },
    { onFailed: (error) => failures.push(error.message) },
  );
  const heard = Object.values(wrong).map(([, code, message]) => (code === 'INTERNAL' ? 'no line in' : message.replace(/^config/, 'requests[0].$&')));
  assert.deepEqual(failures, heard);
});

test('after the last event there is no more, and the dance is forgotten', () =>
  withBackEnd(
    () => ({ seconds: 1, speed: 4, config: { seed: '7' } }),
    async ({ url }) => {
      const last = [...(await (await fetch(url)).text()).matchAll(/^id: (.*)$/gm)].at(-1)[1];
      const again = (id) => fetch(url, { headers: { 'Last-Event-ID': id } });
      const [id, number] = last.split('/');
      const rest = await again(`${id}/${number - 1}`);
      assert.match(await rest.text(), /event: over/);
      const wrong = await again(id);
      assert.deepEqual([wrong.status, await wrong.text()], [400, `Last-Event-ID: "${id}" is not an event\n`]);
      for (let asked = 0; asked < 18; ++asked, await sleep(200)) assert.equal((await again(last)).status, 204);
      assert.equal((await again(`${id}/0`)).status, 204, 'nobody has kept it');
    },
    { away: 3 },
  ));

test('pages of the origins that are named may ask, and no others', async () => {
  const asked = { method: 'OPTIONS', headers: { Origin: 'https://my.page', 'Access-Control-Request-Method': 'POST', 'Access-Control-Request-Headers': 'authorization' } };
  const of = (answer) => ['origin', 'methods', 'headers'].map((name) => answer.headers.get(`access-control-allow-${name}`));
  for (const [origins, expected] of [
    [['https://my.page', 'https://other.page'], ['https://my.page', 'GET, POST, DELETE', 'authorization']],
    [['*'], ['*', 'GET, POST, DELETE', 'authorization']],
    [['https://other.page'], [null, null, null]],
  ]) {
    await withBackEnd(
      () => ({ seconds: 1, speed: 4 }),
      async ({ url }) => {
        const first = await fetch(`${url}/nobody/keys`, asked);
        assert.deepEqual([first.status, ...of(first)], [204, ...expected]);
        const { status, headers } = await fetch(`${url}/nobody/keys`, { method: 'POST', headers: asked.headers, body: '{}' });
        assert.deepEqual([status, headers.get('access-control-allow-origin')], [404, expected[0]]);
        assert.equal(headers.get('access-control-expose-headers'), expected[0] && 'Choreo-Code, Retry-After');
      },
      { origins },
    );
  }
  await withBackEnd(() => ({ seconds: 1 }), async ({ url }) => assert.equal((await fetch(url, asked)).status, 405));
  for (const [before, vary] of [[undefined, 'Origin'], ['Cookie', 'Cookie, Origin'], [['Cookie', 'Accept'], 'Cookie, Accept, Origin']]) {
    const headers = new Map([['Vary', before]]);
    allow(['https://my.page'], { method: 'GET', headers: {} }, { getHeader: (name) => headers.get(name), setHeader: (name, value) => headers.set(name, value) });
    assert.equal(headers.get('Vary'), vary);
  }
});
