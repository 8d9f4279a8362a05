// Films and views in the studio: the dance with its song as a film, opened again; onion skin. FILM_SECONDS=30 makes the first films as long.
//   node film.test.mjs CHOREO_PROGRAM PICTURES_FOLDER
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { copyFileSync, readFileSync } from 'node:fs';
import { check, clicks, inEachLook, inFolder, takePictures } from './harness.mjs';

const ffmpeg = (...args) => execFileSync('ffmpeg', ['-v', 'error', ...args], { maxBuffer: 1e8 });
const [width, height] = [1280, 720];

await inEachLook(async ({ page, until, settle, message, give, download, hand, takeIt, isFirst, isPhone, isDark, name }) => {
  const seconds = Number((isFirst && process.env.FILM_SECONDS) || 3);
  await give(['clicks.wav', clicks(seconds)]);
  await page.locator('.key').first().waitFor();
  await settle();

  const session = await page.context().browser().newBrowserCDPSession();
  /// Seconds of processor time that the browser took so far.
  const spent = async () => (await session.send('SystemInfo.getProcessInfo')).processInfo.reduce((sum, { cpuTime }) => sum + cpuTime, 0);
  /// Makes a film, and reads what the page says meanwhile.
  const film = async (kind) => {
    const [began, before] = [Date.now(), await spent()];
    let isMade = false;
    const made = download(() => page.getByLabel('Export the dance').selectOption(kind)).finally(() => (isMade = true));
    const said = new Set();
    for (; !isMade; await page.waitForTimeout(200)) said.add(await page.evaluate(() => document.querySelector('.filming')?.textContent ?? ''));
    const path = inFolder(`dance-${name}.${kind}`);
    copyFileSync(await made, path);
    const [took, busy] = [(Date.now() - began) / 1000, (await spent()) - before];
    console.log(`    ${seconds} s of ${width} × ${height} with the song took ${took.toFixed(1)} s as ${kind}, and ${busy.toFixed(0)} s of processor time`);
    const { streams, format } = JSON.parse(execFileSync('ffprobe', ['-v', 'error', '-count_frames', '-show_streams', '-show_format', '-of', 'json', path]));
    const [video, audio] = ['video', 'audio'].map((type) => streams.find(({ codec_type }) => codec_type === type));
    assert.equal(Number(video.nb_read_frames), 30 * seconds);
    assert.deepEqual([video.width, video.height], [width, height]);
    assert.ok(Math.abs(format.duration - seconds) < 0.1, `${format.duration} s`);
    assert.ok(audio, 'it is silent');
    return { path, said: [...said], codecs: `${video.codec_name} with ${audio.codec_name}` };
  };
  /// A picture of a film, a byte a pixel.
  const picture = (path, at) => ffmpeg('-ss', String(at), '-i', path, '-frames:v', '1', '-f', 'rawvideo', '-pix_fmt', 'gray', '-');
  const isLeftTold = (said) => assert.ok(said.some((text) => /^filming … \d+ %, (about \d+ (s|min)|a few seconds) left/.test(text)), said.join(' | '));

  await check('a film has every picture, looks as the stage does, and says how long it still takes', async () => {
    const { path, said } = await film('webm');
    isLeftTold(said);
    const [first, later] = [0.5, 2].map((at) => picture(path, at));
    // The dancer moves, and little else.
    const changed = first.filter((value, i) => Math.abs(value - later[i]) > 20).length;
    assert.ok(changed > 0.007 * first.length && changed < 0.5 * first.length, `${changed} of ${first.length} pixels differ`);
    assert.equal(first[0] < 128, isDark, `its corner is ${first[0]}`);
    ffmpeg('-y', '-ss', '1.5', '-i', path, '-frames:v', '1', inFolder(`film-${name}.png`));
  });

  if (isDark && !isPhone) {
    await check('a film of several dancers has all of them', async () => {
      await hand.tap(page.getByRole('button', { name: 'Add a dancer' }));
      await settle();
      await until(() => window.choreo.formation.value?.of === window.choreo.moment.value);
      await page.evaluate(() => {
        const stage = window.choreo.stage.value;
        const draw = stage.picture;
        stage.picture = (...args) => {
          const canvas = draw.apply(stage, args);
          if (Math.abs(args[1] - 1.5) < 0.01) {
            window.filmed = [stage.doll, ...stage.company.dolls].filter(({ scene }) => scene.visible)
              .map(({ bones }) => bones[0].getWorldPosition(bones[0].position.clone()).project(stage.camera)).map(({ x, y }) => [(x + 1) / 2, (1 - y) / 2]);
          }
          return canvas;
        };
      });
      const { path } = await film('webm');
      const there = picture(path, 1.5);
      ffmpeg('-y', '-ss', '1.5', '-i', path, '-frames:v', '1', inFolder('film-company.png'));
      /// How much pixels differ around a place.
      const contrast = ([x, y]) => {
        const values = [];
        for (let row = Math.round(y * height) - 40; row < y * height + 40; ++row)
          for (let column = Math.round(x * width) - 30; column < x * width + 30; ++column) values.push(there[row * width + column]);
        const mean = values.reduce((sum, value) => sum + value, 0) / values.length;
        return Math.sqrt(values.reduce((sum, value) => sum + (value - mean) ** 2, 0) / values.length);
      };
      const places = await page.evaluate(() => window.filmed);
      assert.equal(places.length, 2);
      console.log(`    where they stand pixels differ by ${places.map(contrast).map(Math.round)}, beside by ${Math.round(contrast([0.1, 0.5]))}`);
      for (const place of places) {
        assert.ok(place.every((share) => share > 0.1 && share < 0.9), `off the picture: ${place}`);
        assert.ok(contrast(place) > 10, `nobody is seen at ${place}`);
      }
      assert.ok(Math.abs(places[0][0] - places[1][0]) > 0.1, `${places}`);
    });
  }

  if (isPhone) {
    await check('a film in the making is seen, and may be left off', async () => {
      await page.getByLabel('Export the dance').selectOption('webm');
      await until(() => / left/.test(document.querySelector('.filming')?.textContent ?? ''));
      await takeIt('filming-');
      await hand.tap(page.getByRole('button', { name: 'Cancel' }));
      await until(() => window.choreo.filming.value === null);
      assert.equal((await message()).text, 'The film was cancelled.');
    });
  }

  if (!isFirst) return;

  await check('picture and sound of an .mp4 begin together', async () => {
    const { path, said, codecs } = await film('mp4');
    isLeftTold(said);
    // The loudest moments are the song's clicks, each half a second.
    const pcm = ffmpeg('-i', path, '-map', 'a', '-ac', '1', '-ar', '8000', '-f', 's16le', '-');
    const samples = new Int16Array(pcm.buffer, pcm.byteOffset, pcm.length / 2);
    const onset = samples.findIndex((value, i) => i > 2000 && Math.abs(value) > 8000) / 8000;
    console.log(`    ${codecs}, ${(readFileSync(path).length / 2 ** 20).toFixed(1)} MiB; the click of 0.5 s sounds at ${onset.toFixed(3)} s`);
    assert.ok(Math.abs(onset - 0.5) < 0.03);
  });

  await check('a film plays in a browser', async () => {
    const base64 = readFileSync(inFolder(`dance-${name}.webm`)).toString('base64');
    const length = await page.evaluate(async (base64) => {
      const video = document.createElement('video');
      video.src = URL.createObjectURL(new Blob([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))], { type: 'video/webm' }));
      await new Promise((resolve, reject) => ([video.onloadeddata, video.onerror] = [resolve, () => reject(new Error('it cannot be opened'))]));
      return video.duration;
    }, base64);
    assert.ok(Math.abs(length - seconds) < 0.1);
  });

  await check('the stage is back as it was', async () => {
    await until(() => document.querySelector('.stage canvas').width !== 1280);
    const size = await page.evaluate(() => {
      const { width, clientWidth } = document.querySelector('.stage canvas');
      return width / clientWidth;
    });
    assert.ok(size <= 2);
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
