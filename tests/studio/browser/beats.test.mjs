// Beats in the studio: the ruler counts them, what comes back in a song wears its colour, and the choreographer has the last word.
//   node beats.test.mjs CHOREO_PROGRAM PICTURES_FOLDER
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { check, inFolder, inStudio, patience, program, song, takePictures } from './harness.mjs';

const isSame = (one, other) => JSON.stringify(one) === JSON.stringify(other);

await inStudio(async ({ page, until, settle, message, frames, give, download }) => {
  await until(() => window.choreo?.isConnected.value);
  await page.setViewportSize({ width: 1600, height: 1000 });
  await give(['aba.wav', song('ABA')]);
  await page.locator('.key').first().waitFor();
  await settle();
  const press = (name) => page.getByRole('button', { name }).click();
  const beats = () => page.evaluate(() => window.choreo.beats.value.list.map(({ time, count }) => [time, count]));
  const said = () => page.evaluate(() => window.choreo.project.value.beats?.list.length ?? null);
  const tempo = () => page.locator('section[aria-label=Beats] small').innerText();
  const seek = (seconds) => page.evaluate((seconds) => (window.choreo.audio.currentTime = seconds), seconds);

  await check('the ruler counts to eight where there is room, and bars are seen', async () => {
    const texts = await page.locator('.beat').allInnerTexts();
    assert.match(texts.join(''), /^[1-8]*?(12345678){8}/);
    assert.deepEqual(await page.locator('.beat.down').allInnerTexts(), texts.filter((text) => text === '1' || text === '5'));
    for (let i = 0; i < 6; ++i) await press('Show more of the song');
    const few = (await page.locator('.beat').allInnerTexts()).filter(Boolean);
    assert.ok(few.length > 5 && few.every((text) => text === '1'), few.join(''));
    for (let i = 0; i < 6; ++i) await press('Show less of the song');
  });

  await check('how much beats stand out', async () => {
    assert.match(await tempo(), /^120\.\d a minute, they stand out by \d\d %$/);
    assert.match(await page.locator('.beat').nth(4).getAttribute('title'), /^A beat: around it they stand out by \d\d %$/);
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

  await check('beats are halved, doubled and nudged; undo takes it back', async () => {
    const heard = await beats();
    const before = await frames();
    await press('Halve');
    await settle();
    assert.equal(await tempo(), '60.0 a minute');
    assert.equal((await beats()).length, Math.ceil(heard.length / 2));
    assert.ok(!isSame(await frames(), before), 'the same dance');
    await press('Double');
    await press('Double');
    await settle();
    assert.equal(await tempo(), '240.0 a minute');
    // No faster than double time of the fastest tempo.
    await press('Double');
    assert.equal((await message()).text, '480 beats a minute, must be 25 to 400.');
    assert.equal(await tempo(), '240.0 a minute');
    for (let i = 0; i < 3; ++i) await page.keyboard.press('Control+z');
    await settle();
    assert.equal(await said(), null);
    assert.ok(isSame(await frames(), before), 'another dance');
    await press('Beats 10 ms later');
    await press('Beats 10 ms later');
    assert.ok(Math.abs((await beats())[4][0] - heard[4][0] - 0.02) < 1e-3);
    await press('As heard');
    await settle();
    assert.deepEqual(await beats(), heard);
    assert.ok(isSame(await frames(), before), 'another dance');
  });

  await check('a beat is a 1, and no frame changes', async () => {
    const before = await frames();
    const [time] = (await beats())[6];
    await seek(time + 0.05);
    await press('This is 1');
    await settle();
    assert.deepEqual((await beats())[6], [Math.round(time * 1e4) / 1e4, 1]);
    assert.ok(isSame(await frames(), before), 'another dance');
  });

  await check('taps along are the beats, by key and by button', async () => {
    const heard = await beats();
    await seek(2);
    await press('Tap'); // which plays
    await until(() => !window.choreo.audio.paused);
    // On every second beat. Hands wait for the sound, which a busy machine does not do: it waits for them.
    for (let i = 0; i < 6; ++i) {
      await page.evaluate(([seconds, byKey]) => {
        window.choreo.audio.currentTime = seconds;
        if (byKey) document.body.dispatchEvent(new KeyboardEvent('keydown', { key: 't', bubbles: true }));
        else document.querySelector('section[aria-label=Beats] button').click();
      }, [heard[6 + 2 * i][0] + 0.02 * (i % 3), i % 2 === 1]);
    }
    await page.screenshot({ path: inFolder('tapping.png'), timeout: patience });
    await until(() => window.choreo.taps.value.length === 0); // the hand rests
    await page.evaluate(() => window.choreo.audio.pause());
    await settle();
    assert.match((await message()).text, /^60 beats a minute, of 6 taps/);
    const now = await beats();
    assert.equal(now[1][0] - now[0][0], 1);
    await page.keyboard.press('Control+z');
    await settle();
    assert.deepEqual(await beats(), heard);
  });

  await check('a project keeps its beats, and the command line dances on them as the page does', async () => {
    await press('Beats 10 ms earlier');
    await settle();
    const before = await beats();
    const text = readFileSync(await download(() => press('Save')), 'utf8');
    await press('As heard');
    await settle();
    const count = await page.evaluate(() => window.choreo.moments.value.length);
    await give(['aba.json', text]);
    await until((count) => window.choreo.moments.value.length > count, count);
    await settle();
    assert.deepEqual(await beats(), before);
    const here = readFileSync(await download(() => page.getByLabel('Export the dance').selectOption('bvh')), 'utf8');
    writeFileSync(inFolder('aba.wav'), song('ABA'));
    writeFileSync(inFolder('aba.json'), text);
    execFileSync(program, ['dance', '--project', inFolder('aba.json'), '--out', inFolder('aba.bvh')], { stdio: 'ignore' });
    assert.ok(readFileSync(inFolder('aba.bvh'), 'utf8') === here, 'the command line dances it otherwise');
  });

  await takePictures(page, 'beats-');
});
