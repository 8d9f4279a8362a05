// The studio in a browser, as people use it: a song is dropped, a key dragged, a pose bent, a take kept, a file exported and opened again,
// and the server lost on the way.
//   node studio.test.mjs CHOREO_PROGRAM PICTURES_FOLDER
import assert from 'node:assert/strict';
import { execFileSync, spawn } from 'node:child_process';
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';

const { chromium } = createRequire(new URL('../../../studio/page/package.json', import.meta.url))('playwright-core');
const [program, pictures] = process.argv.slice(2);
const patience = 120000; // software rendering on a busy machine
const seconds = 12;
mkdirSync(pictures, { recursive: true });

/// A click every half second over a soft tone, as a WAV file.
function clicks() {
  const rate = 22050;
  const wav = Buffer.alloc(44 + 2 * rate * seconds);
  wav.write('RIFF');
  wav.writeUInt32LE(wav.length - 8, 4);
  wav.write('WAVEfmt ', 8);
  [[16, 4], [1, 2], [1, 2], [rate, 4], [2 * rate, 4], [2, 2], [16, 2]].reduce((at, [value, bytes]) => wav.writeUIntLE(value, at, bytes), 16);
  wav.write('data', 36);
  wav.writeUInt32LE(wav.length - 44, 40);
  for (let i = 0; i < rate * seconds; ++i) {
    const since = i % (rate / 2);
    const value = 2000 * Math.sin(i * 0.06) + 20000 * Math.exp(-since / 200) * Math.sin(since * 0.5);
    wav.writeInt16LE(Math.round(value), 44 + 2 * i);
  }
  return wav;
}

const studio = spawn(program, ['studio', '--listen', '127.0.0.1:0'], { stdio: ['ignore', 'pipe', 'inherit'] });
const url = await new Promise((resolve, reject) => {
  studio.stdout.on('data', (data) => resolve(/http:\S+/.exec(data)[0]));
  studio.on('exit', (code) => reject(new Error(`choreo studio ended: ${code}`)));
});
const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--autoplay-policy=no-user-gesture-required'],
});

/// A project as a file.
function saved(text) {
  const path = join(pictures, 'project.json');
  writeFileSync(path, text);
  return path;
}

let passed = 0;
const check = async (what, body) => {
  await body();
  ++passed;
  console.log(`ok: ${what}`);
};

