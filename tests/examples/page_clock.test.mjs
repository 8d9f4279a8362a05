// A dance of serveDance() follows the clock of its page, and keys get times that are open. $CHOREO_SERVER names a choreod.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { setTimeout as sleep } from 'node:timers/promises';
import { connectDance } from '../../client/node/page/index.js';
import { pose } from '../../client/node/src/index.js';
import { withBackEnd } from './back_end.mjs';

const order = () => ({ seconds: 30, config: { seed: '7' } });

/** An <audio> element. */
class Song {
  paused = true;
  ended = false;
  #at = 0;
  #since = 0;

  get currentTime() {
    return this.paused ? this.#at : this.#at + (performance.now() - this.#since) / 1000;
  }

  set currentTime(time) {
    [this.#at, this.#since] = [time, performance.now()];
  }

  play() {
    if (this.paused) this.#since = performance.now();
    this.paused = false;
  }

  pause() {
    this.#at = this.currentTime;
    this.paused = true;
  }
}

/** Follows a song on a page, until `use({page, song, shown(), heard})` is done; `heard`: what became of keys, by id. */
async function withPage(url, use) {
  const heard = new Map();
  const page = connectDance(url, { onKey: (news) => heard.set(news.id, news.refused ?? 'reached') });
  const song = new Song();
  await page.begun;
  page.wear();
  let shown = page.follow(song);
  const pictures = setInterval(() => (shown = page.follow(song)), 16);
  try {
    while (song.paused) await sleep(10);
    await use({ page, song, shown: () => shown, heard });
  } finally {
    clearInterval(pictures);
    page.close();
  }
}

async function heardOf(heard, ...ids) {
  while (!ids.every((id) => heard.has(id))) await sleep(20);
  return ids.map((id) => heard.get(id));
}

test('a paused page settles no more than a second, and the first key afterwards is danced', () =>
  withBackEnd(order, ({ url }) =>
    withPage(url, async ({ page, song, shown, heard }) => {
      song.pause();
      await sleep(3000);
      assert.ok(shown().ahead < 1.5, `ahead ${shown().ahead} s`); // a busy back end hears of the pause late
      const [first, second] = await Promise.all([page.setKey({ pose: 'kick' }), page.setKey({ pose: 'salute' })]);
      assert.ok(first.time < song.currentTime + 2.5, 'it need not wait');
      assert.ok(second.time >= first.time + 0.5, `${first.time} s, ${second.time} s`);
      song.play();
      assert.deepEqual(await heardOf(heard, first.id, second.id), ['reached', 'reached']);
    }),
  ));

test('a page that goes forward and back asks for what is open', () =>
  withBackEnd(order, ({ url }) =>
    withPage(url, async ({ page, song, shown, heard }) => {
      song.currentTime = 10;
      while (song.currentTime < 10.5 || shown().state !== 'playing') await sleep(10);
      song.currentTime = 1;
      await sleep(300);
      const back = await page.setKey({ pose: 'kick' });
      assert.ok(back.time > 11, `${back.time} s is past`);
      song.currentTime = 11;
      assert.deepEqual(await heardOf(heard, back.id), ['reached']);
    }),
  ));

/** A client whose first frames come late. */
const late = (client) => ({
  info: (...given) => client.info(...given),
  async *streamDance(...given) {
    let isLate = false;
    for await (const answer of client.streamDance(...given)) {
      if (answer.frames && !isLate) await sleep(3000);
      isLate ||= answer.frames !== undefined;
      yield answer;
    }
  },
});

test('first frames that come late settle nothing before they are shown', () =>
  withBackEnd(
    order,
    ({ url }) =>
      withPage(url, async ({ page, shown, heard }) => {
        assert.ok(shown().ahead < 1.5, `ahead ${shown().ahead} s`);
        const { id, time } = await page.setKey({ pose: 'kick' });
        assert.ok(time < 2.5, `${time} s`);
        assert.deepEqual(await heardOf(heard, id), ['reached']);
      }),
    { through: late },
  ));

test('a dance without a clock of its page begins with its first frame', () =>
  withBackEnd(
    order,
    async ({ url }) => {
      const heard = new Map();
      const page = connectDance(url, { onKey: (news) => heard.set(news.id, news.refused ?? 'reached') });
      while (page.soon() <= 2) await sleep(5); // until frames come
      await page.setKey({ id: 'kick', pose: 'kick', time: 2.2 });
      assert.deepEqual(await heardOf(heard, 'kick'), ['reached']);
      page.close();
    },
    { through: late },
  ));

test('a dance that is longer than its song goes on to its end', () =>
  withBackEnd(
    () => ({ ...order(), seconds: 5 }),
    ({ url }) =>
      withPage(url, async ({ page, song }) => {
        song.ended = song.paused = true;
        song.currentTime = 0.5;
        while (!page.over) await sleep(20);
      }),
  ));

test("a page that wears nothing shows SMPL's own joints", () =>
  withBackEnd(order, async ({ url }) => {
    const page = connectDance(url);
    const { skeleton } = await page.begun;
    let shown;
    while ((shown = page.follow()).state !== 'playing') await sleep(10);
    assert.equal(shown.pose.turns.length, 4 * skeleton.joint_names.length);
    page.close();
  }));

/** Configurations of dances that begin later, and their first frames. */
async function laterStarts() {
  const kept = [];
  const onContinuation = (continuation, id) => kept.push([id, JSON.stringify(continuation)]);
  let poses;
  await withBackEnd(
    () => ({ seconds: 4, speed: 4, config: { seed: '1' } }),
    async ({ url, client }) => {
      poses = [{ ...pose((await client.info()).models[0].skeleton), root_position: { x: 0, y: 1, z: 0 } }];
      const page = connectDance(url);
      const { id } = await page.begun;
      while (!page.over) await sleep(10);
      assert.ok(kept.every(([of]) => of === id));
    },
    { onContinuation },
  );
  const continuation = kept.map(([, text]) => JSON.parse(text)).find(({ frame }) => frame > 30);
  return [[Number(continuation.frame), { continuation }], [60, { history: { poses, first_frame: '60' } }]];
}

test('a dance that goes on from a continuation, or from later poses, plays from its first frame on', async () => {
  for (const [first, config] of await laterStarts()) {
    await withBackEnd(
      () => ({ seconds: first / 30 + 2, config }),
      async ({ url }) => {
        await withPage(url, async ({ page, song, shown }) => {
          assert.equal((await page.begun).first_frame, first);
          assert.ok(song.currentTime >= first / 30, `it is set to ${song.currentTime} s`);
          assert.ok(page.soon() >= first / 30 + 2, `${page.soon()} s`);
          while (shown().state !== 'over') await sleep(10);
          assert.ok(song.currentTime >= first / 30 + 1.9);
        });
        const page = connectDance(url);
        await page.begun;
        assert.equal(page.at(first / 30).state, 'waiting');
        while (page.follow().state !== 'over') await sleep(10);
      },
    );
  }
});
