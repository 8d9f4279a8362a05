// The studio on a phone: what is needed is seen at once, and nothing is cut off.
//   node phone.test.mjs CHOREO_PROGRAM PICTURES_FOLDER
import assert from 'node:assert/strict';
import { check, clicks, finger, inFolder, inStudio, patience, takePictures } from './harness.mjs';

await inStudio(async ({ page, until, settle, give }) => {
  await until(() => window.choreo?.isConnected.value);
  await page.setViewportSize({ width: 390, height: 844 });
  await give(['clicks.wav', clicks(8)]);
  await page.locator('.key').first().waitFor();
  await settle();
  /// The middles of what is in a row, pixels from above.
  const heights = (row) => page.locator(row).evaluate((at) => [...at.querySelectorAll('.name, button, select, output')]
    .filter((part) => part.checkVisibility()).map((part) => part.getBoundingClientRect()).map(({ top, bottom }) => Math.round((top + bottom) / 2)));

  for (const width of [390, 360]) {
    await page.setViewportSize({ width, height: 844 });
    for (const [what, row] of [['the bar', 'header'], ['what plays', '.transport']]) {
      await check(`at ${width} pixels ${what} takes one row`, async () => {
        const all = await heights(row);
        assert.ok(all.length >= 5);
        assert.ok(Math.max(...all) - Math.min(...all) <= 2, `${all}`);
      });
    }
    await check(`at ${width} pixels "Export …" is read in full`, async () => {
      const [room, needed] = await page.getByLabel('Export the dance').evaluate((select) => {
        const { font, paddingLeft, paddingRight } = getComputedStyle(select);
        const pen = document.createElement('canvas').getContext('2d');
        pen.font = font;
        const arrow = 18;
        return [select.clientWidth, pen.measureText('Export …').width + parseFloat(paddingLeft) + parseFloat(paddingRight) + arrow];
      });
      assert.ok(room >= needed, `${room} pixels for ${needed}`);
    });
  }

  await check('poses are seen without scrolling', async () => {
    await page.setViewportSize({ width: 390, height: 844 });
    const { y, height } = await page.locator('.library li button').first().boundingBox();
    assert.ok(y + height <= 844, `they end at ${y + height}`);
    const stage = await page.locator('.stage').boundingBox();
    assert.ok(stage.height >= 300, `the stage is ${stage.height} high`);
  });

  await check('the names of four takes stand beside each other', async () => {
    await page.locator('.interval').first().click();
    await page.getByRole('button', { name: 'Try 3 more' }).click();
    await until(() => document.querySelectorAll('.mark').length === 4);
    await page.evaluate(() => scrollTo(0, 0));
    let boxes = [];
    const isGood = () => boxes.every(({ left, right, height }, i) => left >= 0 && right <= 390 && height < 60 && (i === 0 || left >= boxes[i - 1].right));
    for (let i = 0; i < 40 && (i === 0 || !isGood()); ++i) { // the camera goes there
      await page.waitForTimeout(500);
      boxes = await page.locator('.mark').evaluateAll((marks) => marks.map((mark) => mark.getBoundingClientRect()).map(({ left, right, height }) => ({ left, right, height })));
    }
    assert.ok(isGood(), JSON.stringify(boxes));
    await page.screenshot({ path: inFolder('phone-takes.png'), timeout: patience });
    await page.getByRole('main').getByRole('button', { name: 'Keep A' }).click();
  });

  await check('a finger marks a moment, holds and hits a key, adds a dancer, chooses an eight, and mirrors it', async () => {
    const { tap, drag } = await finger(page);
    const project = () => page.evaluate(() => window.choreo.project.value);
    const press = async (region, name) => {
      await tap(page.getByRole('region', { name: region }).getByRole('button', { name, exact: true }));
      await settle();
    };
    await page.evaluate(() => (window.choreo.selection.value = null));
    await tap(page.locator('.key').nth(1));
    await until(() => window.choreo.selectedKey.value === window.choreo.project.value.keys[1].id);
    await press('Markers', 'Mark the playhead');
    assert.deepEqual((await project()).markers.map(({ frame }) => frame), [(await project()).keys[1].frame]);
    await drag(page.getByRole('slider', { name: /^How long key/ }), 80);
    await until(() => window.choreo.project.value.keys[1].hold > 0);
    await settle();
    await drag(page.getByRole('slider', { name: /^How hard key/ }), -40);
    await until(() => window.choreo.project.value.keys[1].hit > 0);
    await settle();
    await press('Dancers', 'Add a dancer');
    assert.equal((await project()).dancers.length, 2);
    await press('Phrase', 'Choose an eight');
    const phrase = await page.evaluate(() => window.choreo.selection.value);
    const { keys } = await project();
    const chosen = keys.filter(({ frame }) => frame >= phrase[0] && frame < phrase[1]);
    assert.ok(chosen.length > 0);
    await press('Phrase', 'Mirror');
    const now = (await project()).keys;
    keys.forEach((key, i) => (chosen.includes(key) ? assert.notDeepEqual : assert.deepEqual)(now[i].pose.rotations, key.pose.rotations));
  });

  await takePictures(page, 'phone-');
});
