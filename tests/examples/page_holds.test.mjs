// client/node/serve and client/node/page: keys that are held, which are several at the server and one for the page. $CHOREO_SERVER names a choreod.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { setTimeout as sleep } from 'node:timers/promises';
import { connectDance } from '../../client/node/page/index.js';
import { DanceKeys } from '../../client/node/serve/dance_keys.js';
import { readKeys } from '../../client/node/src/index.js';
import { withBackEnd } from './back_end.mjs';

/**
 * A dance to its end: what `act(page, requests)` asks for as soon as it has begun, and the news, warnings and requests of it all. `before(client)`: what
 * is danced by instead of the client.
 */
async function watch(order, act, before = (client) => client) {
  const [news, warnings, requests] = [[], [], []];
  /** Notes the requests that the server gets. */
  const through = (client) => ({
    info: (...given) => client.info(...given),
    streamDance: (from, options) => before(client).streamDance(noting(from, requests), options),
  });
  await withBackEnd(
    () => order,
    async ({ url }) => {
      const page = connectDance(url, { onKey: ({ id, time, refused }) => news.push([id, refused ?? time]), onWarning: ({ message }) => warnings.push(message) });
      const pictures = setInterval(() => page.follow(), 16);
      try {
        await page.begun;
        await act(page, requests);
        while (!page.over) await sleep(20);
      } finally {
        clearInterval(pictures);
        page.close();
      }
    },
    { through },
  );
  return { news, warnings, requests };
}

async function* noting(from, requests) {
  for await (const request of from) {
    requests.push(request);
    yield request;
  }
}

const ofKeys = (requests) => requests.flatMap(({ keyframe, remove_keyframe: gone }) => (keyframe ? [[keyframe.id, keyframe.time]] : gone ? [[`-${gone.id}`]] : []));
const silent = (seconds) => ({ seconds, config: { seed: '7' } });
const praise = { pose: 'praise', id: 'h' };

test('a held key is one key for its page, and goes with its whole hold', async () => {
  const { news, requests } = await watch(silent(9), async (page) => {
    await page.setKey({ ...praise, time: 4, hold: 1 });
    await page.setKey({ ...praise, time: 7, hold: 0.4 });
    await page.setKey({ pose: 'bow', id: 'g', time: 3, hold: 1 });
    await page.removeKey('g');
  });
  assert.deepEqual(news, [['h', 7]], 'not of the steps, nor of g');
  const steps = (id, from, to, count) => Array.from({ length: count }, (_, at) => [`${id} held ${at + 1}`, from + ((to - from) * (at + 1)) / count]);
  const gone = (id, count) => Array.from({ length: count }, (_, at) => [`-${id} held ${at + 1}`]);
  const asked = [['h', 4], ...steps('h', 4, 5, 5), ...gone('h', 5), ['h', 7], ...steps('h', 7, 7.4, 2), ['g', 3], ...steps('g', 3, 4, 5), ...gone('g', 5), ['-g']];
  const near = ([id, time]) => `${id} ${time === undefined ? '' : time.toFixed(3)}`;
  assert.deepEqual(ofKeys(requests).map(near).sort(), asked.map(near).sort());
});

test('a move that is refused leaves key and hold where they stand', async () => {
  const { news } = await watch(silent(7), async (page) => {
    await page.setKey({ ...praise, time: 4, hold: 1 });
    await page.setKey({ ...praise, time: 0, hold: 1 });
    await page.setKey({ pose: 'bow', id: 'before' });
    while (!page.over && page.soon() < 5) await sleep(20);
    assert.ok(page.soon() >= 6, `${page.soon()} s is a second from the end of the hold`);
  });
  assert.match(news.shift().join(), /^h,too late: all before [\d.]+ s is settled$/);
  assert.deepEqual(news.map(([id]) => id), ['before', 'h']);
});

test('the next time that is open is after a hold, also once its key is reached', () =>
  watch(silent(8), async (page) => {
    const { time } = await page.setKey({ ...praise, hold: 2 });
    assert.ok(page.soon() >= time + 3);
    while (page.follow().state !== 'over' && page.soon() === time + 3) await sleep(10);
    assert.ok(page.soon() > time + 3, 'it is reached, and time goes on');
  }));

test('a held key that comes too late is refused with its whole hold', async () => {
  const { news, requests } = await watch(silent(6), async (page) => {
    while (page.follow().state !== 'playing' || page.soon() < 3.5) await sleep(10);
    await page.setKey({ ...praise, time: 0.5, hold: 5 });
  });
  assert.match(news.join(), /^h,too late: all before [\d.]+ s is settled$/);
  assert.deepEqual(ofKeys(requests), []);
});

test('a hold whose steps are refused says so once', async () => {
  const refuse = ({ keyframe }) => /held [34]$/.test(keyframe?.id ?? '');
  const rejected = (id) => ({ event: { frame: '130', time: 4.33, keyframe_rejected: { id, code: 'REJECTION_CODE_INVALID', field: '', reason: 'there are 1000 keys' } } });
  const through = (client) => ({
    info: (...given) => client.info(...given),
    async *streamDance(from, options) {
      const ids = [];
      const passed = (async function* () {
        for await (const request of from) if (refuse(request)) ids.push(request.keyframe.id); else yield request;
      })();
      for await (const answer of client.streamDance(passed, options)) {
        yield answer;
        yield* ids.splice(0).map(rejected);
      }
    },
  });
  const { warnings } = await watch(silent(6), (page) => page.setKey({ ...praise, time: 4, hold: 1 }), through);
  assert.deepEqual(warnings, ['it is not held to its end: there are 1000 keys']);
});

