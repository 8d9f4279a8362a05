// Photos in the studio: pictures of known poses are dropped, seen, compared with what they show, mended and kept.
//   node photo.test.mjs CHOREO_PROGRAM PICTURES_FOLDER
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { check, clicks, inFolder, inStudio, program, takePictures } from './harness.mjs';

const poses = ['stand', 'victory_v', 'lunge', 'muscles'];

/// The pose of the library, and the first of the three sides in its picture, as base64.
async function render(page, id) {
  const [key, png] = [inFolder(`${id}.json`), inFolder(`${id}.png`)];
  execFileSync(program, ['pose', '--from', id, '--out', key, '--png', png], { stdio: 'ignore' });
  const picture = await page.evaluate(async (source) => {
    const image = new Image();
    image.src = source;
    await image.decode();
    const canvas = document.createElement('canvas');
    [canvas.width, canvas.height] = [image.width / 3, image.height];
    canvas.getContext('2d').drawImage(image, 0, 0);
    return canvas.toDataURL('image/png').split(',')[1];
  }, `data:image/png;base64,${readFileSync(png).toString('base64')}`);
  return { rotations: JSON.parse(readFileSync(key, 'utf8')).keyframes[0].rotations.flat(), picture };
}

const median = (values) => values.sort((a, b) => a - b)[Math.floor(values.length / 2)];

await inStudio(async ({ page, until, settle, message, drop, give }) => {

  /// Degrees between the limbs of a pose and those of the photo's, the one turned to where it fits best.
  const limbErrors = (rotations) => page.evaluate((rotations) => {
    const limbs = ['left', 'right'].flatMap((side) => [['hip', 'knee'], ['knee', 'ankle'], ['shoulder', 'elbow'], ['elbow', 'wrist']]
      .map((ends) => ends.map((end) => `${side}_${end}`)));
    const ways = (pose) => limbs.map(([from, to]) => {
      const [a, b] = [window.choreo.place(pose, from), window.choreo.place(pose, to)];
      const way = a.map((value, i) => b[i] - value);
      return way.map((value) => value / Math.hypot(...way));
    });
    const [asked, seen] = [ways({ root: [0, 1, 0], rotations }), ways(window.choreo.sketch.value.pose)];
    const errors = (turn) => seen.map(([x, y, z], i) => {
      const turned = [x * Math.cos(turn) + z * Math.sin(turn), y, z * Math.cos(turn) - x * Math.sin(turn)];
      return (Math.acos(Math.min(1, turned.reduce((sum, value, axis) => sum + value * asked[i][axis], 0))) * 180) / Math.PI;
    });
    const sum = (values) => values.reduce((a, b) => a + b);
    return Array.from({ length: 360 }, (_, degree) => errors((degree * Math.PI) / 180)).sort((a, b) => sum(a) - sum(b))[0];
  }, rotations);

  await check('poses are seen in pictures of them', async () => {
    const all = [];
    for (const id of poses) {
      const { rotations, picture } = await render(page, id);
      const began = Date.now();
      await drop(`${id}.png`, picture);
      await until((id) => window.choreo.message.value?.isError || window.choreo.sketch.value?.id === id, id);
      assert.equal((await message())?.text, undefined);
      const off = await limbErrors(rotations);
      console.log(`    ${id}: limbs are ${median(off).toFixed(0)} degrees off (median), ${Math.max(...off).toFixed(0)} at most; ${((Date.now() - began) / 1000).toFixed(1)} s`);
      all.push(...off);
    }
    console.log(`    all: ${median(all).toFixed(0)} degrees (median)`);
    assert.ok(median(all) < 30, 'half of the limbs point elsewhere'); // of a small doll without a face
  });

  await check('a photo that shows nobody, and what is no picture, are refused in words', async () => {
    const before = await page.evaluate(() => window.choreo.sketch.value.id);
    const blank = await page.evaluate(() => {
      const canvas = document.createElement('canvas');
      canvas.getContext('2d').fillRect(0, 0, 300, 150);
      return canvas.toDataURL('image/png').split(',')[1];
    });
    for (const [name, content, words] of [['dark.png', blank, /dark\.png: nobody was found/], ['torn.jpg', 'AAAA', /torn\.jpg is no picture/], ['empty.webp', '', /empty\.webp is no picture/]]) {
      await page.evaluate(() => (window.choreo.message.value = null));
      await drop(name, content);
      await until(() => window.choreo.message.value?.isError);
      assert.match((await message()).text, words);
    }
    assert.equal(await page.evaluate(() => window.choreo.sketch.value.id), before, 'the photo before it is gone');
    await page.evaluate(() => (window.choreo.message.value = null));
  });

  await check('the pose is mended by its hand, beside the photo', async () => {
    await page.getByRole('region', { name: 'Photo' }).getByRole('img').waitFor();
    const [from, head] = [await until(() => window.choreo.stage.value?.whereIs('left_hand')), await until(() => window.choreo.stage.value?.whereIs('head'))];
    const before = await page.evaluate(() => window.choreo.sketch.value.pose.rotations);
    await page.mouse.move(from.x, from.y);
    await page.mouse.down();
    await page.mouse.move((from.x + head.x) / 2, (from.y + head.y) / 2, { steps: 3 });
    await page.mouse.up();
    assert.notDeepEqual(await page.evaluate(() => window.choreo.sketch.value.pose.rotations), before);
  });

  await check('it is kept among the poses, and still there after a reload', async () => {
    const id = await page.evaluate(() => window.choreo.sketch.value.id);
    await page.getByRole('button', { name: 'Add to poses' }).click();
    assert.equal(await page.evaluate(() => window.choreo.sketch.value), null);
    await page.reload();
    await page.getByRole('button', { name: `Forget ${id}` }).waitFor();
  });

  await check('a photo becomes a key that is danced', async () => {
    await give(['clicks.wav', clicks(8)]);
    await page.locator('.key').first().waitFor();
    await settle();
    const { picture } = await render(page, 'muscles');
    await page.evaluate(() => (window.choreo.audio.currentTime = 3.2));
    await drop('Muscles at the beach!.png', picture);
    await until(() => window.choreo.sketch.value);
    await takePictures(page, 'photo-');
      await page.getByRole('button', { name: 'Set as a key' }).click();
    await settle();
    const away = await page.evaluate(() => {
      const key = window.choreo.project.value.keys.find(({ id }) => id === 'Muscles_at_the_beach_');
      const place = (pose) => window.choreo.place(pose, 'left_wrist');
      const [asked, danced] = [place(key.pose), place(window.choreo.motion.value.pose(key.frame))];
      return Math.hypot(...asked.map((value, i) => value - danced[i]));
    });
    assert.ok(away < 1e-3, `the dance is ${away} m off the key`);
  });
});
