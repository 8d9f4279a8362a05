// A way over the floor in the studio: drawn with the mouse, danced, saved, danced by the command line, cleared.
//   node path.test.mjs CHOREO_PROGRAM PICTURES_FOLDER
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { check, clicks, inFolder, inStudio, program, takePictures } from './harness.mjs';

const seconds = 8;

await inStudio(async ({ page, until, settle, rest, message, frames, give, download }) => {
  await give(['clicks.wav', clicks(seconds)]);
  await page.locator('.key').first().waitFor();
  await settle();
  const panel = page.getByRole('region', { name: 'Floor path' });

  /// Draws over the stage from left to right; where the pointer was on the floor is the program's to find.
  const draw = async (points) => {
    await until(() => window.choreo.stage.value.camera.position.y > 5.15); // the camera goes up
    const box = await page.locator('.stage canvas').boundingBox();
    const at = ([x, y]) => [box.x + box.width * x, box.y + box.height * y];
    await page.mouse.move(...at(points[0]));
    await page.mouse.down();
    for (const point of points.slice(1)) await page.mouse.move(...at(point), { steps: 8 });
    await page.mouse.up();
    await settle();
  };
  /// How far the dance is from its path, metres, at most and in the mean, after the path's first second.
  const away = () => page.evaluate(() => {
    const { path } = window.choreo.project.value;
    const off = path.filter(({ frame }) => frame >= path[0].frame + 30).map(({ frame, x, z }) => {
      const [rx, , rz] = window.choreo.motion.value.pose(frame).root;
      return Math.hypot(rx - x, rz - z);
    });
    return { most: Math.max(...off), mean: off.reduce((a, b) => a + b) / off.length };
  });

  await check('a path drawn on the floor is danced, and keys stand on it', async () => {
    await page.evaluate(() => (window.choreo.audio.currentTime = 0));
    await panel.getByRole('button', { name: 'Draw a path' }).click();
    await draw([[0.5, 0.55], [0.85, 0.6], [0.75, 0.9], [0.15, 0.85]]);
    const { path, keys } = await page.evaluate(() => window.choreo.project.value);
    assert.ok(path.length >= 10);
    assert.equal(path.at(-1).frame, 30 * seconds - 1);
    const { most, mean } = await away();
    console.log(`    the dance is ${(100 * mean).toFixed(0)} cm off its path in the mean, ${(100 * most).toFixed(0)} at most`);
    assert.ok(most < 0.3);
    const off = keys.map(({ frame, pose }) => {
      const next = path.findIndex((step) => step.frame >= frame);
      const [a, b] = [path[Math.max(0, next - 1)], path[next]];
      return Math.min(Math.hypot(a.x - pose.root[0], a.z - pose.root[2]), Math.hypot(b.x - pose.root[0], b.z - pose.root[2]));
    });
    assert.ok(Math.max(...off) < 0.4, `${off}`);
    assert.ok(!(await page.evaluate(() => window.choreo.warnings.value.some(({ text }) => /path/.test(text)))));
  });

  await check('it is saved, opened again, and danced by the command line frame for frame', async () => {
    const text = readFileSync(await download(() => page.getByRole('button', { name: 'Save' }).click()), 'utf8');
    assert.equal(JSON.parse(text).controls.root_path.frames.length, await page.evaluate(() => window.choreo.project.value.path.length));
    await give(['clicks.json', text]);
    await settle();
    const here = readFileSync(await download(() => page.getByLabel('Export the dance').selectOption('bvh')), 'utf8');
    writeFileSync(inFolder('clicks.wav'), clicks(seconds));
    writeFileSync(inFolder('path.json'), text);
    execFileSync(program, ['dance', '--project', inFolder('path.json'), '--out', inFolder('path.bvh')], { stdio: 'ignore' });
    assert.ok(readFileSync(inFolder('path.bvh'), 'utf8') === here, 'the command line dances it otherwise');
  });

  await takePictures(page, 'path-');

  await check('in too little time it is told: beside the path, and where it is on the timeline', async () => {
    await panel.getByLabel('to').fill('1');
    await panel.getByLabel('to').press('Tab');
    await settle();
    await panel.getByText('faster than people dance').waitFor();
    await until(() => window.choreo.warnings.value.some(({ text }) => /m\/s/.test(text)));
    assert.ok((await page.locator('.warning').count()) > 0);
    await page.keyboard.press('Control+z');
  });

  await check('a slip of the hand is no path, and a path is cleared', async () => {
    const count = await page.evaluate(() => window.choreo.project.value.path.length);
    await panel.getByRole('button', { name: 'Draw another' }).click();
    await draw([[0.5, 0.85], [0.505, 0.85]]);
    await until(() => window.choreo.message.value);
    assert.match((await message()).text, /a path is at least 0\.3 m/);
    assert.equal(await page.evaluate(() => window.choreo.project.value.path.length), count);
    await panel.getByRole('button', { name: 'Clear' }).click();
    await settle();
    assert.equal(await page.evaluate(() => window.choreo.project.value.path.length), 0);
  });

  await check('an interval alone is led elsewhere, and what is before it stays', async () => {
    const before = await frames();
    await page.locator('.interval').nth(1).click();
    const [from] = await page.evaluate(() => window.choreo.selection.value);
    await panel.getByRole('button', { name: 'Draw a path' }).click();
    await draw([[0.45, 0.6], [0.62, 0.7]]);
    const after = await frames();
    const touched = after.flatMap((pose, i) => (pose === before[i] ? [] : [i]));
    assert.ok(touched.length > 10);
    assert.ok(touched[0] > from, `${touched[0]} is danced anew`);
  });

  await check('a finger draws, too', async () => {
    await page.keyboard.press('Escape');
    await panel.getByRole('button', { name: 'Clear' }).click();
    await settle();
    await panel.getByRole('button', { name: 'Draw a path' }).click();
    await until(() => window.choreo.stage.value.camera.position.y > 5.15);
    const box = await page.locator('.stage canvas').boundingBox();
    const session = await page.context().newCDPSession(page);
    const touch = (type, ...points) => session.send('Input.dispatchTouchEvent', { type, touchPoints: points.map(([x, y]) => ({ x: box.x + box.width * x, y: box.y + box.height * y })) });
    await touch('touchStart', [0.4, 0.6]);
    for (const x of [0.45, 0.5, 0.55, 0.6]) await touch('touchMove', [x, 0.7]);
    await touch('touchEnd');
    await settle();
    assert.ok((await page.evaluate(() => window.choreo.project.value.path.length)) >= 2);
  });

  await check('without a mouse: points are added, moved with arrow keys, removed, and the way is danced', async () => {
    await panel.getByRole('button', { name: 'Clear' }).click();
    await settle();
    await page.evaluate(() => (window.choreo.audio.currentTime = 0));
    const last = () => page.evaluate(() => window.choreo.project.value.path.at(-1));
    const summary = panel.getByText('Points by keyboard');
    await summary.focus();
    await page.keyboard.press('Enter');
    await page.keyboard.press('Tab');
    await page.keyboard.press('Enter'); // Add a point: the first two
    await rest();
    const points = panel.getByRole('list', { name: 'Points of the path' }).getByRole('listitem');
    assert.equal(await points.count(), 2);
    await panel.getByRole('button', { name: 'Add a point' }).press('Enter');
    await rest();
    assert.equal(await points.count(), 3);
    const x = panel.getByLabel('Point 3, x in metres');
    const before = Number(await x.inputValue());
    for (let i = 0; i < 3; ++i) await x.press('ArrowUp');
    await x.press('Shift+ArrowUp');
    await rest();
    assert.ok(Math.abs((await last()).x - Math.round(10 * before + 13) / 10) < 0.051, `${before}, ${(await last()).x}`);
    assert.equal(Number(await x.inputValue()).toFixed(2), (await last()).x.toFixed(2));
    const { mean } = await away();
    assert.ok(mean < 0.15, `${mean} m off`);
    await x.press('PageUp'); // it holds what the arrow keys hold
    await rest();
    await x.fill('101');
    await x.press('Enter');
    assert.equal(await panel.getByRole('alert').innerText(), 'x is -100 to 100 metres, not 101.');
    await takePictures(page, 'points-');
    await panel.getByRole('button', { name: 'Remove point 3' }).press('Enter');
    await rest();
    assert.equal(await points.count(), 2);
    for (const i of [2, 1]) await panel.getByRole('button', { name: `Remove point ${i}` }).press('Enter');
    await rest();
    assert.equal(await page.evaluate(() => window.choreo.project.value.path.length), 0);
  });

  await check('a path that was drawn has few points, which are moved, too', async () => {
    await panel.getByRole('button', { name: 'Draw a path' }).click();
    await draw([[0.5, 0.55], [0.8, 0.6], [0.75, 0.9], [0.2, 0.85]]);
    const count = await panel.getByRole('listitem').count();
    assert.ok(count >= 3 && count <= 12, `${count} points`);
    const z = panel.getByLabel('Point 2, z in metres');
    const before = await page.evaluate(() => window.choreo.project.value.path);
    await z.press('ArrowDown');
    await rest();
    assert.notDeepEqual(await page.evaluate(() => window.choreo.project.value.path), before);
    assert.equal(await panel.getByRole('listitem').count(), count);
  });

  await check('paths in files that cannot be are refused in words', async () => {
    const key = { id: 'a', time: 1, rotations: Array(24).fill([0, 0, 0]) };
    for (const [path, words] of [
      [7, /path\.json:path: 7 is not an object/],
      [{ points: [] }, /path\.json:path:points: is empty/],
      [{ points: [{ frame: 3, x: 0, z: 0 }, { frame: 3, x: 1, z: 0 }] }, /path:points\[1\]\.frame: is frame 3, as that of the point before it/],
      [{ points: [{ frame: 3, x: 'far', z: 0 }, { frame: 9, x: 1, z: 0 }] }, /path:points\[0\]\.x: "far" is not a number/],
    ]) {
      await page.evaluate(() => (window.choreo.message.value = null));
      await give(['path.json', JSON.stringify({ studio: 1, path, keyframes: [key] })]);
      await until(() => window.choreo.message.value?.isError);
      assert.match((await message()).text, words);
    }
  });
});
