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
let shownAs = ''; // how the page is shown now
export const check = async (what, body) => {
  await body();
  ++passed;
  console.log(`ok: ${shownAs}${what}`);
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

/// How people see the page: on wide screens and phones, light and dark.
const looks = ['light', 'dark'].flatMap((colorScheme) => [[1600, 1000], [390, 844]].map(([width, height]) =>
  ({ colorScheme, viewport: { width, height }, isDark: colorScheme === 'dark', isPhone: width < 900, name: `${width}-${colorScheme}` })));

/// A picture of the page as it is shown now, PREFIX390-light.png, on which all is large enough and nothing hangs over the edge.
async function takePicture(page, prefix, { viewport, isPhone, name }) {
  await page.waitForTimeout(2500); // the camera goes there
  const wide = await page.evaluate(() => document.documentElement.scrollWidth > innerWidth);
  if (wide) throw new Error(`at ${viewport.width} pixels the page is wider than the window`);
  const small = isPhone ? await smallTargets(page) : [];
  if (small.length) throw new Error(`smaller than a finger at ${viewport.width} pixels: ${small}`);
  await page.screenshot({ path: inFolder(`${prefix}${name}.png`), fullPage: isPhone, timeout: patience });
}

/// Such pictures of one page in every look. The page is then light, and as large as before.
export async function takePictures(page, prefix = '') {
  const size = page.viewportSize();
  for (const look of looks) {
    await page.setViewportSize(look.viewport);
    await page.emulateMedia({ colorScheme: look.colorScheme });
    await takePicture(page, prefix, look);
  }
  await page.setViewportSize(size);
  await page.emulateMedia({ colorScheme: 'light' });
}

/// A hand on the page whose tip goes down, moves and comes up.
function handOf(page, { down, move, up }) {
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
  const steps = 4;
  /// Drags from a place by pixels: up or down, then aside, as lists do not scroll with that. Calls `there` before it lets go.
  const dragFrom = async ({ x, y }, right, below, there) => {
    await down({ x, y });
    for (let step = 1; step <= steps && below; ++step) await move({ x, y: y + (step * below) / steps });
    for (let step = 1; step <= steps; ++step) await move({ x: x + (step * right) / steps, y: y + below });
    await page.evaluate(() => new Promise(requestAnimationFrame)); // with which a finger's moves come
    await there?.();
    await up();
  };
  return {
    /// Taps in the middle of what is found there.
    tap: async (part) => {
      await down(await middleOf(part));
      await up();
    },
    /// Drags it by pixels to the right.
    drag: async (part, right, there) => dragFrom(await middleOf(part), right, 0, there),
    /// Carries it to the middle of another part, or beside that.
    carry: async (part, onto, right = 0, there) => {
      const from = await middleOf(part);
      const { x, y, width, height } = await onto.boundingBox();
      await dragFrom(from, x + width / 2 + right - from.x, y + height / 2 - from.y, there);
    },
  };
}

const mouse = (page) => handOf(page, {
  down: async ({ x, y }) => {
    await page.mouse.move(x, y);
    await page.mouse.down();
  },
  move: ({ x, y }) => page.mouse.move(x, y),
  up: () => page.mouse.up(),
});

async function finger(page) {
  const devtools = await page.context().newCDPSession(page);
  await devtools.send('Emulation.setTouchEmulationEnabled', { enabled: true });
  const touch = (type) => (...touchPoints) => devtools.send('Input.dispatchTouchEvent', { type, touchPoints });
  return handOf(page, { down: touch('touchStart'), move: touch('touchMove'), up: touch('touchEnd') });
}

/// Runs what people do, `body`, on the page of a studio of its own, in a browser that is launched with `args`. Afterwards nothing may have left
/// this machine, nothing may have broken, and Ctrl-C has to end the program in order.
export const inStudio = (body, ...args) => inStudioOf([{}], body, ...args);

/// The same on a page for each look, by mouse on wide screens, by finger on phones. `isFirst`: what looks alike everywhere is done there alone.
export const inEachLook = (body) => inStudioOf(looks, body);

async function inStudioOf(shown, body, ...args) {
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
    for (const look of shown) {
      const { viewport, colorScheme, isPhone, name } = look;
      shownAs = name ? `${name}: ` : '';
      visitor = await visit(browser, url, viewport && { viewport, colorScheme });
      const { page } = visitor;
      await page.getByRole('button', { name: 'Choose a song' }).waitFor();
      await visitor.until(() => window.choreo?.isConnected.value);
      const hand = isPhone ? await finger(page) : mouse(page);
      const takeIt = (prefix) => takePicture(page, prefix, look);
      await body({ ...visitor, ...look, host, hand, isFirst: look === shown[0], takeIt });
      await check('nothing left this machine, and nothing broke', async () => {
        assert.deepEqual(visitor.strangers, []);
        assert.deepEqual(visitor.errors, []);
      });
      await page.close();
    }
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
