// Takes in the studio, side by side: all of them are seen, and which is which.
//   node takes.test.mjs CHOREO_PROGRAM PICTURES_FOLDER
import assert from 'node:assert/strict';
import { check, clicks, inEachLook } from './harness.mjs';

const seconds = 12;

await inEachLook(async ({ page, until, settle, give, hand, takeIt, isPhone, isFirst }) => {
  await give(['clicks.wav', clicks(seconds)]);
  await page.locator('.key').first().waitFor();
  await settle();
  const settings = page.getByRole('complementary', { name: 'Settings' });
  const tryTakes = async () => {
    await hand.tap(page.getByRole('button', { name: 'Try 3 more' }));
    await until((count) => window.choreo.takes.value.length === 3 && window.choreo.takes.value.every(({ motion }) => motion.count >= count), 30 * seconds);
    await settle();
    if (isPhone) await page.evaluate(() => scrollTo(0, 0));
  };
  const keepA = (where) => hand.tap(where.getByRole('button', { name: 'Keep A' }));
  const seek = (frame) => page.evaluate((frame) => (window.choreo.audio.currentTime = frame / 30), frame);
  /// Where the dancers' joints are, as shares of the stage: 0 to 1.
  const seen = () => page.evaluate(() => {
    const { doll, others, camera } = window.choreo.stage.value;
    return [doll, ...others.dolls].map((one) => one.bones.map((bone) => {
      const place = bone.getWorldPosition(bone.position.clone()).project(camera);
      return [(place.x + 1) / 2, (1 - place.y) / 2];
    }));
  });
  /// The same of their names' corners.
  const named = () => page.evaluate(() => {
    const stage = document.querySelector('.stage').getBoundingClientRect();
    return [...document.querySelectorAll('.mark')].map((mark) => mark.getBoundingClientRect()).map(({ left, right, top, bottom }) =>
      [[(left - stage.left) / stage.width, (top - stage.top) / stage.height], [(right - stage.left) / stage.width, (bottom - stage.top) / stage.height]]);
  });
  /// Waits for the camera until all are there, and their names stand beside each other.
  const areOnStage = async (when) => {
    let [away, covered] = [['not there'], ''];
    for (let i = 0; i < 120; ++i) {
      await page.waitForTimeout(500);
      const places = await seen();
      if (places.length < 4) continue;
      const names = await named();
      away = [...'ABCD'].filter((_, take) => [...places[take], ...(names[take] ?? [[2, 2]])].flat().some((share) => share < 0 || share > 1));
      covered = [...'BCD'].filter((_, take) => names[take + 1]?.[0][0] < names[take]?.[1][0]).join();
      if (away.length === 0 && !covered) break;
    }
    assert.deepEqual(away, [], `${when}: off the stage`);
    assert.equal(covered, '', `${when}: names on each other`);
  };

  await check('all four takes are on the stage, and their names beside each other', async () => {
    await tryTakes();
    for (const frame of isFirst ? [0, 80, 160, 240, 355] : [0, 240]) {
      await seek(frame);
      await areOnStage(`frame ${frame}`);
    }
    await keepA(page.getByRole('main'));
  });

  if (isFirst) {
    await check('so are they where the camera does not follow', async () => {
      await page.getByLabel('The camera follows').uncheck();
      await seek(200);
      await tryTakes();
      await areOnStage('without the following camera');
      await keepA(settings);
      await page.getByLabel('The camera follows').check();
    });
  }

  await check('takes of an interval are first seen where they differ, not at the key that they share', async () => {
    await hand.tap(page.locator('.interval').nth(1));
    const [from, to] = await page.evaluate(() => window.choreo.selection.value);
    await tryTakes();
    const frame = await page.evaluate(() => Math.round(window.choreo.audio.currentTime * 30));
    assert.ok(frame > from && frame < to, `they are seen at ${frame}, between ${from} and ${to}`);
    const poses = await page.evaluate((frame) => [window.choreo.motion.value, ...window.choreo.takes.value.map(({ motion }) => motion)]
      .map((motion) => JSON.stringify(motion.pose(frame))), frame);
    assert.equal(new Set(poses).size, 4);
  });

  await check('each take has a colour of its own, at a key as well, and its buttons have it, too', async () => {
    const [from] = await page.evaluate(() => window.choreo.selection.value);
    await seek(from);
    await areOnStage('at a key');
    await takeIt('takes-');
    const shirts = await page.evaluate(() => {
      const { doll, others } = window.choreo.stage.value;
      return [doll, ...others.dolls].map(({ scene }) => {
        const colours = [];
        scene.traverse(({ material }) => material && colours.push(material.color.getHexString()));
        return colours.join();
      });
    });
    assert.equal(new Set(shirts).size, 4, `${shirts}`);
    const dots = (within) => within.getByRole('button', { name: /^Keep [A-D]$/ }).evaluateAll((buttons) => buttons.map((button) => getComputedStyle(button, '::before').backgroundColor));
    for (const within of [settings, page.getByRole('main')]) assert.equal(new Set(await dots(within)).size, 4, `${await dots(within)}`);
    assert.deepEqual(await dots(settings), await dots(page.getByRole('main')));
  });
});
