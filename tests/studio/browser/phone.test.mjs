// The studio on a phone: what is needed is seen at once, and nothing is cut off.
//   node phone.test.mjs CHOREO_PROGRAM PICTURES_FOLDER
import assert from 'node:assert/strict';
import { check, clicks, inStudio } from './harness.mjs';

await inStudio(async ({ page, until, settle, give }) => {
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
});
