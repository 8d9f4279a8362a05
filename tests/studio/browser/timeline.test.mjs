// Keys on the studio's timeline: set, moved, held and hit, also where others stand already; markers; what Space does.
//   node timeline.test.mjs CHOREO_PROGRAM PICTURES_FOLDER
import assert from 'node:assert/strict';
import { check, clicks, inEachLook } from './harness.mjs';

const seconds = 8;

await inEachLook(async ({ page, until, settle, message, scale, frames, give, hand, takeIt, isFirst }) => {
  await give(['clicks.wav', clicks(seconds)]);
  await page.locator('.key').first().waitFor();
  await settle();
  const keys = () => page.evaluate(() => window.choreo.project.value.keys.map(({ id, frame }) => ({ id, frame })));
  const isPlaying = () => page.evaluate(() => !window.choreo.audio.paused);
  const library = page.locator('.library li button');
  const key = (nth) => page.locator('.key').nth(nth);
  const undo = async (times = 1) => {
    for (let i = 0; i < times; ++i) await page.evaluate(() => window.choreo.undo());
    await settle();
  };
  const seek = (seconds) => page.evaluate((seconds) => (window.choreo.audio.currentTime = seconds), seconds);
  /// The frame of the beat nearest to a frame.
  const beatAt = (frame) => page.evaluate((frame) => {
    const frames = window.choreo.beats.value.list.map(({ time }) => Math.round(30 * time));
    return frames.sort((a, b) => Math.abs(a - frame) - Math.abs(b - frame))[0];
  }, frame);

  await check('a pose dropped on a key takes its place, held and hit as that was: it is said, and undo brings the other one back', async () => {
    const before = await keys();
    const { id, frame } = before[2];
    await page.evaluate((id) => window.choreo.hitKey(id, 2), id);
    await settle();
    await hand.carry(library.nth(1), key(2), 3, async () => {
      assert.equal(await page.locator('.key.replaced').getAttribute('data-key'), id, 'it is not seen which one');
      await takeIt('replaced-');
    });
    await settle();
    const after = await keys();
    assert.equal(after.length, before.length, 'two keys stand in one place');
    assert.equal(after[2].frame, frame);
    assert.notEqual(after[2].id, id);
    assert.equal(await page.evaluate(() => window.choreo.project.value.keys[2].hit), 2);
    const { text, isError } = await message();
    assert.ok(!isError && text.includes(id.replaceAll('_', ' ')) && text.includes('Undo'), text);
    await undo(2);
    assert.deepEqual(await keys(), before);
  });

  await check('a key snaps to the beat near which it is dropped', async () => {
    const before = await keys();
    await hand.drag(key(1), 0.45 * (await scale()));
    await settle();
    const { frame } = (await keys()).find(({ id }) => id === before[1].id);
    assert.equal(frame, await beatAt(before[1].frame + 0.45 * 30));
    await undo();
    assert.deepEqual(await keys(), before);
  });

  await check('a pose is dwelt on as far as its end is pulled; the next key and all behind it stay', async () => {
    const before = await keys();
    const danced = await frames();
    const held = () => page.evaluate(() => window.choreo.project.value.keys.map(({ hold }) => hold));
    await hand.tap(key(1));
    const grip = page.getByRole('slider', { name: /^How long key/ });
    await hand.drag(grip, 0.3 * (await scale()));
    await settle();
    const pulled = (await held())[1];
    assert.ok(pulled >= 6 && pulled <= 18, `${pulled}`);
    await grip.focus();
    await page.keyboard.press('ArrowRight');
    await settle();
    const long = pulled + 6;
    assert.equal((await held())[1], long);
    const now = await frames();
    const [{ frame }, next] = before.slice(1);
    const turnsFrom = (a, b) => Math.max(...JSON.parse(a).rotations.map((value, i) => Math.abs(value - JSON.parse(b).rotations[i])));
    for (let at = 6; at <= long; at += 6) assert.ok(turnsFrom(now[frame + at], now[frame]) < 0.01, `${at} frames behind it`);
    assert.ok(turnsFrom(danced[frame + long], danced[frame]) > 0.05);
    assert.deepEqual(now.slice(next.frame), danced.slice(next.frame));
    // As far as there is room.
    await page.evaluate(([id]) => window.choreo.holdKey(id, 600), [before[1].id]);
    await settle();
    const most = (await held())[1];
    assert.ok(most > long && most <= next.frame - frame - 2, `${most}`);
    await undo(3);
    assert.deepEqual(await held(), before.map(() => 0));
  });

  await check('a key is hit gently or hard: the ways to it and from it are danced anew, and undo takes it back', async () => {
    const danced = await frames();
    const [before, { id, frame }, next] = await keys();
    const hits = () => page.evaluate(() => window.choreo.project.value.keys.map(({ hit }) => hit));
    await hand.tap(key(1));
    await hand.tap(page.getByText('Come to rest in it'));
    await settle();
    assert.equal((await hits())[1], 1);
    const grip = page.getByRole('slider', { name: /^How hard key/ });
    await hand.drag(grip, -(15 / 30) * (await scale()), async () => assert.equal(await grip.innerText(), 'hit 2.5'));
    await settle();
    assert.equal((await hits())[1], 2.5);
    await grip.press('ArrowLeft');
    await settle();
    assert.equal((await hits())[1], 2.6);
    await hand.tap(grip);
    await settle();
    assert.equal((await hits())[1], null, 'a press does not let her dance through it');
    await undo(3);
    await page.getByRole('slider', { name: 'How hard it is hit' }).fill('3');
    await settle();
    assert.deepEqual((await hits()).slice(0, 3), [null, 3, null]);
    const now = await frames();
    // The mean of all joints: feet that stand turn their ankles to the last.
    const step = (all, at) => JSON.parse(all[at]).rotations.reduce((sum, value, i) => sum + Math.abs(value - JSON.parse(all[at - 1]).rotations[i]), 0);
    assert.ok(step(now, frame) < 0.5 * Math.max(...[4, 5, 6, 7, 8].map((back) => step(now, frame - back))), 'she does not come to rest');
    assert.deepEqual([...now.slice(0, before.frame), ...now.slice(next.frame)], [...danced.slice(0, before.frame), ...danced.slice(next.frame)]);
    await undo(2);
    assert.deepEqual(await hits(), (await keys()).map(() => null));
    assert.deepEqual(await frames(), danced, `${id} is danced otherwise`);
  });

  await check('markers are set, named, moved and removed; keys snap to them, and no frame changes', async () => {
    const danced = await frames();
    const markers = () => page.evaluate(() => window.choreo.project.value.markers);
    await seek(49 / 30);
    if (isFirst) {
      await page.locator('.stage canvas').focus();
      await page.keyboard.press('m');
    } else await hand.tap(page.getByRole('button', { name: 'Mark the playhead' }));
    await settle();
    assert.deepEqual(await markers(), [{ frame: 49, name: 'mark' }]);
    await page.getByLabel('Name of the marker at 1.6 s').fill('drop');
    await page.keyboard.press('Enter');
    await settle();
    assert.deepEqual(await markers(), [{ frame: 49, name: 'drop' }]);
    const flag = page.getByRole('button', { name: 'Marker drop at 1.6 s' });
    await hand.drag(flag, 0.32 * (await scale()));
    await settle();
    assert.equal((await markers())[0].frame, await beatAt(49 + 0.32 * 30));
    await undo();
    assert.equal((await markers())[0].frame, 49);
    // Nearer to the marker than to a beat.
    const before = await keys();
    await hand.drag(key(1), (await scale()) * ((50 - before[1].frame) / 30));
    await settle();
    assert.equal((await keys()).find(({ id }) => id === before[1].id).frame, 49);
    await undo();
    await hand.tap(page.getByRole('button', { name: 'Remove marker drop' }));
    await settle();
    assert.deepEqual(await markers(), []);
    assert.deepEqual(await frames(), danced);
  });

  await check('a key is set again where the dance ends, and held to its last frame', async () => {
    const before = await keys();
    await hand.tap(key(1));
    await hand.tap(page.getByRole('button', { name: 'End in it' }));
    await settle();
    const [total, last] = await page.evaluate(() => [window.choreo.total.value, window.choreo.project.value.keys.at(-1)]);
    assert.ok(last.id.startsWith(before[1].id.replace(/-\d+$/, '')), last.id);
    assert.deepEqual([last.frame + last.hold, last.hit], [total - 1, 1]);
    await undo();
    assert.deepEqual(await keys(), before);
  });

  await check('a held, hit key with hands and a chosen marker are seen', async () => {
    await hand.tap(key(1));
    await page.getByLabel('What hands do').selectOption('open');
    await page.evaluate(() => {
      const { selectedKey, audio, addMarker, hitKey, holdKey } = window.choreo;
      audio.currentTime -= 0.5;
      addMarker();
      hitKey(selectedKey.value, 2);
      return holdKey(selectedKey.value, 12);
    });
    await settle();
    const [marker, { hold, hit, hands }] = await page.evaluate(() => [window.choreo.project.value.markers[0], window.choreo.project.value.keys[1]]);
    assert.deepEqual([hold, hit, hands], [12, 2, 3]);
    await page.locator('.marker').press('Enter');
    await until((seconds) => Math.abs(window.choreo.audio.currentTime - seconds) < 0.01, marker.frame / 30);
    await page.evaluate(() => (window.choreo.message.value = null));
    await takeIt('key-');
  });

  if (!isFirst) return;

  await undo(4);

  for (const [what, part] of [['a key', '.key'], ['an interval', '.interval']]) {
    await check(`Space plays while ${what} has the focus, and Enter presses it`, async () => {
      await page.locator(part).nth(1).click();
      assert.equal(await page.evaluate((part) => document.activeElement.matches(part), part), true);
      const pressed = () => page.locator(part).nth(1).getAttribute('aria-pressed');
      const before = await pressed();
      await page.keyboard.press('Space');
      await until(() => !window.choreo.audio.paused);
      await page.keyboard.press('Space');
      await until(() => window.choreo.audio.paused);
      assert.equal(await pressed(), before, 'Space pressed it, too');
      assert.equal((await message())?.isError ?? false, false, 'who pauses at once is told of an error');
      await page.locator(part).nth(0).focus();
      await page.keyboard.press('Enter');
      assert.equal(await page.locator(part).nth(0).getAttribute('aria-pressed'), 'true');
      assert.equal(await isPlaying(), false);
    });
  }

  await check('Space presses the other buttons', async () => {
    await page.getByRole('button', { name: 'Loop' }).focus();
    await page.keyboard.press('Space');
    assert.equal(await page.getByRole('button', { name: 'Loop' }).getAttribute('aria-pressed'), 'true');
    assert.equal(await isPlaying(), false);
    await page.keyboard.press('Space');
  });

  await check('Space plays while a slider has the focus, or a pose that was pressed; one reached by keyboard it sets', async () => {
    const play = async () => {
      await page.keyboard.press('Space');
      await until(() => !window.choreo.audio.paused);
      await page.keyboard.press('Space');
      await until(() => window.choreo.audio.paused);
    };
    await page.getByLabel('energy').focus();
    await play();
    const before = await keys();
    await seek(0.7);
    await library.nth(2).click();
    await settle();
    const after = await keys();
    assert.notDeepEqual(after, before);
    await play();
    await settle();
    assert.deepEqual(await keys(), after, 'Space set it again');
    for (const way of ['Tab', 'Shift+Tab']) await page.keyboard.press(way);
    await page.keyboard.press('Space');
    await settle();
    assert.notDeepEqual(await keys(), after);
    assert.equal(await isPlaying(), false);
    await undo(2);
    assert.deepEqual(await keys(), before);
  });

  await check('the part of the wave that was played stays coloured at another scale', async () => {
    /// Waits for another wave than this one, a quarter of which was played.
    const isQuarterPlayed = (before) => until((before) => {
      const wave = document.querySelector('.wave > div');
      return wave !== before && Math.round(parseFloat(wave?.shadowRoot.querySelector('.progress')?.style.width)) === 25;
    }, before);
    await page.evaluate((seconds) => (window.choreo.audio.currentTime = seconds), seconds / 4);
    await isQuarterPlayed(null);
    for (const name of ['Show less of the song', 'Show more of the song']) {
      const before = await page.locator('.wave > div').elementHandle();
      await page.getByRole('button', { name }).click();
      await isQuarterPlayed(before);
    }
    await page.evaluate(() => (window.choreo.audio.currentTime = 0));
  });

  await check('a pose set 0.1 s beside a key stands where it was dropped, in place of that one and unlike it', async () => {
    const before = await keys();
    const { id, frame } = before[2];
    await page.evaluate((id) => window.choreo.hitKey(id, 2), id);
    await settle();
    await page.keyboard.down('Alt');
    await hand.carry(library.nth(1), key(2), 0.1 * (await scale()), async () =>
      assert.deepEqual(await page.locator('.key.replaced').evaluateAll((all) => all.map(({ dataset }) => dataset.key)), [id]));
    await page.keyboard.up('Alt');
    await settle();
    const after = await page.evaluate(() => window.choreo.project.value.keys.map(({ id, frame, hold, hit, hands }) => ({ id, frame, hold, hit, hands })));
    assert.deepEqual(after.map(({ id }) => id).filter((id) => before.every((key) => key.id !== id)), [after[2].id]);
    assert.deepEqual([after.length, after[2].frame, after[2].hold, after[2].hit, after[2].hands], [before.length, frame + 3, 0, null, 0]);
    const { text } = await message();
    assert.ok(text.includes(`in place of ${id.replaceAll('_', ' ')} less than 0.2 s away`) && text.includes('Undo'), text);
    await undo(2);
    assert.deepEqual(await keys(), before);
  });

  await check('so does a key that is moved beside another one, or onto it, and it stays as it was', async () => {
    const before = await keys();
    const [, , other, moved] = before;
    const away = other.frame - moved.frame;
    await page.evaluate((id) => window.choreo.hitKey(id, 2), moved.id);
    await settle();
    const danced = await frames();
    for (const beside of [3, 0]) {
      if (beside) await page.keyboard.down('Alt');
      await hand.drag(key(3), ((away + beside) / 30) * (await scale()));
      await page.keyboard.up('Alt');
      await settle();
      const expected = before.filter(({ id }) => id !== other.id).map((key) => (key.id === moved.id ? { ...key, frame: other.frame + beside } : key));
      assert.deepEqual(await keys(), expected);
      assert.equal(await page.evaluate((id) => window.choreo.keyOf(id).hit, moved.id), 2);
      const { text } = await message();
      assert.ok(text.includes(`in place of ${other.id.replaceAll('_', ' ')}${beside ? ' less than' : ' now'}`) && text.includes('Undo'), text);
      await undo();
    }
    assert.deepEqual(await frames(), danced);
    await undo();
    assert.deepEqual(await keys(), before);
  });

  await check('all keys near a new one make way, but not the one with which the dance begins', async () => {
    const before = await keys();
    const { frame } = before[2];
    const pose = (nth) => page.evaluate((nth) => window.choreo.welcome.value.poses[nth].id, nth);
    const add = async (nth, at) => {
      await page.evaluate(([nth, at]) => window.choreo.addKey(window.choreo.welcome.value.poses[nth], at), [nth, at]);
      await settle();
    };
    await add(1, frame + 8);
    assert.equal((await keys()).length, before.length + 1);
    await add(3, frame + 4);
    assert.equal((await keys()).length, before.length);
    const { text } = await message();
    for (const id of [before[2].id, await pose(1)]) assert.ok(text.includes(id.replaceAll('_', ' ')), text);
    await undo(2);
    await page.evaluate(([first]) => window.choreo.moveKey(first.id, 0), before);
    await settle();
    const begun = await keys();
    await add(1, 3);
    assert.deepEqual((await keys()).map(({ frame }) => frame).slice(0, 2), [0, 3]);
    await undo();
    assert.deepEqual(await keys(), begun);
    for (let back = 0; back < 3 && JSON.stringify(await keys()) !== JSON.stringify(before); ++back) await undo();
    assert.deepEqual(await keys(), before);
  });

  await check('copied keys take the place of those near to them, and keep each other', async () => {
    const before = await keys();
    await key(1).click();
    await page.keyboard.press('Control+c');
    await seek((before[2].frame + 3) / 30);
    await page.keyboard.press('Control+v');
    await settle();
    const after = await keys();
    assert.deepEqual([after.length, after[2].frame], [before.length, before[2].frame + 3]);
    assert.ok((await message()).text.includes(`in place of ${before[2].id.replaceAll('_', ' ')}`), (await message()).text);
    await undo();
    assert.deepEqual(await keys(), before);
  });

  await check('a pose that is pressed while the playhead rests on a key takes its place', async () => {
    const before = await keys();
    await page.locator('.key').nth(1).click();
    await page.locator('.library li button').nth(2).click();
    await settle();
    assert.equal((await keys()).length, before.length);
    assert.match((await message()).text, /Undo/);
    await page.keyboard.press('Control+z');
    await settle();
    assert.deepEqual(await keys(), before);
  });

  await check('a key is set again on the next beat, or at the playhead; undo takes it back', async () => {
    const before = await keys();
    await page.locator('.key').nth(1).click();
    await page.keyboard.press('Control+d');
    await settle();
    const { id, frame } = before[1];
    const [again] = (await keys()).filter((key) => !before.some((old) => old.id === key.id));
    assert.equal(again.id.replace(/-\d+$/, ''), id.replace(/-\d+$/, ''));
    assert.ok(again.frame > frame && again.frame <= frame + 60, `${frame} again at ${again.frame}`);
    await page.keyboard.press('Control+z');
    await settle();
    assert.deepEqual(await keys(), before);
    await page.locator('.key').nth(1).click();
    await page.evaluate((seconds) => (window.choreo.audio.currentTime = seconds), (frame + 10) / 30);
    await page.getByRole('button', { name: 'Duplicate' }).click();
    await settle();
    assert.ok((await keys()).some((key) => key.frame === frame + 10));
    await page.keyboard.press('Control+z');
    await settle();
  });

  await check('the keys of an interval are copied to the playhead, and stand to each other as before', async () => {
    const before = await keys();
    await page.keyboard.press('Escape');
    await page.locator('.interval').nth(0).click();
    await page.keyboard.press('Control+c');
    assert.equal((await message()).text, '2 keys are copied.');
    const at = before.at(-1).frame - 40;
    await page.evaluate((seconds) => (window.choreo.audio.currentTime = seconds), at / 30);
    const placeOf = () => page.evaluate(() => window.choreo.project.value.keys.map(({ id, pose }) => [id, pose.root]));
    const places = new Map(await placeOf());
    await page.keyboard.press('Control+v');
    await settle();
    const added = (await placeOf()).filter(([id]) => !places.has(id)).map(([, root]) => root);
    assert.equal(added.length, 2);
    const apart = ([a, b]) => Math.hypot(a[0] - b[0], a[2] - b[2]);
    const copied = before.slice(0, 2).map(({ id }) => places.get(id));
    assert.ok(Math.abs(apart(added) - apart(copied)) < 1e-3, `${apart(added)}, not ${apart(copied)}`);
    await page.keyboard.press('Control+z');
    await settle();
    assert.deepEqual(await keys(), before);
  });

  await check('a pose is added to the poses, a take is kept: two words for two things', async () => {
    await page.locator('.key').nth(1).click();
    await page.getByRole('button', { name: 'Try 3 more' }).click();
    await page.getByRole('complementary', { name: 'Settings' }).getByRole('button', { name: 'Keep D' }).waitFor();
    const words = async (text) => (await page.getByRole('button').allInnerTexts()).filter((words) => words.startsWith(text));
    assert.ok((await words('Keep')).every((text) => /^Keep [A-D]$/.test(text)), `${await words('Keep')}`);
    await page.getByRole('region', { name: 'Key' }).getByRole('button', { name: 'Add to poses' }).click();
    assert.match((await message()).text, /^Added to the poses as /);
    await page.getByRole('complementary', { name: 'Settings' }).getByRole('button', { name: 'Keep A' }).click();
  });
});