try {
  const page = await browser.newPage({ viewport: { width: 1000, height: 700 }, colorScheme: 'light', acceptDownloads: true });
  page.setDefaultTimeout(patience);
  const strangers = [];
  const errors = [];
  page.on('request', (request) => {
    if (!request.url().startsWith(url) && !/^(blob|data):/.test(request.url())) strangers.push(request.url());
  });
  page.on('pageerror', (error) => errors.push(error.message));
  await page.goto(url);
  // The page's policy forbids what waitForFunction does.
  const until = async (condition, argument) => {
    for (const end = Date.now() + patience; Date.now() < end; await page.waitForTimeout(50)) {
      const value = await page.evaluate(condition, argument);
      if (value) return value;
    }
    throw new Error(`in vain: ${condition}`);
  };
  const settle = () => until(() => window.choreo?.busy.value === 0 && window.choreo.moment.value?.isReady);
  const message = () => page.evaluate(() => window.choreo.message.value);
  const frames = () => page.evaluate(() => {
    const motion = window.choreo.motion.value;
    return Array.from({ length: motion.count }, (_, frame) => JSON.stringify(motion.pose(frame)));
  });
  /// Pixels a second of the timeline.
  const scale = () => page.evaluate(() => {
    const [a, b] = [...document.querySelectorAll('.key')].map((key) => [key.getBoundingClientRect().x, key.dataset.frame / 30]);
    return (b[0] - a[0]) / (b[1] - a[1]);
  });
  const changed = (before, after) => after.flatMap((pose, i) => (pose === before[i] ? [] : [i]));

  await check('a page with landmarks and names', async () => {
    await page.getByRole('button', { name: 'Choose a song' }).waitFor();
    for (const [role, name] of [['banner', undefined], ['main', 'Stage'], ['complementary', 'Poses'], ['complementary', 'Settings'], ['region', 'Timeline']])
      assert.equal(await page.getByRole(role, name ? { name } : {}).count(), 1, `${role} ${name}`);
  });

  await check('a dropped song is danced to', async () => {
    await page.evaluate((base64) => {
      const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
      const dropped = new DataTransfer();
      dropped.items.add(new File([bytes], 'clicks.wav', { type: 'audio/wav' }));
      document.querySelector('.page').dispatchEvent(new DragEvent('drop', { dataTransfer: dropped, bubbles: true, cancelable: true }));
    }, clicks().toString('base64'));
    await page.locator('.key').first().waitFor();
    await settle();
    assert.equal(await page.evaluate(() => window.choreo.motion.value.count), 30 * seconds);
    assert.ok((await page.locator('.key').count()) >= 5);
    assert.ok((await page.locator('.suggested').count()) >= 4);
  });

  await check('a dragged key dances its intervals anew, and no other frame changes', async () => {
    const before = await frames();
    const keys = await page.evaluate(() => window.choreo.project.value.keys.map(({ frame }) => frame));
    const box = await page.locator('.key').nth(2).boundingBox();
    await page.mouse.move(box.x + 20, box.y + 20);
    await page.mouse.down();
    await page.mouse.move(box.x + 30, box.y + 20);
    await page.mouse.move(box.x + 20 + (await scale()) / 2, box.y + 20); // half a second: the next beat
    await page.mouse.up();
    await settle();
    const moved = await page.evaluate(() => window.choreo.project.value.keys[2].frame);
    assert.ok(Math.abs(moved - keys[2] - 15) <= 1, `from ${keys[2]} to ${moved}`);
    const touched = changed(before, await frames());
    assert.ok(touched.length > 10);
    assert.ok(touched.every((frame) => frame > keys[1] && frame < keys[3]), `${touched[0]} to ${touched.at(-1)}`);
  });

  await check('undo brings every frame back, redo the change', async () => {
    const after = await frames();
    await page.keyboard.press('Control+z');
    const before = await frames();
    assert.ok(changed(before, after).length > 10);
    await page.keyboard.press('Control+Shift+z');
    assert.deepEqual(changed(after, await frames()), []);
  });

  await check('a pose is bent by its hand, and danced', async () => {
    await page.locator('.key').nth(1).click();
    const { x, y } = await until(() => window.choreo.stage.value?.whereIs('left_hand'));
    // Half way to the head, which every arm reaches.
    const head = await page.evaluate(() => window.choreo.stage.value.whereIs('head'));
    const aim = { x: (x + head.x) / 2, y: (y + head.y) / 2 };
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move((x + aim.x) / 2, (y + aim.y) / 2);
    await page.mouse.move(aim.x, aim.y);
    await page.mouse.up();
    await settle();
    const away = await page.evaluate(() => {
      const [, key] = window.choreo.project.value.keys;
      const place = (pose) => window.choreo.place(pose, 'left_wrist');
      const [asked, danced] = [place(key.pose), place(window.choreo.motion.value.pose(key.frame))];
      return Math.hypot(...asked.map((value, i) => value - danced[i]));
    });
    assert.ok(away < 1e-3, `the dance is ${away} m off the key`);
    const to = await page.evaluate(() => window.choreo.stage.value.whereIs('left_hand'));
    assert.ok(Math.hypot(to.x - aim.x, to.y - aim.y) < 25, 'the hand is not where it was pulled');
  });

  await check('a pose of the library is carried onto the timeline', async () => {
    const count = await page.locator('.key').count();
    const from = await page.locator('.library li button').nth(1).boundingBox();
    const lane = await page.locator('.lane').boundingBox();
    await page.mouse.move(from.x + 30, from.y + 30);
    await page.mouse.down();
    await page.mouse.move(from.x + 40, from.y + 40);
    await page.mouse.move(lane.x + 40 + (await scale()) * 7.3, lane.y + 40, { steps: 3 });
    await page.mouse.up();
    await settle();
    assert.equal(await page.locator('.key').count(), count + 1);
  });

  await check('a take of an interval is tried and kept', async () => {
    const before = await frames();
    await page.locator('.interval').nth(1).click();
    const [from, to] = await page.evaluate(() => window.choreo.chosen.value);
    await page.getByRole('button', { name: 'Try 3 more' }).click();
    const keep = page.getByRole('complementary', { name: 'Settings' }).getByRole('button', { name: 'Keep C' });
    await keep.waitFor();
    await page.waitForTimeout(2000); // the camera steps back
    await page.screenshot({ path: join(pictures, 'takes.png'), timeout: patience });
    await keep.click();
    await settle();
    const touched = changed(before, await frames());
    assert.ok(touched.length > 10);
    assert.ok(touched.every((frame) => frame > from && frame < to));
  });

  const download = async (act) => {
    const [file] = await Promise.all([page.waitForEvent('download'), act()]);
    return file.path();
  };
  await check('a project is saved, readable, and opened again', async () => {
    const path = await download(() => page.getByRole('button', { name: 'Save' }).click());
    const text = readFileSync(path, 'utf8');
    const keys = await page.evaluate(() => window.choreo.project.value.keys.length);
    assert.equal(JSON.parse(text).keyframes.length, keys);
    // It is a key file, too.
    const dance = join(pictures, 'project.npz');
    execFileSync(program, ['dance', '--keyframes', saved(text), '--seconds', String(seconds), '--out', dance], { stdio: 'ignore' });
    await page.locator('input[type=file]').first().setInputFiles({ name: 'clicks.json', mimeType: 'application/json', buffer: Buffer.from(text) });
    await settle();
    assert.equal(await page.evaluate(() => window.choreo.project.value.keys.length), keys);
  });

  for (const extension of ['glb', 'bvh', 'npz']) {
    await check(`a dance is exported as ${extension} and opened again`, async () => {
      const before = await page.evaluate(() => window.choreo.motion.value.pose(100).root);
      const path = await download(() => page.getByLabel('Export the dance').selectOption(extension));
      await page.locator('input[type=file]').first().setInputFiles({ name: `dance.${extension}`, mimeType: 'application/octet-stream', buffer: readFileSync(path) });
      await until((name) => window.choreo.message.value?.text.startsWith(name), `dance.${extension}`);
      await settle();
      const after = await page.evaluate(() => window.choreo.motion.value.pose(100).root);
      assert.ok(Math.hypot(...before.map((value, i) => value - after[i])) < 1e-3);
      await page.keyboard.press('Control+z');
    });
  }

  await check('what cannot be is said in words', async () => {
    await page.locator('input[type=file]').first().setInputFiles({ name: 'noise.wav', mimeType: 'audio/wav', buffer: Buffer.from('no sound') });
    const alert = page.getByRole('alert');
    await alert.waitFor();
    assert.match(await alert.innerText(), /noise\.wav/);
  });

  await check('the loss of the server is survived', async () => {
    await page.getByRole('button', { name: 'New poses' }).click();
    await until(() => window.choreo.busy.value > 0);
    execFileSync('pkill', ['-KILL', '-P', String(studio.pid), 'choreod']);
    await settle();
    assert.equal(await page.evaluate(() => window.choreo.motion.value.count), 30 * seconds);
    const said = await message();
    assert.ok(!said?.isError, said?.text);
  });

  await check('it plays, picture and sound together', async () => {
    await page.evaluate(() => (window.choreo.audio.currentTime = 0));
    await page.getByRole('button', { name: 'Play', exact: true }).click();
    await until(() => window.choreo.audio.currentTime > 1.5);
    const late = await page.evaluate(() => window.choreo.stage.value.lateness);
    const rate = await page.evaluate(() => window.choreo.stage.value.rate);
    await page.getByRole('button', { name: 'Pause' }).click();
    console.log(`    ${rate.toFixed(0)} pictures a second; the picture shows the sound of ${(1000 * late).toFixed(0)} ms ago at most`);
  });

  await check('nothing left this machine, and nothing broke', async () => {
    assert.deepEqual(strangers, []);
    assert.deepEqual(errors, []);
  });

  await page.evaluate(() => {
    window.choreo.message.value = null;
    window.choreo.stage.value.sharpen();
  });
  await page.locator('.key').nth(2).click();
  for (const colorScheme of ['light', 'dark']) {
    for (const [width, height] of [[390, 844], [1600, 900]]) {
      await page.setViewportSize({ width, height });
      await page.emulateMedia({ colorScheme });
      await page.waitForTimeout(2500);
      const wide = await page.evaluate(() => document.documentElement.scrollWidth > innerWidth);
      assert.ok(!wide, `at ${width} pixels the page is wider than the window`);
      await page.screenshot({ path: join(pictures, `${width}-${colorScheme}.png`), fullPage: width < 900, timeout: patience });
    }
  }
} finally {
  await browser.close();
  studio.kill('SIGINT');
}
studio.removeAllListeners('exit');
const code = await new Promise((resolve) => studio.on('exit', resolve));
assert.equal(code, 0, 'Ctrl-C should end the studio in order');
console.log(`${passed} passed, 0 failed`);
