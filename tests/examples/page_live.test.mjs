// client/node/serve: live music, beside which the dance goes on. $CHOREO_SERVER names a choreod.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { setTimeout as sleep } from 'node:timers/promises';
import { pcm } from '../../examples/node/music.js';
import { connectDance } from '../../client/node/page/index.js';
import { beside } from '../../client/node/serve/beside.js';
import { withBackEnd } from './back_end.mjs';

const piece = { audio: { data: new Uint8Array(4410) } }; // a tenth of a second

/** Music that never ends, and falls silent after `pieces`, for ever. `told.isClosed`: whether it was closed. */
function endless(told, pieces = Infinity) {
  let count = 0;
  const next = () => (++count > pieces ? new Promise(() => {}) : sleep(100).then(() => ({ done: false, value: piece })));
  return { [Symbol.asyncIterator]: () => ({ next, return: async () => ((told.isClosed = true), { done: true }) }) };
}

const order = (music, seconds) => ({ seconds, music, config: { seed: '7', audio_format: pcm } });

/** Watches a dance until `use(page, news)` is done. */
async function withPage(music, seconds, use) {
  await withBackEnd(() => order(music, seconds), async ({ url }) => {
    const news = [];
    const page = connectDance(url, { onKey: ({ id, refused }) => news.push([id, refused]), onEnd: (error) => news.push(['end', error?.message]) });
    await page.begun;
    const pictures = setInterval(() => page.follow(), 16);
    try {
      await use(page, news);
    } finally {
      clearInterval(pictures);
      page.close();
    }
  });
}

test('a dance to music that never ends is over after its seconds, and closes the music', async () => {
  const told = {};
  await withPage(endless(told), 3, async (page, news) => {
    while (!page.over) await sleep(20);
    assert.deepEqual(news, [['end', undefined]]);
  });
  assert.ok(told.isClosed);
});

test('music that falls silent delays no answer to a key, and is closed with its page', async () => {
  const told = {};
  await withPage(endless(told, 10), 30, async (page, news) => {
    while (page.soon() < 2.1) await sleep(20);
    await sleep(1000); // until it is silent
    await page.removeKey('nobody');
    while (news.length === 0) await sleep(20); // or for ever
    assert.deepEqual(news, [['nobody', 'there is no key "nobody"']]);
  });
  while (!told.isClosed) await sleep(20);
});

/** A client of a slow server: its answers come once it has been asked for all, `frames`, and `ready` is done. */
const slow = (frames, asked, ready) => (client) => ({
  info: (...given) => client.info(...given),
  async *streamDance(requests, options) {
    const noted = (async function* () {
      for await (const request of requests) {
        yield request;
        if (request.generate_until?.frame === frames) asked();
      }
    })();
    for await (const answer of client.streamDance(noted, options)) {
      yield answer;
      if (answer.frames) await ready;
    }
  },
});

test('a key that comes when all is settled is refused', async () => {
  let asked, answer;
  const [all, ready] = [new Promise((resolve) => (asked = resolve)), new Promise((resolve) => (answer = resolve))];
  await withBackEnd(
    () => ({ seconds: 20, config: { seed: '7' } }),
    async ({ url }) => {
      const news = [];
      const page = connectDance(url, { onKey: (one) => news.push(one) });
      const { id } = await page.begun;
      assert.equal((await fetch(`${url}/${id}/clock`, { method: 'POST', body: '{"time":19.5,"paused":true}' })).status, 202);
      await all;
      await page.setKey({ id: 'late', pose: 'kick', time: 19 });
      await page.removeKey('nobody');
      while (news.length < 2) await sleep(20); // or for ever
      assert.deepEqual(news, ['late', 'nobody'].map((key) => ({ id: key, refused: 'too late: all of the dance is settled' })));
      answer();
      page.close();
    },
    { through: slow(600, asked, ready) },
  );
});

test('pieces come at once, and ticks beside them, until the music ends or fails', async () => {
  const got = [];
  for await (const pieces of beside([1, Promise.resolve(2)], 1000)) got.push(pieces);
  assert.deepEqual(got, [[1], [2]]);
  const given = [];
  const broken = function* () {
    yield 1;
    throw new Error('torn');
  };
  await assert.rejects(async () => {
    for await (const pieces of beside(broken(), 1000)) given.push(...pieces);
  }, /torn/);
  assert.deepEqual(given, [1], 'what came before');
  let closed = 0;
  const close = () => {
    ++closed;
    throw new Error('it does not close');
  };
  const closing = (count) => ({ [Symbol.iterator]: () => ({ next: () => ({ done: --count < 0, value: count }), return: close }) });
  for await (const pieces of beside(closing(1), 1000)) assert.deepEqual(pieces, [0]);
  assert.equal(closed, 0, 'it has ended by itself');
  for await (const pieces of beside(closing(9), 1000)) if (pieces[0] === 5) break;
  assert.equal(closed, 1);
  const failing = (async function* () {
    yield await sleep(200, 3);
    throw new Error('no line in');
  })();
  const ticks = [];
  await assert.rejects(async () => {
    for await (const pieces of beside(failing, 20)) ticks.push(...(pieces.length > 0 ? pieces : ['tick']));
  }, /no line in/);
  assert.deepEqual([ticks[0], ticks.at(-1)], ['tick', 3]);
});
