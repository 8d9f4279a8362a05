// examples/web in a browser: a character dances, changes, and outlives its server. $CHOREOD is a program, $PICTURES a folder with characters.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { once } from 'node:events';
import { cp, mkdir, mkdtemp, readFile, rm, symlink, writeFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { createServer } from 'node:net';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { createInterface } from 'node:readline';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { Character, gltfBones } from '../../../client/node/character/index.js';
import { song, wav } from '../../../examples/node/music.js';
import { withServer } from '../servers.mjs';

const { chromium } = createRequire(new URL('../../../studio/page/package.json', import.meta.url))('playwright-core');
const serve = fileURLToPath(new URL('../../../examples/web/serve.js', import.meta.url));
const pictures = process.env.PICTURES;
const patience = 120000; // software rendering on a busy machine

const launch = () =>
  chromium.launch({
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
    args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--autoplay-policy=no-user-gesture-required'],
  });

/** The page of a back end, in a browser, until `use(page)` is done; nothing may go wrong on it. */
async function withPage(servers, seconds, use) {
  const flags = [...servers.flatMap((server) => ['--server', server]), '--port', '0', '--seconds', `${seconds}`];
  const backend = spawn(process.execPath, [serve, ...flags], { stdio: ['ignore', 'pipe', 'inherit'] });
  const browser = await launch();
  try {
    const [address] = await once(createInterface({ input: backend.stdout }), 'line');
    const page = await browser.newPage({ viewport: { width: 400, height: 300 } });
    page.setDefaultTimeout(patience);
    const wrong = [];
    page.on('pageerror', (error) => wrong.push(error.message));
    await page.goto(address);
    const says = (words) => page.waitForFunction((text) => document.querySelector('#log').textContent.includes(text), words, { timeout: patience });
    await use({ page, says, end: () => backend.kill('SIGKILL') });
    assert.deepEqual(wrong, []);
  } finally {
    await browser.close();
    backend.kill('SIGINT');
  }
}

/** A .glb whose bones say nothing by their names, with a VRM's table of them. */
function asVrm(glb, skeleton) {
  const end = 20 + glb.readUInt32LE(12);
  const json = JSON.parse(glb.toString('utf8', 20, end));
  const { bones } = new Character(gltfBones(json), skeleton);
  const names = { pelvis: 'hips', spine1: 'spine', head: 'head' };
  for (const side of ['left', 'right']) {
    const parts = { hip: 'UpperLeg', knee: 'LowerLeg', ankle: 'Foot', shoulder: 'UpperArm', elbow: 'LowerArm', wrist: 'Hand' };
    for (const [joint, part] of Object.entries(parts)) names[`${side}_${joint}`] = side + part;
  }
  const humanBones = Object.fromEntries(Object.entries(names).map(([bone, name]) => [name, { node: bones[bone] }]));
  json.extensions = { VRMC_vrm: { specVersion: '1.0', humanoid: { humanBones } } };
  json.nodes.forEach((node, at) => (node.name = `bone ${at}`));
  const text = Buffer.from(JSON.stringify(json));
  const chunk = Buffer.concat([text, Buffer.alloc(-text.length & 3, ' ')]);
  const head = Buffer.from(glb.subarray(0, 20));
  head.writeUInt32LE(glb.length - (end - 20) + chunk.length, 8);
  head.writeUInt32LE(chunk.length, 12);
  return Buffer.concat([head, chunk, glb.subarray(end)]);
}

/** Waits until the stage shows something else than before. */
async function moves(page, selector = '#stage') {
  const stage = page.locator(selector);
  const before = await stage.screenshot();
  for (let tries = 0; tries < 40; ++tries) if (!before.equals(await stage.screenshot())) return;
  assert.fail('nothing moves');
}

test('a doll and then a character dance, are asked for poses, and outlive a server', () =>
  withServer([], (one) =>
    withServer([], (other) =>
      withPage([one.address, other.address], 600, async ({ page, says }) => {
        await page.click('#dance');
        await page.locator('[data-turns]:enabled').first().waitFor();
        await moves(page);
        await page.setInputFiles('#file', join(pictures, 'mixamo.glb'));
        await says('mixamo.glb dances.');
        await moves(page);
        await page.getByText('Arms up').click();
        await says('asked for at');
        one.kill();
        await says('goes on at');
        await moves(page);
        await page.screenshot({ path: join(pictures, 'page.png') });
      }),
    ),
  ));

test('what is no character says so, and the one before dances on', () =>
  withServer([], ({ address }) =>
    withPage([address], 600, async ({ page, says }) => {
      await writeFile(join(pictures, 'junk.glb'), 'no glTF');
      await page.setInputFiles('#file', join(pictures, 'junk.glb'));
      await says('junk.glb: this is no glTF file');
      await page.setInputFiles('#file', join(pictures, 'nameless.glb'));
      await says('nameless.glb: bones: none of them is the pelvis');
      await page.click('#dance');
      await page.locator('[data-turns]:enabled').first().waitFor();
      await moves(page);
      await page.evaluate(() => (document.querySelector('#log').textContent = ''));
      await page.setInputFiles('#file', join(pictures, 'nameless.glb'));
      await says('nameless.glb: bones: none of them is the pelvis');
      await page.setInputFiles('#file', join(pictures, 'child.glb'));
      await says('child.glb dances.');
      await moves(page);
    }),
  ));

test("a VRM's bones are those of its own table", () =>
  withServer([], ({ address }) =>
    withPage([address], 600, async ({ page, says }) => {
      const skeleton = await page.evaluate(async () => (await fetch('/dance/skeleton')).json());
      await writeFile(join(pictures, 'own.vrm'), asVrm(await readFile(join(pictures, 'mixamo.glb')), skeleton));
      await page.setInputFiles('#file', join(pictures, 'own.vrm'));
      await says('own.vrm will dance.');
    }),
  ));

test('a back end that is gone is told', () =>
  withServer([], ({ address }) =>
    withPage([address], 600, async ({ page, says, end }) => {
      await page.click('#dance');
      await page.locator('[data-turns]:enabled').first().waitFor();
      end();
      await says('The connection is lost.');
      await page.getByText('Bow').click();
      await says('Failed to fetch');
    }),
  ));

test('one dance after the other', () =>
  withServer([], ({ address }) =>
    withPage([address], 3, async ({ page, says }) => {
      for (let dances = 0; dances < 2; ++dances) {
        await page.locator('#dance:enabled').click();
        await says('The dance is made.');
        await page.evaluate(() => (document.querySelector('#log').textContent = ''));
      }
    }),
  ));

async function freePort() {
  const server = createServer().listen(0, '127.0.0.1');
  await once(server, 'listening');
  const { port } = server.address();
  await new Promise((resolve) => server.close(resolve));
  return port;
}

const root = fileURLToPath(new URL('../../../', import.meta.url));
const text = await readFile(join(root, 'docs/web.md'), 'utf8');
const [html] = fences('html');
const [backEnd, withMusic] = fences('js');

function fences(language) {
  return [...text.matchAll(new RegExp(`^\`\`\`${language}\\n([^]*?)^\`\`\``, 'gm'))].map(([, inside]) => inside);
}

/** Uses the page of a back end, `listens` on port 8080, in a folder of its own with `files`: `use(page, what its console says)`. */
const withSample = ({ html, backEnd, files = {} }, use) =>
  withServer([], async ({ address }) => {
    const folder = await mkdtemp(join(tmpdir(), 'choreo-'));
    const port = await freePort();
    let program, browser;
    try {
      await mkdir(join(folder, 'node_modules'));
      await symlink(join(root, 'client/node'), join(folder, 'node_modules/choreo-client'));
      await symlink(join(root, 'examples/web/node_modules/three'), join(folder, 'node_modules/three'));
      await cp(join(pictures, 'mixamo.glb'), join(folder, 'hero.glb'));
      await writeFile(join(folder, 'package.json'), '{ "type": "module" }');
      await writeFile(join(folder, 'index.html'), html);
      for (const [name, content] of Object.entries(files)) await writeFile(join(folder, name), content);
      await writeFile(join(folder, 'serve.js'), backEnd.replace('127.0.0.1:50051', address).replace('8080', port));
      program = spawn(process.execPath, ['serve.js'], { cwd: folder, stdio: ['ignore', 'inherit', 'inherit'] });
      browser = await launch();
      const page = await browser.newPage({ viewport: { width: 700, height: 560 } });
      page.setDefaultTimeout(patience);
      const said = [];
      page.on('pageerror', (error) => said.push(error.message));
      page.on('console', (message) => said.push(message.text()));
      for (let tries = 0; tries < 100; ++tries) if (await page.goto(`http://127.0.0.1:${port}`).catch(() => page.waitForTimeout(100))) break;
      await use(page, said);
    } finally {
      await browser?.close();
      program?.kill('SIGKILL');
      await rm(folder, { recursive: true });
    }
  });

async function kicks(page, said) {
  await page.getByText('Kick').click();
  for (let tries = 0; tries < 300 && !said.includes('key 1 reached'); ++tries) await page.waitForTimeout(100);
  assert.deepEqual(said.filter((text) => !/GPU stall|favicon|404/.test(text)), ['key 1 reached']);
}

test('what docs/web.md says works, from nothing', () =>
  withSample({ html, backEnd }, async (page, said) => {
    await moves(page, 'canvas');
    await kicks(page, said);
    await page.screenshot({ path: join(pictures, 'from_nothing.png') });
  }));

test('what docs/web.md says of music works', () => {
  const [set, ask] = withMusic.split('// in createServer: ');
  const alone = 'if (await dance(request, response)) return;';
  const changed = backEnd.replace('createServer(async', `${set}createServer(async`).replace(alone, ask).replace('audio/mpeg', 'audio/wav');
  let musical = html;
  let added = [];
  for (const line of fences('diff')[0].trimEnd().split('\n')) {
    if (line[0] === '+') added.push(line.slice(1));
    else {
      const at = musical.indexOf(line.slice(1));
      assert.ok(at >= 0, line);
      musical = musical.replace(line.slice(1), '@@');
    }
    if (line[0] === '+' && musical.includes('@@')) musical = musical.replace('@@', added.splice(0).join('\n'));
  }
  return withSample({ html: musical, backEnd: changed, files: { 'song.mp3': wav(song(60)) } }, async (page, said) => {
    await page.waitForFunction(() => document.querySelector('button').onclick);
    await page.getByText('Kick').click(); // begins
    await moves(page, 'canvas');
    assert.deepEqual(said.filter((text) => !/GPU stall|favicon|404/.test(text)), []);
  });
});
