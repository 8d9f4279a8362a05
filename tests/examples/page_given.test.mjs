// client/node/serve and client/node/page: what they are given, and get from each other, that is wrong. $CHOREO_SERVER names a choreod.
import assert from 'node:assert/strict';
import { once } from 'node:events';
import { connect } from 'node:net';
import { test } from 'node:test';
import { setTimeout as sleep } from 'node:timers/promises';
import { connectDance } from '../../client/node/page/index.js';
import { withBackEnd } from './back_end.mjs';

const order = (seconds, speed = 1) => () => ({ seconds, speed, config: { seed: '7' } });
const refused = (promise) => promise.then(() => assert.fail('nothing went wrong'), ({ name, status, message }) => [name, status, message]);

/** What the console hears until `use()` is done. */
async function saidDuring(use) {
  const said = [];
  const { error } = console;
  console.error = (...words) => said.push(words.map((word) => word?.message ?? word).join(' '));
  try {
    await use();
  } finally {
    console.error = error;
  }
  return said;
}

test("a page's callbacks that fail end no dance, and the console hears of them", async () => {
  const said = await saidDuring(() =>
    withBackEnd(order(3), async ({ url }) => {
      const ended = new Promise((resolve) => {
        const onEnd = (error) => {
          resolve(error);
          throw new Error('of the end');
        };
        const onKey = () => {
          throw new Error('of a key');
        };
        connectDance(url, { onKey, onEnd }).setKey({ pose: 'kick', time: 2.5 });
      });
      assert.equal(await ended, undefined);
      await sleep(50);
    }),
  );
  assert.deepEqual(said, ['of a key', 'of the end']);
});

test("a back end's callbacks that fail end no dance and no process, and a wrong order is answered all the same", async () => {
  const fail = async ({ message = 'of a continuation' }) => {
    throw new Error(message);
  };
  const failAtOnce = ({ message }) => {
    throw new Error(message);
  };
  const said = await saidDuring(() =>
    withBackEnd(
      ({ searchParams }) => {
        if (searchParams.has('none')) throw null;
        if (searchParams.has('odd')) throw Object.assign(new Error('odd'), { status: 450.5 });
        return { ...order(searchParams.has('wrong') ? -1 : 2, 4)() };
      },
      async ({ url }) => {
        assert.equal((await fetch(`${url}?wrong`)).status, 400);
        assert.equal((await fetch(`${url}?none`)).status, 500);
        assert.equal((await fetch(`${url}?odd`)).status, 500);
        assert.match(await (await fetch(url)).text(), /event: over\n/);
      },
      { onContinuation: fail, onFailed: (error) => failAtOnce(error ?? { message: 'null' }) },
    ),
  );
  assert.deepEqual(said.slice(0, 3), ['seconds: -1 is not a number above 0', 'null', 'odd']);
  assert.ok(said.length > 3 && said.slice(3).every((words) => words === 'of a continuation'), `${said}`);
});

test('members of a key that are undefined are left out, and an id is a text', () =>
  withBackEnd(order(20), async ({ url }) => {
    const news = [];
    const page = connectDance(url, { onKey: (one) => news.push(one) });
    await page.begun;
    const { id, time } = await page.setKey({ pose: 'kick', id: undefined, time: undefined, hold: undefined, place: undefined });
    assert.deepEqual([id, time >= 2], ['key 1', true]);
    assert.deepEqual(await refused(page.setKey({ pose: 'kick', id: 5 })), ['DanceError', 400, 'id: 5 is not a text']);
    for (const one of ['.', '..']) {
      const means = `id: "${one}" means a folder in an address`;
      assert.deepEqual(await refused(page.setKey({ pose: 'kick', id: one })), ['DanceError', 400, `${means}, such as that at which a key is taken back`]);
      assert.deepEqual(await refused(page.removeKey(one)), ['DanceError', 400, `${means}: no key has it`]);
    }
    assert.deepEqual(await refused(page.removeKey('')), ['DanceError', 400, 'id: is empty']);
    assert.deepEqual(await refused(page.removeKey()), ['DanceError', 400, 'id: undefined is not a text']);
    assert.deepEqual(await refused(page.removeKey(5)), ['DanceError', 400, 'id: number is not a text']);
    assert.deepEqual(await refused(page.setKey({ pose: 'kick', time: 3n })), ['DanceError', 400, "time: '3' is not a number"]);
    const circle = { pose: 'kick' };
    circle.circle = circle;
    const [name, status, message] = await refused(page.setKey(circle));
    assert.deepEqual([name, status, message.startsWith('key: ')], ['DanceError', 400, true]);
    const moved = await page.setKey({ pose: 'kick', id: 'moved' });
    await refused(page.setKey({ pose: 'kik', id: 'moved', time: 18 }));
    assert.ok(page.soon() >= moved.time + 1, 'it stands where it was');
    assert.ok(news.every((one) => !one.refused), 'none of these went to the dance');
    page.close();
  }));

test('a page that breaks off what it says is no failure of the back end', async () => {
  const failures = [];
  await withBackEnd(
    order(20),
    async ({ url }) => {
      const page = connectDance(url);
      const { id } = await page.begun;
      const { port, hostname } = new URL(url);
      const cut = connect(port, hostname, () => cut.write(`POST /dance/${id}/keys HTTP/1.1\r\nHost: x\r\nContent-Length: 1000\r\n\r\n{"id":`));
      await once(cut, 'connect');
      await sleep(200);
      cut.destroy();
      await sleep(200);
      page.close();
    },
    { onFailed: (error) => failures.push(error) },
  );
  assert.deepEqual(failures, []);
});

test('what an order leaves out is not null', () =>
  withBackEnd(
    ({ searchParams }) => ({ ...order(2)(), [searchParams.get('name')]: null }),
    async ({ url }) => {
      for (const name of ['config', 'music', 'keys', 'speed']) {
        const answer = await fetch(`${url}?name=${name}`);
        assert.deepEqual([answer.status, await answer.text()], [400, `${name}: is null; leave it out\n`]);
      }
    },
    { onFailed: () => {} },
  ));
