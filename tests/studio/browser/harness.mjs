// What the studio's tests in a browser share: the studio, the browser, and what people do on the page.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { mkdirSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';

const { chromium } = createRequire(new URL('../../../studio/page/package.json', import.meta.url))('playwright-core');
export const patience = 300000; // software rendering on a busy machine
/// What every test here is given: the program, and a folder for pictures and what is made on the way.
export const [program, pictures] = process.argv.slice(2);
mkdirSync(pictures, { recursive: true });
/// Where a picture goes, or another file.
export const inFolder = (name) => join(pictures, name);

const rate = 22050;

/// A click every half second over a soft tone, as a WAV file.
export const clicks = (seconds) => asWav(seconds, (i) => {
  const since = i % (rate / 2);
  return 2000 * Math.sin(i * 0.06) + 20000 * Math.exp(-since / 200) * Math.sin(since * 0.5);
});

/// A song at 120 beats a minute of parts of 16 seconds, each named by a letter: ABA comes back to its first one.
export const song = (parts) => asWav(16 * parts.length, (i) => {
  const part = parts.charCodeAt(Math.floor(i / (16 * rate))) - 65;
  const [beat, since] = [Math.floor(i / (rate / 2)), (i % (rate / 2)) / rate];
  const root = 110 * 2 ** ([[0, 5, 9, 7], [3, 10, 1, 6]][part][Math.floor(beat / 4) % 4] / 12);
  const voices = part ? [1, 1.189, 1.498, 6, 7] : [1, 1.26, 1.498, 2];
  const chord = voices.reduce((sum, over) => sum + Math.sin(2 * Math.PI * root * over * (i / rate)), 0);
  const drum = Math.exp(-30 * since) * Math.sin(2 * Math.PI * (beat % 4 === 0 ? 60 : 180) * since);
  return 2200 * chord * Math.exp(-2 * since) + (beat % 4 === 0 ? 16000 : 8000) * drum;
});

function asWav(seconds, sampleAt) {
  const wav = Buffer.alloc(44 + 2 * rate * seconds);
  wav.write('RIFF');
  wav.writeUInt32LE(wav.length - 8, 4);
  wav.write('WAVEfmt ', 8);
  [[16, 4], [1, 2], [1, 2], [rate, 4], [2 * rate, 4], [2, 2], [16, 2]].reduce((at, [value, bytes]) => wav.writeUIntLE(value, at, bytes), 16);
  wav.write('data', 36);
  wav.writeUInt32LE(wav.length - 44, 40);
  for (let i = 0; i < rate * seconds; ++i) wav.writeInt16LE(Math.round(sampleAt(i)), 44 + 2 * i);
  return wav;
}

/// The studio program, and where its page is.
async function open(listen) {
  const studio = spawn(program, ['studio', '--listen', listen], { stdio: ['ignore', 'pipe', 'inherit'] });
  const url = await new Promise((resolve, reject) => {
    studio.stdout.on('data', (data) => resolve(/http:\S+/.exec(data)[0]));
    studio.on('exit', (code) => reject(new Error(`choreo studio ended: ${code}`)));
  });
  studio.removeAllListeners('exit');
  process.on('exit', () => studio.kill()); // a test that fails leaves nothing behind
  return { studio, url };
}

const launch = (...args) => chromium.launch({
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--autoplay-policy=no-user-gesture-required', ...args],
});

let passed = 0;
export const check = async (what, body) => {
  await body();
  ++passed;
  console.log(`ok: ${what}`);
};

/// Opens the page, and knows how to use it.
async function visit(browser, url, options = {}) {
  const page = await browser.newPage({ viewport: { width: 1000, height: 700 }, colorScheme: 'light', acceptDownloads: true, ...options });
  page.setDefaultTimeout(patience);
  const strangers = [];
  const errors = [];
  page.on('request', (request) => {
    if (!request.url().startsWith(url) && !/^(blob|data):/.test(request.url())) strangers.push(request.url());
  });
  page.on('pageerror', (error) => {
    errors.push(error.stack ?? error.message);
    console.log(`    broke: ${errors.at(-1)}`);
  });
  page.on('dialog', (dialog) => dialog.accept()); // it asks before it is left
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
  /// The same after numbers and keys, which are danced to once the hand rests.
  const rest = async () => {
    await page.waitForTimeout(800);
    await settle();
  };
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
  const give = (...files) => page.locator('input[type=file]').first().setInputFiles(
    files.map(([name, content]) => ({ name, mimeType: 'application/octet-stream', buffer: Buffer.from(content) })));
  const drop = (name, base64, bytes = 0) => page.evaluate(([name, base64, bytes]) => {
    const content = bytes ? new Uint8Array(bytes) : Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
    const dropped = new DataTransfer();
    dropped.items.add(new File([content], name));
    document.querySelector('.page').dispatchEvent(new DragEvent('drop', { dataTransfer: dropped, bubbles: true, cancelable: true }));
  }, [name, base64, bytes]);
  const download = async (act) => {
    const [file] = await Promise.all([page.waitForEvent('download', { timeout: 3 * patience }), act()]);
    return file.path();
  };
  return { page, strangers, errors, until, settle, rest, message, frames, scale, give, drop, download };
}

