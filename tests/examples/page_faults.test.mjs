// What goes wrong between a page and its back end, and what each hears of it. $CHOREO_SERVER names a choreod.
import assert from 'node:assert/strict';
import { once } from 'node:events';
import { mkdtemp, rm, writeFile } from 'node:fs/promises';
import { Agent, request as httpRequest } from 'node:http';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';
import { setTimeout as sleep } from 'node:timers/promises';
import { connectDance, DanceError } from '../../client/node/page/index.js';
import { withBackEnd } from './back_end.mjs';
import { withServer } from './servers.mjs';

const order = () => ({ seconds: 4, speed: 4, config: { seed: '7' } });
const [kick, nowhere] = [{ pose: 'kick' }, 'http://127.0.0.1:1/dance'];

/** The status and code of a DanceError. */
async function failure(promise) {
  const error = await promise.then(() => assert.fail('nothing went wrong'), (error) => error);
  assert.ok(error instanceof DanceError, `${error}`);
  return [error.status, error.code];
}

test("all that a page's calls throw are DanceErrors, with a status or a code", () =>
  withBackEnd(order, async ({ url, http, dance }) => {
    assert.deepEqual(await failure(connectDance(nowhere).begun), [undefined, 'UNAVAILABLE']);
    const ended = new Promise((onEnd) => connectDance(nowhere, { onEnd }));
    assert.equal((await ended).code, 'UNAVAILABLE');
    const page = connectDance(url);
    assert.throws(() => page.wear(), DanceError);
    assert.deepEqual(await failure(page.removeKey('half \ud83d')), [400, 'INVALID_ARGUMENT']);
    while (!page.over) await sleep(20);
    assert.deepEqual(await failure(page.setKey(kick)), [undefined, 'FAILED_PRECONDITION']);
    assert.deepEqual(await failure(page.removeKey('key 1')), [undefined, 'FAILED_PRECONDITION']);
    const closed = connectDance(url);
    await closed.begun;
    closed.close();
    assert.deepEqual(await failure(closed.setKey(kick)), [undefined, 'CANCELLED']);
    const cut = async (...asked) => (asked[1]?.method === 'POST' ? Promise.reject(new TypeError('fetch failed')) : fetch(...asked));
    assert.deepEqual(await failure(connectDance(url, { fetch: cut }).setKey(kick)), [undefined, 'UNAVAILABLE']);
    const gone = new Promise((onEnd) => connectDance(url, { onEnd, onLost: () => dance.close() }).begun.then(() => http.closeAllConnections()));
    assert.deepEqual(await failure(gone.then((error) => Promise.reject(error))), [undefined, 'NOT_FOUND']);
  }));

test('credentials are the business of the back end, which hears all, and not of the page', async () => {
  const folder = await mkdtemp(join(tmpdir(), 'choreo-'));
  const [tokens, tokenFile] = [join(folder, 'tokens'), join(folder, 'token')];
  try {
    await writeFile(tokens, `${'0'.repeat(64)} nobody\n`);
    await writeFile(tokenFile, 'wrong');
    await withServer(['--tokens', tokens], async ({ address }) => {
      const heard = [];
      for (const clientOptions of [{}, { token: 'wrong' }, { tokenFile }, { tokenFile: join(folder, 'none') }]) {
        const ask = async ({ url }) => {
          const error = await connectDance(url).begun.then(assert.fail, (error) => error);
          assert.deepEqual([error.message, error.code], ['this went wrong here', 'INTERNAL']);
          const skeleton = await fetch(`${url}/skeleton`);
          assert.deepEqual([skeleton.status, await skeleton.text()], [500, 'this went wrong here\n']);
        };
        await withBackEnd(order, ask, { servers: [address], clientOptions, onFailed: (error) => heard.push(error) });
      }
      assert.ok(heard.every(({ message }) => /token/.test(message)), `${heard}`);
      assert.equal(heard.length, 8);
    });
  } finally {
    await rm(folder, { recursive: true });
  }
});

