// What the studio's page reckons by itself, without a browser.
//   node --test logic.test.mjs
import assert from 'node:assert/strict';
import { readdirSync, readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { fileURLToPath } from 'node:url';
import { test } from 'node:test';

const page = new URL('../../../studio/page/', import.meta.url);
const { buildSync } = createRequire(new URL('package.json', page))('esbuild');

/// A module of the page, with all that it imports.
async function load(name) {
  const entry = fileURLToPath(new URL(`src/${name}.ts`, page));
  const { outputFiles } = buildSync({ entryPoints: [entry], bundle: true, write: false, format: 'esm', platform: 'node' });
  return import(`data:text/javascript;base64,${Buffer.from(outputFiles[0].contents).toString('base64')}`);
}

const { roughly, timeLeft } = await load('time_left');
const { closest, emptyProject, freeId, sorted, spoken } = await load('project');
const { fromJson, inOrder, toJson } = await load('project_file');
const { mostUnlike, unlikeness } = await load('unlike');
const { only, toQuaternion, toVector, turned, heading } = await load('body');

const still = (joints) => ({ root: [0, 1, 0], rotations: Array(3 * joints).fill(0) });
const near = (a, b) => assert.ok(Math.abs(a - b) < 1e-6, `${a}, not ${b}`);

test('no module of the page imports itself, by whatever way', () => {
  const folder = new URL('src/', page);
  const imports = new Map(readdirSync(folder).filter((name) => /\.tsx?$/.test(name)).map((name) =>
    [name.replace(/\.tsx?$/, ''), [...readFileSync(new URL(name, folder), 'utf8').matchAll(/from '\.\/(\w+)'/g)].map(([, from]) => from)]));
  assert.ok(imports.size > 30);
  const done = new Set();
  const visit = (name, way) => {
    assert.ok(!way.includes(name), [...way, name].join(' > '));
    if (done.has(name)) return;
    for (const other of imports.get(name) ?? []) visit(other, [...way, name]);
    done.add(name);
  };
  for (const name of imports.keys()) visit(name, []);
});

test('time left is told roughly, and not before anybody knows', () => {
  assert.equal(roughly(3), 'a few seconds');
  assert.equal(roughly(12), 'about 15 s');
  assert.equal(roughly(61), 'about 2 min');
  assert.equal(timeLeft(0, 100), '');
  assert.equal(timeLeft(0.5, 1), '');
  assert.equal(timeLeft(0.25, 10), 'about 30 s');
  assert.equal(timeLeft(1, 10), 'a few seconds');
});

test('ids are free, and spoken without underscores', () => {
  assert.equal(freeId([], 'kick'), 'kick');
  assert.equal(freeId([{ id: 'kick' }, { id: 'kick-2' }], 'kick-2'), 'kick-3');
  assert.equal(spoken('side_reach'), 'side reach');
});

test('keys are sorted, and no list is changed on the way', () => {
  const keys = [{ frame: 9 }, { frame: 3 }];
  assert.deepEqual(sorted(keys).map(({ frame }) => frame), [3, 9]);
  assert.equal(keys[0].frame, 9);
});

test('motions are compared where they differ', () => {
  const motion = (angle) => ({ pose: (frame) => ({ root: [0, 1, 0], rotations: [0, angle * frame * (10 - frame), 0] }) });
  assert.equal(unlikeness([motion(0.01), motion(0.02)], 0), 0);
  assert.equal(mostUnlike([motion(0), motion(0.02), motion(0.04)], 0, 10), 6);
  // Two that are alike are not told apart by a third one.
  near(unlikeness([motion(0), motion(0), motion(0.04)], 5), 0);
});

test('turns are read back as they were written', () => {
  const turn = [0.3, -0.9, 0.4];
  toVector(toQuaternion(turn, 0)).forEach((value, i) => near(value, turn[i]));
  near(heading(turned(still(2), 0.7)), 0.7);
});

test('of a pose some joints are taken', () => {
  const [before, after] = [still(2), { root: [5, 1, 0], rotations: [1, 2, 3, 4, 5, 6] }];
  assert.deepEqual(only(before, after, null), after);
  assert.deepEqual(only(before, after, [1]), { root: [0, 1, 0], rotations: [0, 0, 0, 4, 5, 6] });
  assert.deepEqual(only(before, after, [0]), { root: [5, 1, 0], rotations: [1, 2, 3, 0, 0, 0] });
});

test('a project is read as it was written', () => {
  const key = { id: 'bow', frame: 15, pose: still(2), hasPlace: true, asks: null };
  const project = { ...emptyProject('song.mp3', 4), seed: 7, dynamics: 0.9, variation: 0, path: [{ frame: 0, x: 0, z: 0 }, { frame: 30, x: 1, z: 0.5 }], keys: [key] };
  const text = toJson(project, 30, ['pelvis', 'left_hip']);
  const said = [];
  const read = fromJson(text, 'p.json', { fps: 30, styles: [] }, (words) => said.push(words));
  assert.deepEqual({ ...read, keys: [key] }, project);
  assert.deepEqual(said, []);
  assert.equal(JSON.parse(text).keyframes[0].time, 0.5);
});

test('what an old project does not say is as usual, and what cannot be is named', () => {
  const known = { fps: 30, styles: [] };
  const read = (more) => fromJson(JSON.stringify({ studio: 1, keyframes: [], ...more }), 'p.json', known, () => {});
  assert.deepEqual([read({}).dynamics, read({}).variation], [0.5, 0.3]);
  assert.throws(() => read({ music_dynamics: 1.5 }), /^Error: p.json: music_dynamics: 1.5 is not a number from 0 to 1/);
  assert.throws(() => read({ variation: 'much' }), /^Error: p.json: variation: "much" is not a number/);
});

test('keys that stand too close are refused', () => {
  const keys = [0, closest - 1].map((frame, i) => ({ id: `k${i}`, frame, pose: still(1) }));
  assert.throws(() => inOrder(keys, 'p.json', 30), /"k0" and "k1" stand closer/);
});
