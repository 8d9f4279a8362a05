// client/node as others get it: packed, and installed into a folder that knows nothing of this repository. $CHOREO_SERVER names a choreod.
import assert from 'node:assert/strict';
import { execFile } from 'node:child_process';
import { cp, mkdir, mkdtemp, readdir, readFile, rm, symlink, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';

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

const program = `
import { ChoreoClient, libraryPose, pose, readKeys, type StreamDanceRequest } from 'choreo-client';
const client = new ChoreoClient([process.argv[2]!]);
const model = (await client.info()).models[0]!;
const requests: StreamDanceRequest[] = [
  { config: { seed: '1', frames: 60 } },
  { keyframe: { id: 'a', frame: 40, pose: pose(model.skeleton, { head: [0, 0.5, 0] }) } },
  ...readKeys({ keyframes: [{ id: 'b', frame: 50, pose: 'dab' }] }, model.skeleton),
  { keyframe: { id: 'c', frame: 55, pose: { rotations: new Float32Array(libraryPose('dab', model.skeleton).rotations) } } },
];
let frames: number = 0;
for await (const answer of client.streamDance(requests)) {
  frames += answer.frames?.count ?? 0;
  if (answer.event?.keyframe_reached) console.log(answer.event.keyframe_reached.id);
}
console.log(frames);
await client.streamDance([{ remove_keyframe: { id: '' } }]).next().catch((error) => console.log(error.code, error.violations[0]?.field));
client.close();
`;

test('the installed package dances, and its errors name the field', async (t) => {
  if (skip) return t.skip(skip);
  const plain = program.replace(/, type StreamDanceRequest|: StreamDanceRequest\[\]|: number|(?<=\])!/g, '');
  await writeFile(join(app, 'dance.js'), plain);
  const { code, said, out } = await run(process.execPath, ['dance.js', process.env.CHOREO_SERVER], app);
  assert.equal(code, 0, said);
  assert.match(out, /^a\nb\nc\n60\nINVALID_ARGUMENT \w+\n$/);
});

/** What the compiler says of a program, strictly. */
async function judge(name, text, ...more) {
  await writeFile(join(app, name), text);
  const options = ['--noEmit', '--strict', '--module', 'nodenext', '--target', 'es2022', '--typeRoots', join(tools, '@types'), '--types', 'node'];
  return run(process.execPath, [join(tools, 'typescript/bin/tsc'), ...options, ...more, name], app);
}

async function compile(name, text, ...more) {
  const { code, said } = await judge(name, text, ...more);
  assert.equal(code, 0, said);
}

test('CommonJS knows it, too', async (t) => {
  if (skip) return t.skip(skip);
  const text = `import { ChoreoClient, type Keyframe } from 'choreo-client';\nnew ChoreoClient('one:1').close();\nexport const key: Keyframe = { id: 'a', time: 2, pose: { rotations: [] } };\n`;
  await compile('common.ts', text, '--module', 'commonjs', '--moduleResolution', 'node10');
  if (!process.features.require_module) return; // before Node.js 20.19 and 22.12
  await writeFile(join(app, 'common.cjs'), "const { ChoreoClient } = require('choreo-client');\nnew ChoreoClient('one:1').close();\n");
  const { code, said } = await run(process.execPath, ['common.cjs'], app);
  assert.equal(code, 0, said);
});

test("the pages' programs are TypeScript, too", async (t) => {
  if (skip) return t.skip(skip);
  const page = await readFile(join(root, 'client/node/README.md'), 'utf8');
  const [first] = /(?<=^```js\n)[^`]+/m.exec(page);
  await compile('page.ts', `declare function draw(places: number[], turns: number[]): void;\n${first}`);
  const [show] = /(?<=^```js\n)import [^`]+/m.exec(await readFile(join(root, 'docs/character.md'), 'utf8'));
  const scene = 'declare const gltf: { scene: Object3D }, renderer: { setAnimationLoop(draw: () => void): void }, audio: { currentTime: number };';
  const frames = 'declare const header: Header; declare function onFrames(hear: (frames: Frames) => void): void;';
  const types = "import type { Frames, Header } from 'choreo-client';\nimport type { Object3D } from 'choreo-client/character';";
  await compile('show.ts', `${types}\n${scene}\n${frames}\n${show}`);
});

