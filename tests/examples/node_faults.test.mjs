// What goes wrong between a page and its back end, and what each hears of it. $CHOREO_SERVER names a choreod.
import assert from 'node:assert/strict';
import { mkdtemp, rm, writeFile } from 'node:fs/promises';
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
