// The API in TypeScript without client/node: `buf generate` makes its messages by protoc-gen-es, and a client of gRPC-Web calls a choreod,
// which $CHOREO_SERVER names, through a proxy that is not ours.
import assert from 'node:assert/strict';
import { execFile } from 'node:child_process';
import { once } from 'node:events';
import { cp, mkdtemp, readFile, rm, symlink, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { ChoreoClient } from '../../client/node/src/index.js';

const root = fileURLToPath(new URL('../../', import.meta.url));
const sources = join(root, 'tests/examples/es');
const tools = join(root, 'client/node/node_modules');
const buf = join(root, 'tests/proto/buf/node_modules/@bufbuild', `buf-linux-${process.arch === 'arm64' ? 'aarch64' : 'x64'}`, 'bin/buf');
let app; // a folder with the sources and what is made of them

function run(program, args) {
  return new Promise((resolve) => {
    const env = { ...process.env, PATH: `${join(app, 'node_modules/.bin')}:${process.env.PATH}` }; // as npx has it
    execFile(program, args, { cwd: app, env }, (failure, out, err) => resolve({ code: failure?.code ?? 0, said: out + err }));
  });
}

before(async () => {
  app = await mkdtemp(join(tmpdir(), 'choreo-'));
  for (const name of ['transition.ts', 'transition_types.ts', 'proxy.ts', 'package.json']) await cp(join(sources, name), join(app, name));
  await cp(join(root, 'proto'), join(app, 'proto'), { recursive: true });
  await symlink(join(sources, 'node_modules'), join(app, 'node_modules'));
  // As docs/programs.md has it.
  const page = await readFile(join(root, 'docs/programs.md'), 'utf8');
  await writeFile(join(app, 'buf.gen.yaml'), /^# buf\.gen\.yaml\n([^`]+)```$/m.exec(page)[1]);
  const { code, said } = await run(buf, ['generate', 'proto']);
  assert.equal(code, 0, said);
});
after(() => rm(app, { recursive: true }));

test('the messages of protoc-gen-es type-check, and dance through a proxy of gRPC-Web', async () => {
  const options = ['--strict', '--noUncheckedIndexedAccess', '--module', 'nodenext', '--target', 'es2022', '--lib', 'es2022,dom,dom.iterable'];
  const types = ['--typeRoots', join(tools, '@types'), '--types', 'node', '--skipLibCheck'];
  const { code, said } = await run(process.execPath, [join(tools, 'typescript/bin/tsc'), ...options, ...types, 'transition_types.ts', 'proxy.ts']);
  assert.equal(code, 0, said);

  const made = (name) => import(pathToFileURL(join(app, name)));
  const { fieldsOf, firstModel, ways } = await made('transition.js');
  const { good } = await made('transition_types.js');
  const server = (await made('proxy.js')).proxy(`http://${process.env.CHOREO_SERVER}`).listen(0, '127.0.0.1');
  await once(server, 'listening');
  const address = `http://127.0.0.1:${server.address().port}`;
  const client = new ChoreoClient(process.env.CHOREO_SERVER);
  try {
    const model = await firstModel(address);
    assert.equal(model.skeleton.jointNames.length, 24);

    // What a browser asks first, for a page of another origin.
    const headers = { Origin: 'http://page.test', 'Access-Control-Request-Method': 'POST', 'Access-Control-Request-Headers': 'content-type,x-grpc-web' };
    const preflight = await fetch(`${address}/choreo.v1.Choreography/GenerateTransition`, { method: 'OPTIONS', headers });
    assert.equal(preflight.status, 204);
    const allowed = (what) => preflight.headers.get(`access-control-${what}`)?.toLowerCase() ?? '';
    assert.equal(allowed('allow-origin'), '*');
    assert.match(allowed('allow-methods'), /post/);
    for (const header of ['content-type', 'x-grpc-web']) assert.ok(allowed('allow-headers').split(',').includes(header), header);
    for (const header of ['grpc-status', 'grpc-message']) assert.ok(allowed('expose-headers').split(',').includes(header), header);

    const { rotations, best } = await ways(address, good);
    const direct = [[], []];
    let bestDirect;
    for await (const { frames, summary } of client.generateTransition({ config: { seed: '1' }, frames: 30, candidates: 2 })) {
      if (frames) direct[frames.candidate].push(...frames.rotations);
      if (summary) bestDirect = summary.candidates[0].candidate;
    }
    assert.equal(rotations[0].length, 30 * 24 * 3);
    assert.deepEqual({ rotations, best }, { rotations: direct, best: bestDirect });

    await assert.rejects(ways(address, { ...good, frames: 5000 }), (error) => {
      assert.match(error.message, /^\[invalid_argument\] frames: 5000/);
      assert.deepEqual(fieldsOf(error), ['frames']);
      return true;
    });
  } finally {
    client.close();
    server.close();
    server.closeAllConnections();
  }
});