test('its types know the messages', async (t) => {
  if (skip) return t.skip(skip);
  const wrong = `
// @ts-expect-error: no such field
requests.push({ keyframe: { id: 'b', frames: 40, pose: { rotations: [] } } });
for await (const answer of client.streamDance(requests)) {
  // @ts-expect-error: 64 bits are text
  frames = answer.frames!.first_frame;
}
// @ts-expect-error: text is no time
requests.push({ keyframe: { id: 'b', time: '6', pose: { rotations: [] } } });
// @ts-expect-error: it is tokenFile
new ChoreoClient([], { token_file: 'x' });
// @ts-expect-error: text is no music
requests.push({ audio: { data: 'song.mp3' } });
requests.push({ audio: { data: new Float32Array(9) } }, { audio: { data: new ArrayBuffer(9) } }, { config: { seed: 1n } });
import type { Continuation, DanceConfig, Event, Frames, Header, Keyframe, RotationEncoding, StreamDanceResponse } from 'choreo-client';
const encoding: RotationEncoding = 'ROTATION_ENCODING_QUATERNION';
const config: DanceConfig = { encoding };
const key: Keyframe = { id: 'a', time: 2, pose: { rotations: [] } };
requests.push({ config }, { keyframe: key });
function hear({ header, frames, event, continuation }: StreamDanceResponse): [Header?, Frames?, Event?, Continuation?] {
  return [header ?? undefined, frames ?? undefined, event ?? undefined, continuation ?? undefined];
}
const counted: number | undefined = hear((await client.streamDance(requests).next()).value!)[1]?.count;
`;
  await compile('dance.ts', program + wrong, '--noUncheckedIndexedAccess');
});

