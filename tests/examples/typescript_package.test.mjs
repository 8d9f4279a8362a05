// client/node as others get it: packed, and installed into a folder that knows nothing of this repository. $CHOREO_SERVER names a choreod.
import assert from 'node:assert/strict';
import { execFile } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { cp, mkdir, mkdtemp, readdir, readFile, rm, symlink, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { compiler } from './compiler.mjs';

const root = fileURLToPath(new URL('../../', import.meta.url));
const tools = join(root, 'client/node/node_modules');
const noNetwork = /ENOTFOUND|EAI_AGAIN|ECONNREFUSED|ECONNRESET|EHOSTUNREACH|ENETUNREACH|ETIMEDOUT|ERR_SOCKET_TIMEOUT/;
let scratch;
let app; // a folder with the package in it
let skip = false;

function run(program, args, cwd) {
  return new Promise((resolve) => {
    execFile(program, args, { cwd }, (failure, out, err) => resolve({ code: failure?.code ?? 0, said: out + err, out }));
  });
}

/** Packs as a release does, from a copy: others may be testing the same sources. */
async function pack() {
  const source = join(scratch, 'checkout/client/node');
  const isOurs = (path) => !/\/(node_modules|proto|poses|types)$/.test(path);
  await cp(join(root, 'client/node'), source, { recursive: true, filter: isOurs });
  await cp(join(root, 'proto'), join(scratch, 'checkout/proto'), { recursive: true });
  await cp(join(root, 'client/poses'), join(scratch, 'checkout/client/poses'), { recursive: true });
  await cp(join(root, 'LICENSE'), join(scratch, 'checkout/LICENSE'));
  await symlink(tools, join(source, 'node_modules'));
  const { code, said } = await run('npm', ['pack', '--pack-destination', scratch], source);
  assert.equal(code, 0, said);
  const left = (await readdir(source)).filter((name) => ['proto', 'poses', 'types', 'LICENSE'].includes(name));
  assert.deepEqual(left, [], 'of what packing puts there');
  await rm(join(scratch, 'checkout'), { recursive: true });
  return join(scratch, (await readdir(scratch)).find((name) => name.endsWith('.tgz')));
}

before(async () => {
  scratch = await mkdtemp(join(tmpdir(), 'choreo-'));
  const tarball = await pack();
  app = join(scratch, 'app');
  await mkdir(app);
  await writeFile(join(app, 'package.json'), '{ "type": "module" }');
  const { code, said } = await run('npm', ['install', '--ignore-scripts', '--no-audit', '--no-fund', '--fetch-retries=1', tarball], app);
  skip = code !== 0 && process.env.CHOREO_SKIP_CODE !== '1' && noNetwork.test(said) && 'npm reaches no registry';
  assert.ok(code === 0 || skip, said);
});
after(() => rm(scratch, { recursive: true }));

const read = (path) => readFileSync(join(root, path), 'utf8');
const typed = (name) => read(`tests/examples/types/${name}`);
const webPrograms = [...read('docs/web.md').matchAll(/(?<=^```js\n)[^`]+(?:`[^`]+`[^`]+)*(?=^```)/gm)].map(([text]) => text);
const around = `
import type { Frames, Header } from 'choreo-client';
import type { Object3D } from 'choreo-client/character';
declare const gltf: { scene: Object3D }, renderer: { setAnimationLoop(draw: () => void): void }, audio: { currentTime: number };
declare const header: Header; declare function onFrames(hear: (frames: Frames) => void): void;
`;
const key = "export const key: Keyframe = { id: 'a', time: 2, pose: { rotations: [] } };\n";
const mistakes = {
  "{ keyframe: { id: 'a', time: '2', pose: armsUp } }": /Types of property 'time' are incompatible.\n *Type 'string' is not assignable to type 'number'/,
  "{ keyframe: { id: 'a', time: 2 } }": /Property 'pose' is missing in type '.*' but required in type 'KeyframeWithTime'/,
  "{ keyframe: { id: 'a', pose: armsUp } }": /is missing in type '.*' but required in type 'KeyframeWith/,
  "{ keyFrame: { id: 'a', time: 2, pose: armsUp } }": /is not assignable to type '"there is no field keyFrame"'/,
  "{ keyframe: { id: 'a', time: 2, frame: 60, pose: armsUp } }": /is not assignable to type '"another field of this message excludes this one"'/,
};
const head =
  "import { ChoreoClient, pose } from 'choreo-client';\nconst client = new ChoreoClient('one:1');\nconst armsUp = pose((await client.info()).models[0]!.skeleton);\n";
const yielding = (request, at) => `async function* wrong${at}() { yield { config: {} }; yield ${request}; }\nclient.streamDance(wrong${at}());\n`;

/** What the compiler finds wrong with each program: nothing is ''. */
const faultsOf = {
  // With no more of a browser than it needs.
  ...compiler(['--module', 'nodenext', '--lib', 'es2022,dom'], {
    'page.ts': `declare function draw(places: number[], turns: number[]): void;\n${/(?<=^```js\n)[^`]+/m.exec(read('client/node/README.md'))[0]}`,
    'show.ts': around + /(?<=^```js\n)import [^`]+/m.exec(read('docs/character.md'))[0],
    'wrongs.ts': head + Object.keys(mistakes).map(yielding).join(''),
    'character.ts': typed('character.ts'),
    'serve.ts': webPrograms.join(''),
    'web.ts': typed('web.ts'),
    'narrowed.ts': typed('narrowed.ts'),
  }),
  ...compiler(['--module', 'nodenext', '--noUncheckedIndexedAccess'], {
    'dance.ts': typed('program.ts') + typed('messages.ts'),
    'requests.ts': typed('requests.ts'),
  }),
  ...compiler(['--module', 'commonjs', '--moduleResolution', 'node10'], {
    'common.ts': `import { ChoreoClient, type Keyframe } from 'choreo-client';\nnew ChoreoClient('one:1').close();\n${key}`,
  }),
};

async function compile(...names) {
  for (const name of names) assert.equal(await faultsOf[name](app), '');
}

test('the installed package dances, and its errors name the field', async (t) => {
  if (skip) return t.skip(skip);
  const plain = typed('program.ts').replace(/, type StreamDanceRequest|: StreamDanceRequest\[\]|: number|(?<=\])!/g, '');
  await writeFile(join(app, 'dance.js'), plain);
  const { code, said, out } = await run(process.execPath, ['dance.js', process.env.CHOREO_SERVER], app);
  assert.equal(code, 0, said);
  assert.match(out, /^a\nb\nc\n60\nINVALID_ARGUMENT \w+\n$/);
});

test('CommonJS knows it, too', async (t) => {
  if (skip) return t.skip(skip);
  await compile('common.ts');
  if (!process.features.require_module) return; // before Node.js 20.19 and 22.12
  await writeFile(join(app, 'common.cjs'), "const { ChoreoClient } = require('choreo-client');\nnew ChoreoClient('one:1').close();\n");
  const { code, said } = await run(process.execPath, ['common.cjs'], app);
  assert.equal(code, 0, said);
});

test("the pages' programs are TypeScript, too", async (t) => {
  if (skip) return t.skip(skip);
  await compile('page.ts', 'show.ts');
});

test('its types know the messages', async (t) => {
  if (skip) return t.skip(skip);
  await compile('dance.ts');
});

test('requests that lack, misname or mistype something are refused by the compiler, from generators, too', async (t) => {
  if (skip) return t.skip(skip);
  await compile('requests.ts');
});

test("the compiler's errors end with what is wrong, and where", async (t) => {
  if (skip) return t.skip(skip);
  const said = await faultsOf['wrongs.ts'](app);
  const errors = said.split(/^wrongs\.ts/m).slice(1);
  assert.equal(errors.length, 5, said);
  Object.values(mistakes).forEach((what, at) => assert.match(errors[at].trimEnd().split('\n').slice(-2).join('\n'), what));
});

test('a character dances from the package, in a browser, too', async (t) => {
  if (skip) return t.skip(skip);
  await compile('character.ts');
  for (const folder of ['character', 'page']) {
    for (const name of await readdir(join(root, 'client/node', folder))) {
      const imported = [...(await readFile(join(root, 'client/node', folder, name), 'utf8')).matchAll(/from '([^']*)'/g)].map(([, from]) => from);
      assert.deepEqual(imported.filter((from) => !/^(\.|\.\.\/character)\/\w+\.js$/.test(from)), [], `${name} needs nothing else`);
    }
  }
  await writeFile(join(app, 'character.js'), "import { Player } from 'choreo-client/character';\nconsole.log(new Player({ frame_rate: 30 }).at(0).state);\n");
  const { said } = await run(process.execPath, ['character.js'], app);
  assert.equal(said, 'waiting\n');
});

test('a back end and its page come from the package', async (t) => {
  if (skip) return t.skip(skip);
  assert.equal(webPrograms.length, 2);
  await compile('serve.ts', 'web.ts');
  const asked = "import { serveDance } from 'choreo-client/serve';\nimport { connectDance } from 'choreo-client/page';\nconsole.log(typeof serveDance, typeof connectDance);\n";
  await writeFile(join(app, 'asked.js'), asked);
  assert.equal((await run(process.execPath, ['asked.js'], app)).said, 'function function\n');
});

test('asking what an answer or an event holds narrows its type', async (t) => {
  if (skip) return t.skip(skip);
  await compile('narrowed.ts');
});

test('the package has the version of the server', async () => {
  const [, version] = /project\(choreo VERSION (\S+)/.exec(await readFile(join(root, 'CMakeLists.txt'), 'utf8'));
  assert.equal(JSON.parse(await readFile(join(root, 'client/node/package.json'))).version, version);
});
