// Phrases in the studio: chosen on the timeline, mirrored, repeated, copied, taken out.
//   node phrases.test.mjs CHOREO_PROGRAM PICTURES_FOLDER
import assert from 'node:assert/strict';
import { check, clicks, inEachLook, inFolder, patience } from './harness.mjs';

const seconds = 16;

await inEachLook(async ({ page, until, settle, message, scale, frames, give, hand, takeIt, isFirst }) => {
  await give(['clicks.wav', clicks(seconds)]);
  await page.locator('.key').first().waitFor();
  await settle();
  const keys = () => page.evaluate(() => window.choreo.project.value.keys.map(({ id, frame, pose }) => ({ id, frame, root: pose.root, rotations: pose.rotations })));
  const chosen = () => page.evaluate(() => window.choreo.selection.value);
  const press = async (name) => {
    await hand.tap(page.getByRole('region', { name: 'Phrase' }).getByRole('button', { name, exact: true }));
    await settle();
  };
  const undo = async () => {
    await page.evaluate(() => window.choreo.undo());
    await settle();
  };
  const seek = (frame) => page.evaluate((frame) => (window.choreo.audio.currentTime = frame / 30), frame);
  /// Where a second is on the ruler.
  const onRuler = async (at) => {
    const { x, y, width } = await page.locator('.scrubber').boundingBox();
    return [x + 40 + (at * (width - 80)) / seconds, y + 66];
  };
  const beat = (nth) => page.evaluate((nth) => window.choreo.beats.value.list[nth].time, nth);
  const beats = () => page.evaluate(() => window.choreo.beats.value.list.map(({ time }) => Math.round(30 * time)));

  if (isFirst) {
    await check('a phrase is drawn on the ruler with Shift, from beat to beat, and the playhead stays', async () => {
      const before = await page.evaluate(() => window.choreo.audio.currentTime);
      await page.keyboard.down('Shift');
      await page.mouse.move(...(await onRuler((await beat(2)) + 0.03)));
      await page.mouse.down();
      await page.mouse.move(...(await onRuler((await beat(10)) - 0.03)), { steps: 4 });
      await page.mouse.up();
      await page.keyboard.up('Shift');
      assert.deepEqual(await chosen(), [Math.round(30 * (await beat(2))), Math.round(30 * (await beat(10)))]);
      assert.equal(await page.evaluate(() => window.choreo.audio.currentTime), before);
      await page.screenshot({ path: inFolder('phrase.png'), timeout: patience });
    });

    await check('its ends are pulled and moved by arrow keys, and do not pass each other', async () => {
      const [from, to] = await chosen();
      const grip = page.getByRole('slider', { name: 'The phrase ends' });
      await grip.focus();
      await page.keyboard.press('ArrowRight');
      assert.deepEqual(await chosen(), [from, Math.round(30 * (await beat(11)))]);
      await page.keyboard.press('Shift+ArrowLeft');
      assert.deepEqual(await chosen(), [from, Math.round(30 * (await beat(11))) - 1]);
      const { x, y, width, height } = await grip.boundingBox();
      await page.mouse.move(x + width / 2, y + height / 2);
      await page.mouse.down();
      await page.mouse.move(...(await onRuler(await beat(10))), { steps: 3 });
      await page.mouse.up();
      assert.deepEqual(await chosen(), [from, to]);
      for (let i = 0; i < 12; ++i) await page.keyboard.press('ArrowLeft');
      assert.ok((await chosen())[1] > from);
    });

    await check('further intervals are chosen with Shift', async () => {
      await page.keyboard.press('Escape');
      await page.locator('.interval').nth(0).click();
      await page.locator('.interval').nth(2).click({ modifiers: ['Shift'] });
      const list = await keys();
      assert.deepEqual(await chosen(), [list[0].frame, list[3].frame]);
    });
  }

  await check('an eight is chosen by a button', async () => {
    await page.keyboard.press('Escape');
    await seek(70);
    await press('Choose an eight');
    const [from, to] = await chosen();
    assert.ok(from <= 70 && to > 70 && Math.abs(to - from - 120) <= 3, `${from} to ${to}`);
  });

  await check('a phrase ends where its end is pulled', async () => {
    const [from, to] = await chosen();
    const nth = (await beats()).indexOf(to);
    const [, , later] = (await beats()).slice(nth);
    await hand.drag(page.getByRole('slider', { name: 'The phrase ends' }), ((later - to) / 30 - 0.05) * (await scale()));
    assert.deepEqual(await chosen(), [from, later]);
  });

  await check('the timeline shows a phrase as large as fits', async () => {
    await press('Zoom to it');
    const band = await page.locator('i.phrase').boundingBox();
    const view = await page.locator('.timeline .scroll:not([part])').boundingBox();
    assert.ok(band.x >= view.x && band.x + band.width <= view.x + view.width, JSON.stringify({ band, view }));
    assert.ok(band.width > 0.6 * view.width, `${band.width} of ${view.width}`);
    for (let i = 0; i < 5; ++i) await page.getByRole('button', { name: 'Show more of the song' }).click();
  });

  await check('a phrase is mirrored: twice is as before, and no frame behind the next key changes', async () => {
    const [before, danced] = [await keys(), await frames()];
    await press('Mirror');
    const after = await keys();
    const near = (a, b) => a.every((value, i) => Math.abs(value - b[i]) < 1e-4);
    assert.ok(near(after[0].root, before[0].root), 'the dancer begins elsewhere');
    assert.ok([0, 1, 2].some((i) => !near(after[i].rotations, before[i].rotations)));
    // Left hip and right hip change places.
    const side = ({ rotations }, joint) => rotations.slice(3 * joint, 3 * joint + 3);
    for (const i of [0, 1, 2]) {
      const [x, y, z] = side(before[i], 1);
      assert.ok(near(side(after[i], 2), [x, -y, -z]), `key ${i}`);
    }
    assert.deepEqual(after.slice(3), before.slice(3));
    assert.deepEqual((await frames()).slice(before[3].frame), danced.slice(before[3].frame));
    assert.notEqual(await chosen(), null, 'it is chosen no more');
    await press('Mirror');
    (await keys()).forEach((key, i) => assert.ok(near(key.rotations, before[i].rotations) && near(key.root, before[i].root), key.id));
    await undo();
    await undo();
    assert.deepEqual(await keys(), before);
  });

  const chooseFirst = async (count) => {
    await page.keyboard.press('Escape');
    const list = await keys();
    await page.evaluate(([from, to]) => window.choreo.choosePhrase(from, to), [list[0].frame, list[count].frame]);
    return list;
  };

  await check('with another ending it waits for a pose, which becomes that', async () => {
    const before = await chooseFirst(3);
    const length = before[3].frame - before[0].frame;
    await press('Repeat with another ending');
    assert.match((await message()).text, /press a pose/);
    await hand.tap(page.locator('.library li button').nth(3));
    await settle();
    const again = (await keys()).filter(({ frame }) => frame >= before[3].frame && frame < before[3].frame + length);
    assert.equal(again.length, 3);
    assert.ok(Math.abs(again[2].frame - before[2].frame - length) <= 1);
    assert.notEqual(again[2].id.replace(/-\d+$/, ''), before[2].id.replace(/-\d+$/, ''));
    await undo();
    await undo();
    assert.deepEqual(await keys(), before);
  });

  await check('it goes in half and in double time; what is behind it stays', async () => {
    const before = await chooseFirst(3);
    const danced = await frames();
    const [begin, end] = [before[0].frame, before[3].frame];
    await press('Half time');
    const half = await keys();
    before.slice(0, 3).forEach(({ id, frame, root, rotations }, i) => {
      const { frame: to, ...rest } = half[i];
      assert.deepEqual(rest, { id, root, rotations });
      assert.ok(Math.abs(to - begin - 2 * (frame - begin)) <= 1, `${frame} to ${to}`);
    });
    const stay = before.filter(({ frame }) => frame >= begin + 2 * (end - begin));
    assert.ok(stay.length > 0 && stay.length < before.length - 3, 'nothing made way');
    assert.deepEqual(half.slice(3), stay);
    assert.deepEqual((await frames()).slice(stay[0].frame), danced.slice(stay[0].frame));
    await press('Double time');
    assert.deepEqual((await keys()).slice(0, 3), before.slice(0, 3));
    await undo();
    await undo();
    assert.deepEqual(await keys(), before);
    await page.keyboard.press('Escape');
    await press('Choose all');
    await press('Half time');
    assert.match((await message()).text, /keys would come behind the end/);
    await undo();
  });

  await chooseFirst(3);
  await page.evaluate(() => (window.choreo.message.value = null));
  await takeIt('phrase-');

  if (!isFirst) return;

  await page.keyboard.press('Escape');
  await check('a phrase comes again right after itself; what stood there makes way', async () => {
    const before = await chooseFirst(3);
    const length = before[3].frame - before[0].frame;
    await press('Repeat');
    const after = await keys();
    const again = after.filter(({ frame }) => frame >= before[3].frame && frame < before[3].frame + length);
    assert.deepEqual(again.map(({ id }) => id.replace(/-\d+$/, '')), before.slice(0, 3).map(({ id }) => id.replace(/-\d+$/, '')));
    again.forEach(({ frame }, i) => assert.ok(Math.abs(frame - before[i].frame - length) <= 1, `${frame}`));
    assert.deepEqual(after.slice(0, 3), before.slice(0, 3));
    const [from] = await chosen();
    assert.ok(Math.abs(from - before[3].frame) <= 1, 'the repetition is chosen');
    await undo();
  });

  await check('its keys are copied to the playhead, taken out, and come back', async () => {
    const before = await chooseFirst(3);
    await press('Copy');
    assert.equal((await message()).text, '3 keys are copied.');
    await seek(before.at(-1).frame + 20);
    await press('Paste at playhead');
    assert.equal((await keys()).length > before.length, true);
    await undo();
    await chooseFirst(3);
    await press('Remove keys');
    assert.deepEqual(await keys(), before.slice(3));
    await undo();
    await chooseFirst(3);
    await page.locator('.scrubber').focus();
    await page.keyboard.press('Delete');
    await settle();
    assert.deepEqual(await keys(), before.slice(3));
    await undo();
    assert.deepEqual(await keys(), before);
  });

  await check('takes of a phrase go through its keys, and are whole', async () => {
    const before = await chooseFirst(3);
    const danced = await frames();
    await page.getByRole('button', { name: 'Try 3 more' }).click();
    await until(() => window.choreo.takes.value.length === 3 && window.choreo.busy.value === 0);
    const takes = await page.evaluate(() => window.choreo.takes.value.map(({ motion }) => Array.from({ length: motion.count }, (_, frame) => JSON.stringify(motion.pose(frame)))));
    for (const take of takes) {
      assert.equal(take.length, danced.length);
      assert.deepEqual(take.slice(before[3].frame), danced.slice(before[3].frame));
      for (const { frame, root } of before.slice(1, 3)) {
        const there = JSON.parse(take[frame]).root;
        assert.ok(Math.hypot(there[0] - root[0], there[2] - root[2]) < 0.002, `at ${frame}`);
      }
    }
    assert.equal(new Set(takes.map((take) => take[before[1].frame + 10])).size, 3);
    await page.keyboard.press('Escape');
  });
});