test('requests that lack, misname or mistype something are refused by the compiler, from generators, too', async (t) => {
  if (skip) return t.skip(skip);
  const requests = `
import { ChoreoClient, libraryPose, pose, readKeys, type Continuation, type Keyframe, type StreamDanceRequest, type StreamDanceResponse } from 'choreo-client';
const client = new ChoreoClient('one:1');
const model = (await client.info()).models[0]!;
const armsUp = pose(model.skeleton, { head: [0, 0, 0] });
const time: number = 2;
async function* right(kept?: Continuation) {
  yield { config: { seed: 1n, frames: 60, continuation: kept } };
  yield { audio: { data: new Float32Array(9), first_sample: 0 } };
  yield { keyframe: { id: 'a', time, pose: armsUp } };
  yield { keyframe: { id: 'a', frame: '40', pose: armsUp, mask: { joints: [1, 2] }, hit: 1 } };
  yield { remove_keyframe: { id: 'a' } };
  yield { generate_until: { frame: 40 } };
  yield { end_of_audio: {} };
  yield { keyframes_complete: {} };
}
let kept: Continuation | undefined;
for await (const answer of client.streamDance(right(kept))) if (answer.response === 'continuation') kept = answer.continuation;
const list: StreamDanceRequest[] = [{ config: {} }, ...readKeys({}, model.skeleton), { keyframe: { id: 'b', interval_after_previous: 9, pose: libraryPose('dab', model.skeleton) } }];
client.streamDance(list);
client.streamDance([{ config: { seed: '1' } }, ...readKeys({}, model.skeleton)]);
client.streamDance([{ config: kept ? { continuation: kept } : {} }]);
declare const queue: AsyncIterable<StreamDanceRequest>;
client.streamDance(queue, { onResume: ({ frame }) => frame });
client.generateTransition({ config: {}, frames: 30, target: armsUp });
declare const event: StreamDanceResponse;
if (event.header) client.streamDance([{ config: { seed: event.header.seed } }]);
async function* forwarded(inner: AsyncIterable<StreamDanceRequest>) { yield { config: {} }; yield* inner; }
client.streamDance(forwarded(queue));

async function* misspelt() { yield { config: { sead: 1 } }; }
async function* misspelt2() { yield { config: {} }; yield { keyframe: { id: 'a', time: 2, pose: armsUp, mask: { joint: [1] } } }; }
async function* text() { yield { keyframe: { id: 'a', time: '2', pose: armsUp } }; }
async function* poseless() { yield { keyframe: { id: 'a', time: 2 } }; }
async function* timeless() { yield { keyframe: { id: 'a', pose: armsUp } }; }
async function* both() { yield { keyframe: { id: 'a', time: 2, frame: 60, pose: armsUp } }; }
async function* unknown() { yield { config: {} }; yield { keyFrame: { id: 'a', time: 2, pose: armsUp } }; }
// @ts-expect-error: no such field
client.streamDance(misspelt());
// @ts-expect-error: nor in a mask
client.streamDance(misspelt2());
// @ts-expect-error: text is no time
client.streamDance(text());
// @ts-expect-error: a key has a pose
client.streamDance(poseless());
// @ts-expect-error: and a time
client.streamDance(timeless());
// @ts-expect-error: one
client.streamDance(both());
// @ts-expect-error: no such request
client.streamDance(unknown());
// @ts-expect-error: as above
list.push({ keyframe: { id: 'a', time: 2 } });
// @ts-expect-error: as above
list.push({ config: {}, end_of_audio: {} });
// @ts-expect-error: nothing
list.push({});
// @ts-expect-error: as above
list.push({ remove_keyframe: {} });
// @ts-expect-error: as above
list.push({ config: { allow_inexact_resume: 'no' } });
const misnamed = { config: {}, frames: 30, tarjet: armsUp };
// @ts-expect-error: as above
client.generateTransition(misnamed);
// @ts-expect-error: as above
client.generateTransition({ config: {} });
// @ts-expect-error: as above
const posed: Keyframe = { id: 'a', time: 2 };
`;
  await compile('requests.ts', requests, '--noUncheckedIndexedAccess');
});

test("the compiler's errors end with what is wrong, and where", async (t) => {
  if (skip) return t.skip(skip);
  const yielding = (request, at) => `async function* wrong${at}() { yield { config: {} }; yield ${request}; }\nclient.streamDance(wrong${at}());\n`;
  const wrong = {
    "{ keyframe: { id: 'a', time: '2', pose: armsUp } }": /Types of property 'time' are incompatible.\n *Type 'string' is not assignable to type 'number'/,
    "{ keyframe: { id: 'a', time: 2 } }": /Property 'pose' is missing in type '.*' but required in type 'KeyframeWithTime'/,
    "{ keyframe: { id: 'a', pose: armsUp } }": /is missing in type '.*' but required in type 'KeyframeWith/,
    "{ keyFrame: { id: 'a', time: 2, pose: armsUp } }": /is not assignable to type '"there is no field keyFrame"'/,
    "{ keyframe: { id: 'a', time: 2, frame: 60, pose: armsUp } }": /is not assignable to type '"another field of this message excludes this one"'/,
  };
  const head = "import { ChoreoClient, pose } from 'choreo-client';\nconst client = new ChoreoClient('one:1');\nconst armsUp = pose((await client.info()).models[0]!.skeleton);\n";
  const { said } = await judge('wrongs.ts', head + Object.keys(wrong).map(yielding).join(''));
  const errors = said.split(/^wrongs\.ts/m).slice(1);
  assert.equal(errors.length, 5, said);
  Object.values(wrong).forEach((what, at) => assert.match(errors[at].trimEnd().split('\n').slice(-2).join('\n'), what));
});

