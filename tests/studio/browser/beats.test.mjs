// Beats in the studio: the ruler counts them, and what comes back in a song wears its colour.
//   node beats.test.mjs CHOREO_PROGRAM PICTURES_FOLDER
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { check, inStudio, song, takePictures } from './harness.mjs';

const isSame = (one, other) => JSON.stringify(one) === JSON.stringify(other);

await inStudio(async ({ page, until, settle, frames, give, download }) => {
  await until(() => window.choreo?.isConnected.value);
  await page.setViewportSize({ width: 1600, height: 1000 });
  await give(['aba.wav', song('ABA')]);
  await page.locator('.key').first().waitFor();
  await settle();
  const press = (name) => page.getByRole('button', { name }).click();

  await check('the ruler counts to eight where there is room, and bars are seen', async () => {
    const texts = await page.locator('.beat').allInnerTexts();
    assert.match(texts.join(''), /^[1-8]*?(12345678){8}/);
    assert.equal(await page.locator('.beat.down').count(), Math.round(texts.length / 4));
    for (let i = 0; i < 6; ++i) await press('Show more of the song');
    const few = (await page.locator('.beat').allInnerTexts()).filter(Boolean);
    assert.ok(few.length > 5 && few.every((text) => text === '1'), few.join(''));
    for (let i = 0; i < 6; ++i) await press('Show less of the song');
  });

  await check('the part that comes back has the letter and colour of the first one', async () => {
    const sections = await page.locator('.section').evaluateAll((all) => all.map((at) => [at.textContent, getComputedStyle(at).borderTopColor, at.title]));
    assert.deepEqual(sections.map(([letter]) => letter), ['A', 'A']);
    assert.equal(sections[0][1], sections[1][1]);
    assert.match(sections[1][2], /^A: alike at 0:0\d\.\d$/);
  });

  await check('energy and variation are asked for, kept, and danced', async () => {
    const before = await frames();
    for (const [name, value] of [['energy', '1'], ['variation', '0']]) {
      await page.getByLabel(name).fill(value);
      await settle();
    }
    const { dynamics, variation } = await page.evaluate(() => window.choreo.project.value);
    assert.deepEqual([dynamics, variation], [1, 0]);
    assert.ok(!isSame(await frames(), before), 'the same dance');
    const project = JSON.parse(readFileSync(await download(() => press('Save')), 'utf8'));
    assert.deepEqual([project.music_dynamics, project.variation, project.beats], [1, 0, undefined]);
  });

  await takePictures(page, 'beats-');
});