/// What can be pressed and is less than 44 pixels high or wide. How wide an interval is, the timeline's scale says.
const smallTargets = (page) => page.evaluate(() => [...document.querySelectorAll('button, select, summary, label, input:not([type=file])')]
  .filter((at) => at.checkVisibility() && !at.closest('.hidden') && !(at.matches('input') && at.closest('label')) && !at.matches('.export'))
  .map((at) => [at, at.getBoundingClientRect()])
  .filter(([at, { width, height }]) => height < 43.9 || (width < 43.9 && !at.matches('.interval')))
  .map(([at, { width, height }]) => `${at.ariaLabel || at.textContent || at.tagName} ${width} × ${height}`));

/// Pictures of the page as phones and wide screens have it, light and dark: PREFIX390-light.png ... The page is then light, and as large as before.
export async function takePictures(page, prefix = '') {
  const size = page.viewportSize();
  for (const colorScheme of ['light', 'dark']) {
    for (const [width, height] of [[390, 844], [1600, 1000]]) {
      await page.setViewportSize({ width, height });
      await page.emulateMedia({ colorScheme });
      await page.waitForTimeout(2500);
      const wide = await page.evaluate(() => document.documentElement.scrollWidth > innerWidth);
      if (wide) throw new Error(`at ${width} pixels the page is wider than the window`);
      const small = width < 900 ? await smallTargets(page) : [];
      if (small.length) throw new Error(`smaller than a finger at ${width} pixels: ${small}`);
      await page.screenshot({ path: inFolder(`${prefix}${width}-${colorScheme}.png`), fullPage: width < 900, timeout: patience });
    }
  }
  await page.setViewportSize(size);
  await page.emulateMedia({ colorScheme: 'light' });
}

/// A finger on the page: it taps in the middle of what is found there, and drags that by pixels to the right.
export async function finger(page) {
  const devtools = await page.context().newCDPSession(page);
  await devtools.send('Emulation.setTouchEmulationEnabled', { enabled: true });
  const touch = (type, ...touchPoints) => devtools.send('Input.dispatchTouchEvent', { type, touchPoints });
  const middleOf = async (part) => {
    await part.scrollIntoViewIfNeeded();
    const { x, y, width, height } = await part.boundingBox();
    const middle = { x: x + width / 2, y: y + height / 2 };
    const covers = await part.evaluate((element, { x, y }) => {
      const top = document.elementFromPoint(x, y);
      return element.contains(top) ? null : top?.outerHTML.slice(0, 200);
    }, middle);
    assert.equal(covers, null, `${part} is covered`);
    return middle;
  };
  return {
    tap: async (part) => {
      await touch('touchStart', await middleOf(part));
      await touch('touchEnd');
    },
    drag: async (part, right) => {
      const { x, y } = await middleOf(part);
      await touch('touchStart', { x, y });
      for (let step = 1; step <= 4; ++step) await touch('touchMove', { x: x + (step * right) / 4, y });
      await touch('touchEnd');
    },
  };
}

/// Runs what people do, `body`, on the page of a studio of its own, in a browser that is launched with `args`. Afterwards nothing may have left
/// this machine, nothing may have broken, and Ctrl-C has to end the program in order.
export async function inStudio(body, ...args) {
  let { studio, url } = await open('127.0.0.1:0');
  /// The program, as it dies and comes back.
  const host = {
    pid: () => studio.pid,
    kill: async () => {
      const ended = new Promise((resolve) => studio.on('exit', resolve));
      studio.kill('SIGKILL');
      await ended;
    },
    restart: async () => ({ studio } = await open(new URL(url).host)),
  };
  const browser = await launch(...args);
  let visitor;
  try {
    visitor = await visit(browser, url);
    await visitor.page.getByRole('button', { name: 'Choose a song' }).waitFor();
    await body({ ...visitor, host });
    await check('nothing left this machine, and nothing broke', async () => {
      assert.deepEqual(visitor.strangers, []);
      assert.deepEqual(visitor.errors, []);
    });
  } catch (error) {
    await visitor?.page.screenshot({ path: inFolder('failed.png') }).catch(() => {});
    throw error;
  } finally {
    await browser.close();
  }
  const ended = new Promise((resolve) => studio.on('exit', resolve));
  studio.kill('SIGINT');
  assert.equal(await ended, 0, 'Ctrl-C should end the studio in order');
}

process.on('exit', (code) => console.log(`${passed} passed${code ? ', then one failed' : ''}`));