test('a reached key that is taken back is let go', async () => {
  const { news, requests } = await watch(silent(9), async (page) => {
    await page.setKey({ ...praise, time: 3, hold: 5 });
    while (page.at(3).state !== 'playing') await sleep(10);
    await page.removeKey('h');
  });
  assert.deepEqual(news, [['h', 3]]);
  const keys = ofKeys(requests).map(([id]) => id);
  assert.ok(keys.includes('-h held 25') && !keys.includes('-h'), `${keys}`);
});

test('a key within a hold ends it half a second before itself, until it is moved or taken away', async () => {
  const { news, warnings, requests } = await watch(silent(9), async (page) => {
    await page.setKey({ ...praise, time: 4, hold: 2 });
    await page.setKey({ pose: 'bow', id: 'b', time: 5.5 });
    await page.setKey({ pose: 'bow', id: 'b', time: 8 });
    await page.setKey({ pose: 'bow', id: 'b', time: 5.5 });
    await page.removeKey('b');
  });
  assert.deepEqual(warnings.filter((text) => text.includes('held')), Array(2).fill('it is held up to 5 s, not 6 s: the key "b" comes at 5.5 s'));
  assert.deepEqual(news, [['h', 4]]);
  const steps = ofKeys(requests).map(([id]) => id).filter((id) => /held (9|10|5)$/.test(id));
  const [come, gone] = [['h held 9', 'h held 10'], ['-h held 9', '-h held 10']];
  assert.deepEqual(steps, ['h held 5', ...come, ...gone, ...come, ...gone, ...come]);
});

test("a hold that the back end's own keys have is one, too", async () => {
  let skeleton;
  await withBackEnd(() => silent(1), async ({ client }) => ({ skeleton } = (await client.info()).models[0]));
  const keys = readKeys({ keyframes: [{ ...praise, time: 3, hold: 1 }] }, skeleton);
  const { news } = await watch({ ...silent(6), keys }, (page) => page.removeKey('h'));
  assert.deepEqual(news, []);
});

test('a hold of a minute is sent as it comes near, and ends within the dance', async () => {
  const { requests } = await watch(silent(200), async (page, requests) => {
    for (const time of [60, 125]) await page.setKey({ ...praise, id: `at ${time}`, time, hold: 60 });
    const error = await page.setKey({ ...praise, time: 150, hold: 60 }).then(assert.fail, (one) => one);
    assert.equal(error.message, 'hold: ends at 210 s, after the end of the dance: its last frame is at 199.967 s');
    const own = await page.setKey({ pose: 'bow', id: 'at 60 held 3', time: 190 }).then(assert.fail, (one) => one);
    assert.equal(own.message, 'id: "at 60 held 3" is of the hold of the key "at 60"');
    const name = await page.setKey({ ...praise, id: 'x'.repeat(248), time: 190, hold: 60 }).then(assert.fail, (one) => one);
    assert.equal(name.message, 'id: has 248 bytes, not 1 to 247, the most of a held key');
    while (ofKeys(requests).length < 2) await sleep(10);
    page.close();
    while (!page.over) await sleep(20);
  });
  assert.deepEqual(ofKeys(requests), [['at 60', 60], ['at 125', 125]]);
});

test('steps come as frames settle, and none is left out where the page goes far ahead', () => {
  const keys = new DanceKeys(30, 3000);
  const set = (id, time, hold) => keys.set([time, ...Array.from({ length: 5 * hold }, (_, at) => time + 0.2 * (at + 1))].map((at, step) => ({ keyframe: { id: step ? `${id} held ${step}` : id, time: at } })), () => {});
  assert.equal(set('a', 10, 60).length, 1);
  assert.equal(keys.settle(30 * 9).length, 20, 'up to 14 s');
  assert.equal(keys.settle(30 * 80).length, 280, 'the rest');
  assert.deepEqual(keys.settle(30 * 81), []);
  set('b', 85, 2);
  set('c', 86.5, 0);
  assert.equal(keys.settle(30 * 86).length, 0);
  assert.deepEqual(keys.settle(30 * 88), [], 'the key that has ended a hold has ended it');
  set('d', 90, 1);
  assert.equal(keys.remove('d').length, 6);
  keys.refuse('d', 2700, { isRemoval: true });
  assert.equal(keys.settle(30 * 89).length, 5, 'it is frozen, and held');
});

test('a move that is refused leaves the one that followed, and a frozen key stands', () => {
  const keyframe = (id, time) => ({ keyframe: { id, time } });
  for (const [first, second, refused, how] of [
    [20, 10, 20, undefined],
    [10, 30, 10, { isFrozen: true }],
  ]) {
    const keys = new DanceKeys(30, 3000);
    for (const time of [first, second]) keys.set([keyframe('a', time)], () => {});
    keys.refuse('a', 30 * refused, how);
    const warnings = [];
    keys.set([keyframe('h', 8), keyframe('h held 1', 9), keyframe('h held 2', 12)], (...warning) => warnings.push(warning.join(': ')));
    assert.deepEqual(warnings, ['h: it is held up to 9 s, not 12 s: the key "a" comes at 10 s']);
  }
});
