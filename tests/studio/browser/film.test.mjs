// Films and views in the studio: the dance with its song as a film, opened again; onion skin.
//   node film.test.mjs CHOREO_PROGRAM PICTURES_FOLDER
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { copyFileSync, readFileSync } from 'node:fs';
import { check, clicks, inFolder, inStudio, takePictures } from './harness.mjs';

const seconds = 3;

await inStudio(async ({ page, until, settle, message, give, download }) => {
  await give(['clicks.wav', clicks(seconds)]);
  await page.locator('.key').first().waitFor();
  await settle();

  for (const kind of ['webm', 'mp4']) {
    await check(`a film as ${kind} has every picture, and the song`, async () => {
      const path = inFolder(`dance.${kind}`);
      copyFileSync(await download(() => page.getByLabel('Export the dance').selectOption(kind)), path);
      const { streams, format } = JSON.parse(execFileSync('ffprobe', ['-v', 'error', '-count_frames', '-show_streams', '-show_format', '-of', 'json', path]));
      const [video, audio] = ['video', 'audio'].map((type) => streams.find(({ codec_type }) => codec_type === type));
      assert.equal(Number(video.nb_read_frames), 30 * seconds);
      assert.deepEqual([video.width, video.height], [1280, 720]);
      assert.ok(Math.abs(format.duration - seconds) < 0.1, `${format.duration} s`);
      assert.ok(audio, 'it is silent');
      // The loudest moments are the song's clicks, each half a second: picture and sound begin together.
      const pcm = execFileSync('ffmpeg', ['-v', 'error', '-i', path, '-map', 'a', '-ac', '1', '-ar', '8000', '-f', 's16le', '-'], { maxBuffer: 1e8 });
      const samples = new Int16Array(pcm.buffer, pcm.byteOffset, pcm.length / 2);
      const onset = samples.findIndex((value, i) => i > 2000 && Math.abs(value) > 8000) / 8000;
      console.log(`    ${video.codec_name} with ${audio.codec_name}, ${(readFileSync(path).length / 2 ** 20).toFixed(1)} MiB; the click of 0.5 s sounds at ${onset.toFixed(3)} s`);
      assert.ok(Math.abs(onset - 0.5) < 0.03);
      // The dancer moves: the pictures differ.
      const picture = (at) => execFileSync('ffmpeg', ['-v', 'error', '-ss', String(at), '-i', path, '-frames:v', '1', '-vf', 'scale=160:90', '-f', 'rawvideo', '-pix_fmt', 'gray', '-']);
      const [first, later] = [picture(0.5), picture(2)];
      const changed = first.filter((value, i) => Math.abs(value - later[i]) > 20).length;
      assert.ok(changed > 100 && changed < 7000, `${changed} of 14400 pixels differ`);
    });
  }

  await check('a film in the making says how long it still takes', async () => {
    let isMade = false;
    const made = download(() => page.getByLabel('Export the dance').selectOption('webm')).finally(() => (isMade = true));
    const said = new Set();
    for (; !isMade; await page.waitForTimeout(100)) said.add(await page.evaluate(() => document.querySelector('.filming')?.textContent ?? ''));
    await made;
    assert.ok([...said].some((text) => /^filming … \d+ %, (about \d+ (s|min)|a few seconds) left/.test(text)), [...said].join(' | '));
  });

  await check('a film plays in a browser', async () => {
    const base64 = readFileSync(inFolder('dance.webm')).toString('base64');
    const length = await page.evaluate(async (base64) => {
      const video = document.createElement('video');
      video.src = URL.createObjectURL(new Blob([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))], { type: 'video/webm' }));
      await new Promise((resolve, reject) => ([video.onloadeddata, video.onerror] = [resolve, () => reject(new Error('it cannot be opened'))]));
      return video.duration;
    }, base64);
    assert.ok(Math.abs(length - seconds) < 0.1);
  });

  await check('the stage is back as it was, and a film may be left off', async () => {
    const size = () => page.evaluate(() => {
      const { width, clientWidth } = document.querySelector('.stage canvas');
      return width / clientWidth;
    });
    await until(() => document.querySelector('.stage canvas').width !== 1280);
    assert.ok((await size()) <= 2);
    await page.getByLabel('Export the dance').selectOption('webm');
    await page.getByRole('button', { name: 'Cancel' }).click();
    await until(() => window.choreo.filming.value === null);
    assert.equal((await message()).text, 'The film was cancelled.');
    await page.evaluate(() => (window.choreo.message.value = null));
  });

  await check('onion skin shows the keys around, or the frames', async () => {
    await page.evaluate(() => (window.choreo.audio.currentTime = 1.5));
    const skins = () => page.evaluate(() => window.choreo.stage.value.onion.scene.children.filter(({ visible }) => visible).length);
    const wait = (count) => until((count) => window.choreo.stage.value.onion.scene.children.filter(({ visible }) => visible).length === count, count);
    assert.equal(await skins(), 0);
    const group = page.getByRole('group', { name: 'Onion skin' });
    await group.getByRole('button', { name: 'Frames', exact: true }).click();
    await wait(6);
    await page.waitForTimeout(1500);
    await page.screenshot({ path: inFolder('onion-frames.png') });
    await group.getByRole('button', { name: 'Keys', exact: true }).click();
    await wait(2);
    await takePictures(page, 'onion-');
      await group.getByRole('button', { name: 'No onion skin' }).click();
    await wait(0);
  });
});
