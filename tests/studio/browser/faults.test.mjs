// What looks wrong in a dance: marks on the timeline and a list beside the stage, a press on which goes there.
//   node faults.test.mjs CHOREO_PROGRAM PICTURES_FOLDER
import assert from 'node:assert/strict';
import { check, clicks, inStudio, takePictures } from './harness.mjs';

const [raised, lowered, sunk] = [60, 120, 150]; // frames

await inStudio(async ({ page, until, settle, scale, give }) => {
  await until(() => window.choreo?.isConnected.value);
  await give(['clicks.wav', clicks(8)]);
  await page.locator('.key').first().waitFor();
  await settle();
  const panel = page.getByRole('region', { name: 'Faults' });
  const known = () => until(() => window.choreo.faults.value !== null);
  const faults = () => page.evaluate(() => window.choreo.faults.value);
  const now = () => page.evaluate(() => Math.round(window.choreo.audio.currentTime * 30));
  await known();
  const before = await faults();

  await check('a dance says what looks wrong in it, or that nothing does', async () => {
    assert.equal(await page.locator('.fault').count(), before.length);
    assert.match(await panel.locator('h2').textContent(), new RegExp(before.length ? `${before.length}$` : 'none found$'));
  });

  await check('a body that hangs in the air and sinks into the floor is found', async () => {
    await page.evaluate(([raised, lowered, sunk]) => {
      const { motion, project, keepTake } = window.choreo;
      const changed = motion.value.head(motion.value.count);
      for (let frame = raised; frame < lowered; ++frame) changed.roots[3 * frame + 1] += 0.5;
      for (let frame = sunk; frame < sunk + 30; ++frame) changed.roots[3 * frame + 1] -= 0.3;
      keepTake({ seed: project.value.seed, motion: changed });
    }, [raised, lowered, sunk]);
    await settle();
    await known();
    const floats = (await faults()).find(({ text }) => text.includes('floats'));
    assert.ok(floats.from >= raised - 1 && floats.from <= raised + 1 && floats.to >= lowered - 2 && floats.to <= lowered, JSON.stringify(floats));
    assert.ok((await faults()).some(({ from, text }) => text.includes('under the floor') && from >= sunk - 1 && from <= sunk + 1));
  });

  await check('its marks stand at their times, and a press on one goes there', async () => {
    const mark = page.locator('.fault[title*="floats"]').first();
    const { x, width } = await mark.boundingBox();
    const key = await page.locator('.key').first().evaluate((at) => at.getBoundingClientRect().x + at.getBoundingClientRect().width / 2);
    const [pixels, first] = [await scale(), await page.evaluate(() => window.choreo.project.value.keys[0].frame)];
    assert.ok(Math.abs(x - key - (pixels * (raised - first)) / 30) < 6, `${x}`);
    assert.ok(Math.abs(width - 2 * pixels) < 6, `${width} pixels for two seconds of ${pixels}`);
    await mark.click();
    assert.ok(Math.abs((await now()) - raised) <= 1, `${await now()}`);
  });

  await check('the list goes there by keyboard', async () => {
    await panel.getByRole('button', { name: /under the floor/ }).first().focus();
    await page.keyboard.press('Enter');
    assert.ok(Math.abs((await now()) - sunk) <= 1, `${await now()}`);
  });

  await takePictures(page, 'faults-');

  await check('undo takes them back', async () => {
    await page.keyboard.press('Control+z');
    await settle();
    await known();
    assert.deepEqual(await faults(), before);
  });
});