test('a character dances from the package, in a browser, too', async (t) => {
  if (skip) return t.skip(skip);
  const text = `
import { bonesOf, Character, gltfBones, Player, type Bone } from 'choreo-client/character';
import { ChoreoClient, type StreamDanceResponse } from 'choreo-client';
declare const scene: { children: { name: string; children: never[] }[]; frame: number };
const { bones, objects } = bonesOf(scene);
const made: Bone[] = gltfBones({ nodes: [] });
let character: Character;
let player: Player;
let dance: ReturnType<Character['dance']>;
export function hear(answer: StreamDanceResponse): void {
  if (answer.header?.skeleton) {
    character = new Character(bones.concat(made), answer.header.skeleton, { map: { left_foot: null } });
    dance = character.dance(answer.header);
    player = new Player(answer.header, { keep: 1 });
  }
  if (answer.frames) player.add(dance.add(answer.frames));
  const { state, pose } = player.at(1);
  if (state === 'playing' && pose) character.show(pose, objects);
  // @ts-expect-error: no such option
  new Character(bones, answer.header!.skeleton!, { bones: {} });
}
new ChoreoClient('one:1').close();
`;
  await compile('character.ts', text);
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
  const page = await readFile(join(root, 'docs/web.md'), 'utf8');
  const programs = [...page.matchAll(/(?<=^```js\n)[^`]+(?:`[^`]+`[^`]+)*(?=^```)/gm)].map(([text]) => text);
  assert.equal(programs.length, 2);
  await compile('serve.ts', programs.join(''));
  const wrong = `
import { ChoreoClient } from 'choreo-client';
import { connectDance } from 'choreo-client/page';
import { serveDance } from 'choreo-client/serve';
const client = new ChoreoClient('one:1');
serveDance(client, async (url, request) => ({ seconds: 9, music: new Uint8Array(9), config: { seed: url.searchParams.get('seed') ?? '1' } }));
// @ts-expect-error: how long?
serveDance(client, () => ({ music: new Uint8Array(9) }));
const dance = connectDance('/dance', { onKey: ({ id, refused }) => console.log(id, refused) });
const told: Promise<{ id: string; time: number }> = dance.setKey({ pose: 'kick' });
// @ts-expect-error: no pose
dance.setKey({ id: 'a', time: 2 });
`;
  await compile('wrong.ts', wrong, '--lib', 'es2022,dom');
  const asked = "import { serveDance } from 'choreo-client/serve';\nimport { connectDance } from 'choreo-client/page';\nconsole.log(typeof serveDance, typeof connectDance);\n";
  await writeFile(join(app, 'asked.js'), asked);
  assert.equal((await run(process.execPath, ['asked.js'], app)).said, 'function function\n');
});

test('asking what an answer or an event holds narrows its type', async (t) => {
  if (skip) return t.skip(skip);
  const narrowed = `
import type { Event, GenerateTransitionResponse, StreamDanceResponse } from 'choreo-client';
function tell(event: Event): string {
  switch (event.event) {
    case 'keyframe_reached':
      return event.keyframe_reached.id + event.frame;
    case 'beat':
      return event.beat.source;
    case 'warning':
      // @ts-expect-error: no beat
      event.beat.source;
      return event.warning.message;
  }
  if (event.keyframe_rejected) return event.event satisfies 'keyframe_rejected';
  return event.event satisfies undefined ?? 'of a newer server';
}
function hear(answer: StreamDanceResponse): string | number {
  // @ts-expect-error: nobody has asked
  answer.frames.count;
  if (answer.response === 'frames') return answer.frames.count;
  if (answer.response === 'event') return tell(answer.event);
  return answer.summary ? (answer.summary.report?.frames ?? 0) : answer.response satisfies 'header' | 'continuation' | undefined ?? '';
}
function compare(answer: GenerateTransitionResponse): number {
  return answer.response === 'summary' ? answer.summary.candidates.length : 0;
}
`;
  await compile('narrowed.ts', narrowed);
});

test('the package has the version of the server', async () => {
  const [, version] = /project\(choreo VERSION (\S+)/.exec(await readFile(join(root, 'CMakeLists.txt'), 'utf8'));
  assert.equal(JSON.parse(await readFile(join(root, 'client/node/package.json'))).version, version);
});
