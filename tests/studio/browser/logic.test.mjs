// What the studio's page reckons by itself, without a browser.
//   node --test logic.test.mjs
import assert from 'node:assert/strict';
import { readdirSync, readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { test } from 'node:test';

const page = new URL('../../../studio/page/', import.meta.url);
const { buildSync } = createRequire(new URL('package.json', page))('esbuild');

const limits = { songS: 600, hit: 3, keyDistance: 2, holdStepS: 0.2, holdS: 60, usualHit: 1, tooNearS: 0.2, dancers: 64,
  stageM: 1000, usualApartM: 0.2, usualMusicDynamics: 0.5, usualVariation: 0.3, slowestTempo: 50, fastestTempo: 200, wayFromHoldS: 0.5,
  editAroundS: 2, nextKeyNearS: 4 };

/// A module of the page, with all that it imports, and the program's limits.
async function load(name, more = '') {
  const stdin = { contents: `${more} export * from './project/${name}'; export { setLimits } from './project/limits';`, resolveDir: fileURLToPath(new URL('src', page)) };
  const { outputFiles } = buildSync({ stdin, bundle: true, write: false, format: 'esm', platform: 'node' });
  const loaded = await import(`data:text/javascript;base64,${Buffer.from(outputFiles[0].contents).toString('base64')}`);
  loaded.setLimits(limits);
  return loaded;
}

const { reachOf } = await load('edit_reach');
const { roughly, timeLeft } = await load('time_left');
const { emptyProject, freeId, handPoses, parts, freeName, sorted, displayName, trimmed, withMarker } = await load('project');
const { ProjectSchema, create, fromBinary, projectMessage, readProject, toBinary } = await load('project_file',
  "export { ProjectSchema } from './generated/studio/studio_pb'; export { create, fromBinary, toBinary } from '@bufbuild/protobuf';");
const { counted, countedLive, doubled, eight, halved, isDownbeat, later, nudged, placeAmong, pulseOf, secondOf, tapped, tempo, withOne } = await load('counts');
const { sections } = await load('form');
const { mostUnlike, unlikeness } = await load('unlike');
const { only, toQuaternion, toVector, turned, heading } = await load('body');

const still = (joints) => ({ root: [0, 1, 0], rotations: Array(3 * joints).fill(0) });
const near = (a, b) => assert.ok(Math.abs(a - b) < 1e-6, `${a}, not ${b}`);

test('an edit reaches the next keys where these are near, else two seconds', () => {
  const at = (frame, hold = 0) => ({ frame, hold });
  const reach = (before, after, frames) => reachOf(before.map((key) => at(...key)), after.map((key) => at(...key)), frames, 900, 30);
  assert.deepEqual(reach([], [[450]], [450]), [390, 510], 'in a free dance');
  assert.deepEqual(reach([[450]], [], [450]), [390, 510], 'without it');
  assert.deepEqual(reach([], [[30]], [30]), [-1, 90], 'near the beginning');
  assert.deepEqual(reach([], [[880]], [880]), [820, 900], 'near the end');
  assert.deepEqual(reach([[350], [500]], [[350], [450], [500]], [450]), [350, 500], 'between keys');
  assert.deepEqual(reach([[100], [800]], [[100], [450], [800]], [450]), [390, 510], 'far from keys');
  assert.deepEqual(reach([[100]], [[600]], [100, 600]), [40, 660], 'where it was and is');
  assert.deepEqual(reach([[100, 300]], [[100, 30]], [100]), [40, 460], 'what was held before');
  assert.deepEqual(reach([[100, 300]], [[100, 85], [200]], [200]), [185, 460], 'in the hold of another one');
  assert.deepEqual(reach([[400]], [[400, 60]], [400]), [340, 520], 'held now');
});

// Lowest first; files of no room are above all.
const rooms = ['generated', 'project', 'session', 'scene', 'timeline', 'panels', ''];

test('no module of the page imports itself, or one of a higher room', () => {
  const folder = new URL('src/', page);
  const files = readdirSync(folder, { recursive: true }).filter((file) => /\.tsx?$/.test(file) && !file.startsWith('generated'));
  const nameOf = (file) => file.replace(/\.tsx?$/, '');
  const imports = new Map(files.map((file) => [nameOf(file), [...readFileSync(new URL(file, folder), 'utf8')
    .matchAll(/from '(\.[^']*)'/g)].map(([, from]) => join(dirname(file), from))]));
  const level = (name) => rooms.indexOf(name.includes('/') ? name.split('/')[0] : '');
  assert.ok(imports.size > 60);
  const done = new Set();
  const visit = (name, way) => {
    assert.ok(!way.includes(name), [...way, name].join(' > '));
    if (done.has(name)) return;
    for (const other of imports.get(name) ?? []) {
      assert.ok(level(other) >= 0 && level(other) <= level(name), `${name} > ${other}`);
      visit(other, [...way, name]);
    }
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

test('ids are free, and shown without underscores', () => {
  assert.equal(freeId([], 'kick'), 'kick');
  assert.equal(freeId([{ id: 'kick' }, { id: 'kick-2' }], 'kick-2'), 'kick-3');
  assert.equal(displayName('side_reach'), 'side reach');
});

test('parts and hands have the names of the API', () => {
  assert.deepEqual(parts, ['trunk', 'left arm', 'right arm', 'left leg', 'right leg']);
  assert.deepEqual(handPoses, ['rest', 'relaxed', 'open', 'fist', 'point']);
});

test('a pose is held as far as the next key', () => {
  const keys = [{ id: 'bow', frame: 30, hold: 9, hit: 3 }, { id: 'kick', frame: 40, hold: 6, hit: null }, { id: 'dab', frame: 58, hold: 9, hit: 0 }];
  assert.deepEqual(trimmed(keys, 65, 30).map(({ hold }) => hold), [6, 6, 6]);
  // What is held to the last frame is held to just that one.
  assert.equal(trimmed([{ ...keys[1], frame: 60, hold: 39 }], 100, 30)[0].hold, 39);
  // A key that comes in the middle of a hold leaves time for the way to it.
  const inside = [{ ...keys[0], frame: 0, hold: 90 }, { ...keys[0], frame: 60, hold: 0 }];
  assert.deepEqual(trimmed(inside, 200, 30).map(({ hold }) => hold), [42, 0]);
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
  const key = { id: 'bow', frame: 15, pose: still(2), hasPlace: true, joints: [1], hold: 6, hit: 2.5, hands: 4 };
  const free = { id: 'dab', frame: 40, pose: still(2), hasPlace: false, joints: null, hold: 0, hit: null, hands: 0 };
  const plain = { facing: 0, mirrored: false, after: 0, inCounts: true, seed: null, style: '', keys: null };
  const dancers = [{ id: 'ada', x: 0, z: 0.6, ...plain }, { id: 'ben', x: -1.4, z: -0.4, ...plain, mirrored: true, facing: 90, after: 4, seed: 3 },
    { id: 'cy', x: 1, z: 0, ...plain, after: 2.5, inCounts: false, style: 'happy', keys: [key] }, { id: 'dee', x: 2, z: 0, ...plain, keys: [] }];
  const beats = withOne(counted([0.5123456789, 1, 1.5], [], 3), 1);
  const usual = emptyProject('song.mp3', 4);
  const sent = (project) => readProject(fromBinary(ProjectSchema, toBinary(ProjectSchema, create(ProjectSchema, projectMessage(project, 30)))), 30, 1);
  assert.deepEqual(sent(usual), usual);
  const project = { ...usual, markers: [{ frame: 6, name: 'the "drop", 1' }], seed: 7, style: 'wild', dynamics: 0.9, variation: 0, beats, velocities: [1, 0.25, 1, 2, 1],
    path: [{ frame: 0, x: 0, z: 0 }, { frame: 30, x: 1, z: 0.5 }], keys: [key, free], dancers, apart: 0.3 };
  assert.deepEqual(sent(project), project);
});

test('markers stand one at a moment, in order, each with a name of its own', () => {
  const [a, b] = [{ frame: 10, name: 'a' }, { frame: 20, name: 'b' }];
  assert.deepEqual(withMarker([a, b], a, { ...a, frame: 30 }), [b, { frame: 30, name: 'a' }]);
  assert.equal(withMarker([a, b], a, { ...a, frame: 20 }), null);
  assert.deepEqual(withMarker([a, b], b, { frame: 20, name: 'c' }), [a, { frame: 20, name: 'c' }]);
  assert.deepEqual(withMarker([a, b], a, null), [b]);
  assert.equal(freeName(['mark', 'mark-2'], 'mark'), 'mark-3');
});

const every = (period, count, first = 0) => Array.from({ length: count }, (_, i) => first + i * period);
const counts = ({ list }) => list.map(({ count }) => count).join('');
const inBars = (bar, count, first = 1) => every(1, count).map((i) => (i + first - 1) % bar + 1);

test('beats are counted in eights, which begin with the first bar', () => {
  assert.equal(counts(counted(every(0.5, 10), inBars(4, 10), 4)), '1234567812');
  assert.equal(counts(counted(every(0.5, 10), inBars(4, 10, 3), 4)), '7812345678');
  assert.equal(counts(counted(every(0.5, 10), inBars(3, 10), 3)), '1234561234');
  assert.equal(counts(counted(every(0.5, 10), inBars(2, 10), 2)), '1234567812');
  // A bar that is cut short: they begin anew.
  assert.equal(counts(counted(every(0.5, 9), [1, 2, 3, 1, 2, 3, 4, 1, 2], 4)), '123123456');
  assert.equal(counts(counted([], [], 0)), '');
  assert.deepEqual([4, 3, 2, 7].map(eight), [8, 6, 8, 7]);
  assert.deepEqual([1, 4, 5].map((count) => isDownbeat({ time: 0, count }, 4)), [true, false, true]);
});

test('live beats are counted as they come, from their first downbeat on', () => {
  const heard = (downs, count) => every(0.5, count).map((time, i) => ({ time, isDown: downs.includes(i) }));
  assert.equal(counts(countedLive(heard([2, 6, 10], 12))), '001234567812');
  const threes = countedLive(heard([0, 3, 6], 8));
  assert.equal(threes.bar, 3);
  assert.equal(counts(threes), '12345612');
  assert.deepEqual(countedLive([]), { bar: 4, list: [] });
});

test('beats are halved, doubled and nudged, and one of them is a 1', () => {
  const beats = counted(every(0.5, 8, 1), inBars(4, 8, 4), 4);
  assert.equal(counts(beats), '81234567');
  assert.deepEqual(halved(beats).list.slice(0, 3).map(({ time, count }) => [time, count]), [[1.5, 1], [2.5, 2], [3.5, 3]]);
  const twice = doubled(beats);
  assert.equal(twice.list.length, 15);
  assert.deepEqual(twice.list.slice(0, 4).map(({ time, count }) => [time, count]), [[1, 7], [1.25, 8], [1.5, 1], [1.75, 2]]);
  assert.deepEqual([beats, halved(beats), twice].map((some) => Math.round(tempo(some))), [120, 60, 240]);
  assert.equal(doubled(counted([1, 1.5, 2, 9, 9.5, 10], [], 4)).list.length, 10, 'none in a pause');
  const late = nudged(beats, 0.01, 4.5);
  assert.deepEqual([late.list[0], late.list.length], [{ time: 1.01, count: 8 }, 7]);
  assert.equal(counts(nudged(counted(every(0.5, 6, 1), [0, 0, 1, 2, 3, 4], 4), 0.01, 9)), '781234', 'each has a count');
  assert.equal(counts(withOne(beats, 2.1)), '78123456');
});

test('a pause gets no beats, and bars stay where they begin after it', () => {
  const times = [0.2, 0.7, 1.2, 1.7, 2.2, 5.2, 5.7, 6.2, 6.7, 7.2];
  const beats = counted(times, [1, 2, 3, 4, 1, 1, 2, 3, 4, 1], 4);
  const downbeats = ({ bar, list }) => list.filter((beat) => isDownbeat(beat, bar)).map(({ time }) => time);
  assert.deepEqual(downbeats(withOne(beats, 2.2)), [0.2, 2.2, 5.2, 7.2]);
  assert.deepEqual(downbeats(withOne(beats, 1.2)), [1.2, 6.2]);
  assert.deepEqual(downbeats(withOne(counted(times, [], 4), 0.2)), [0.2, 2.2, 6.2], 'by time');
  assert.deepEqual(halved(counted(times, [1, 2, 3, 4, 1, 4, 1, 2, 3, 4], 4)).list.map(({ time }) => time), [0.2, 1.2, 2.2, 5.7, 6.7]);
  // A hole is a pause; another tempo is none.
  assert.equal(doubled(counted([1, 1.5, 2, 3, 3.5, 4], [], 4)).list.length, 10);
  assert.equal(doubled(counted([...every(0.5, 7), ...every(1, 6, 4)], [], 4)).list.length, 25);
});

test('counts later are the beats further on, and go on where there are none', () => {
  const times = [1, 1.5, 2.1, 2.5];
  near(placeAmong(1.8, times), 1.5);
  near(placeAmong(0.5, times), -1);
  [[1, 2, 2.1], [1.8, 1, 2.3], [2.1, 3, 3.3], [0.5, 1, 1], [0, 1, 0.5]].forEach(([from, counts, to]) => near(later(from, counts, times), to));
});

test('frames stand for counts, whose rounding does not move', () => {
  const times = every(0.47, 40, 0.25);
  const frameAt = (count) => Math.round(later(times[0], count, times) * 30);
  for (let count = 0; count < 20; count += 0.5)
    for (const by of [1, 7, 8]) assert.equal(Math.round(later(secondOf(frameAt(count), 30, times), by, times) * 30), frameAt(count + by), `${count} and ${by}`);
  near(secondOf(10, 30, []), 1 / 3);
});

test('taps have a pulse, also where some are missing', () => {
  assert.equal(pulseOf([1, 2, 3]), null);
  const { phase, period } = pulseOf([10.02, 10.49, 11.01, 12, 12.51]);
  near(Math.round(period * 50) / 50, 0.5);
  near(Math.round(phase * 20) / 20, 10);
});

test('taps say which beats, and the song exactly when', () => {
  const heard = counted(every(0.5, 40), inBars(4, 40), 4);
  const hand = (period, first) => every(period, 8, first).map((time, i) => time + 0.02 * (-1) ** i);
  const times = (found) => found.list.map(({ time }) => time);
  // As they are; half as fast, on the second and fourth; twice as fast; beside them.
  assert.deepEqual(times(tapped(heard, heard, hand(0.5, 4), 20)), times(heard));
  assert.deepEqual(times(tapped(heard, heard, hand(1, 4.5), 20)), every(1, 20, 0.5));
  assert.deepEqual(times(tapped(heard, heard, hand(0.25, 4), 20)).slice(0, 4), [0, 0.25, 0.5, 0.75]);
  near(Math.abs(times(tapped(heard, heard, hand(0.5, 4.25), 20))[3] - 1.5), 0.25);
  // A 1 stays where it was, and is the first tap where there was none.
  assert.equal(tapped(heard, heard, hand(0.5, 4), 20).list[8].count, 1);
  // Another tempo, and a song without beats: evenly over all of it.
  const other = tapped(heard, heard, every(0.4, 8, 3), 20);
  assert.deepEqual([other.list.length, Math.round(tempo(other))], [50, 150]);
  const none = tapped(counted([], [], 0), counted([], [], 0), every(0.4, 8, 3), 20);
  assert.equal(none.list.find(({ time }) => Math.abs(time - 3) < 0.01).count, 1);
  assert.equal(tapped(heard, heard, [1, 2], 20), null);
});

test('what comes back has the letter of what it is like', () => {
  const letters = (passages) => sections(passages).map(({ from, to, letter }) => `${letter} ${from}-${to}`);
  assert.deepEqual(letters([]), []);
  assert.deepEqual(letters([{ from: 60, to: 90, like: 10 }]), ['A 10-40', 'A 60-90']);
  // Twice, the second time as the first return; and another part.
  assert.deepEqual(letters([{ from: 40, to: 60, like: 0 }, { from: 60, to: 70, like: 25 }, { from: 80, to: 100, like: 40 }]),
    ['A 0-20', 'B 25-35', 'A 40-60', 'B 60-70', 'A 80-100']);
  // One that is like a part and what follows it.
  assert.deepEqual(letters([{ from: 40, to: 60, like: 0 }, { from: 80, to: 110, like: 0 }]), ['A 0-30', 'A 40-60', 'A 80-110']);
  // Longer than its way back: again and again.
  assert.deepEqual(letters([{ from: 20, to: 60, like: 0 }]), ['A 0-20', 'A 20-40', 'A 40-60']);
  assert.deepEqual(sections([{ from: 60, to: 90, like: 10 }])[0].others, [60]);
});