test('what can be no key is refused by the names that the page knows', () =>
  withBackEnd(
    () => ({ ...order(), seconds: 20, speed: 1 }),
    async ({ url }) => {
      const page = connectDance(url);
      const { id } = await page.begun;
      const post = (body) => fetch(`${url}/${id}/keys`, { method: 'POST', body });
      for (const [body, field] of [['{}', 'time'], ['null', 'key'], ['[{"time":5,"pose":"bow"}]', 'key'], ['7', 'key'], ['{"time":5}', 'pose']]) {
        const answer = await post(body);
        assert.deepEqual([answer.status, (await answer.text()).split(':')[0]], [400, field], body);
      }
      const fields = [
        [{}, 'pose'],
        [null, 'key'],
        [[], 'key'],
        [{ pose: 'kick', place: [50, 0] }, 'place'],
        [{ pose: 'kick', place: [1] }, 'place'],
        [{ pose: 'kick', place: 'there' }, 'place'],
        [{ pose: 'kick', tme: 8 }, 'tme'],
        [{ pose: 'kick', time: NaN }, 'time'],
        [{ pose: 'kick', time: -1 }, 'time'],
        [{ pose: 'kick', id: 'é'.repeat(150) }, 'id'],
        [{ pose: 'kick', time: 8, id: 'half \ud83d' }, 'id'],
        [{ rotations: { head: [0, NaN, 0] } }, 'rotations.head'],
        [{ rotations: { head: [0, 7, 0] } }, 'rotations.head'],
        [{ rotations: { head: [0, 1, 0] }, hold: 2 }, 'hold'],
        [{ rotations: {} }, 'rotations'],
      ];
      for (const [key, field] of fields) {
        const error = await page.setKey(key).then(() => assert.fail(field), (error) => error);
        assert.deepEqual([error.name, error.status, error.message.split(':')[0]], ['DanceError', 400, field], JSON.stringify(key));
      }
      page.close();
    },
  ));

test('the end and keys that are not there are told in the terms of the page', () =>
  withBackEnd(
    () => ({ ...order(), seconds: 20, speed: 1 }),
    async ({ url }) => {
      const heard = [];
      const page = connectDance(url, { onKey: (news) => heard.push(news) });
      const { id } = await page.begun;
      const post = async (key) => {
        const answer = await fetch(`${url}/${id}/keys`, { method: 'POST', body: JSON.stringify({ pose: 'kick', ...key }) });
        return [answer.status, (await answer.text()).trim()];
      };
      const near = 'time: 19.99 s is nearest to the end of the dance, 20 s; its last frame is at 19.967 s';
      assert.deepEqual(await post({ time: 19.99 }), [400, near]);
      assert.deepEqual(await post({ frame: 600 }), [400, 'frame: 600 is not before the end of the dance, 600']);
      assert.equal((await post({ time: 19.967 }))[0], 202);
      await page.removeKey('nobody');
      while (heard.length === 0) await sleep(20);
      assert.deepEqual(heard, [{ id: 'nobody', refused: 'there is no key "nobody"' }]);
      page.close();
    },
  ));

test('keys without an id get one each', () =>
  withBackEnd(
    () => ({ ...order(), seconds: 6, speed: 1 }),
    async ({ url }) => {
      const reached = [];
      const page = connectDance(url, { onKey: ({ id, time }) => reached.push([id, time]) });
      const { id } = await page.begun;
      const ids = [];
      for (const body of [{ time: 3, pose: 'bow' }, { time: 5, pose: 'kick' }, { time: 4, rotations: { head: [0, 0.4, 0] } }]) {
        const answer = await fetch(`${url}/${id}/keys`, { method: 'POST', body: JSON.stringify(body) });
        assert.equal(answer.status, 202);
        ids.push((await answer.json()).id);
      }
      while (!page.over) await sleep(20);
      assert.deepEqual(reached, [[ids[0], 3], [ids[2], 4], [ids[1], 5]]);
    },
  ));

test('a connection serves on after a key that is too long', () =>
  withBackEnd(order, async ({ url }) => {
    const agent = new Agent({ keepAlive: true, maxSockets: 1 });
    const post = async (body) => {
      const asked = httpRequest(`${url}/nobody/keys`, { method: 'POST', agent, headers: { 'Content-Length': body.length } }).end(body);
      const [answer] = await once(asked, 'response');
      for await (const _ of answer);
      return [answer.statusCode, answer.req.reusedSocket];
    };
    try {
      assert.deepEqual(await post('{}'), [404, false]);
      for (const length of [70000, 3e6]) {
        assert.deepEqual(await post('x'.repeat(length)), [413, true]);
        assert.deepEqual(await post('{}'), [404, true]);
      }
    } finally {
      agent.destroy();
    }
  }));
