// client/node/character/player.js: what is shown when.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Player } from '../../client/node/character/index.js';

const header = { frame_rate: 30 };
/** A pose of one bone, turned about X by so many radians, at x. */
const pose = (frame, angle = frame / 30, x = frame) => ({ frame, turns: [Math.sin(angle / 2), 0, 0, Math.cos(angle / 2)], places: [x, 1, 0] });
const poses = (from, to) => Array.from({ length: to - from }, (_, i) => pose(from + i));
const angleOf = ({ turns: [x, , , w] }) => 2 * Math.atan2(x, w);
const near = (value, wanted) => assert.ok(Math.abs(value - wanted) < 1e-9, `${value}, not ${wanted}`);

test('a page that draws at its own rate sees what is between frames', () => {
  const player = new Player(header);
  player.add(poses(0, 61));
  for (const second of [0, 1 / 60, 0.5, 1.017, 1.999, 2]) {
    const { state, pose: shown, ahead } = player.at(second);
    assert.equal(state, 'playing');
    near(angleOf(shown), second);
    near(shown.places[0], 30 * second);
    near(ahead, 2 - second);
    near(Math.hypot(...shown.turns), 1);
  }
});

test('turns go the short way round, whatever their signs', () => {
  const player = new Player(header);
  const other = pose(1, 0.2);
  player.add([pose(0, 0.1), { ...other, turns: other.turns.map((one) => -one) }, pose(2, 0.2)]);
  near(angleOf(player.at(0.5 / 30).pose), 0.15);
  near(Math.abs(player.at(1.5 / 30).pose.turns[3]), Math.cos(0.1));
});

test('who waits says so, and begins as the dance begins', () => {
  const player = new Player(header);
  assert.deepEqual(player.at(3), { state: 'waiting', pose: undefined, ahead: 0 });
  player.add(poses(30, 60));
  const early = player.at(0.2);
  assert.deepEqual([early.state, early.pose.places[0]], ['waiting', 30]);
  assert.equal(player.at(1).state, 'playing');
  near(player.ahead(1.5), 59 / 30 - 1.5);
});

test('a dancer whose poses are late holds the last one, and does not jump when they come', () => {
  const player = new Player(header, { catchUp: 0.4 });
  player.add(poses(0, 31));
  assert.equal(player.at(0.9).state, 'playing');
  const held = player.at(1.5);
  assert.deepEqual([held.state, held.ahead, held.pose.places[0]], ['starved', 0, 30]);
  player.add(poses(31, 121));
  let last = held.pose;
  for (let second = 1.5; second <= 2; second += 1 / 60) {
    const { state, pose: shown } = player.at(second);
    assert.equal(state, 'playing');
    assert.ok(angleOf(shown) - angleOf(last) < 0.1, 'no jump');
    assert.ok(angleOf(shown) >= angleOf(last));
    last = shown;
  }
  near(angleOf(last), 2);
});

test('a frame that comes again replaces the one before, in any order, and what is past is forgotten', () => {
  const player = new Player(header, { keep: 1 });
  player.add([...poses(0, 90)].reverse());
  player.add([pose(45, 9, -1)]);
  assert.equal(player.at(1.5).pose.places[0], -1);
  assert.equal(player.at(2.9).state, 'playing');
  assert.equal(player.at(2).state, 'playing', 'the clock may go back a second');
  player.add([pose(3)]);
  const past = player.at(0.1);
  assert.deepEqual([past.state, past.pose.places[0]], ['past', 57], 'not further');
});

test('a player that keeps all shows any time again', () => {
  const player = new Player(header, { keep: Infinity });
  player.add(poses(0, 3001));
  player.at(100);
  const first = player.at(0.1);
  assert.deepEqual([first.state, first.pose.places[0]], ['playing', 3]);
});

test('a frame that never came is bridged by the one before it', () => {
  const player = new Player(header);
  player.add([...poses(0, 10), ...poses(12, 40)]);
  const gap = player.at(10.5 / 30);
  assert.deepEqual([gap.state, gap.pose.places[0]], ['starved', 9]);
  assert.equal(player.at(1).state, 'playing');
});

test('the end is held', () => {
  const player = new Player(header);
  player.add(poses(0, 31));
  player.end();
  const over = player.at(7);
  assert.deepEqual([over.state, over.pose.places[0], over.ahead], ['over', 30, 0]);
  assert.equal(player.at(0.95).state, 'playing', 'and may be seen again');
});

test('what is no time or rate is refused', () => {
  assert.throws(() => new Player(header).at(NaN), { name: 'TypeError', message: 'seconds: NaN is not a finite number' });
  assert.throws(() => new Player({}), { name: 'TypeError', message: 'header.frame_rate: undefined is not a finite number above 0' });
  assert.throws(() => new Player(), { name: 'TypeError', message: "header: undefined is not a dance's header" });
  assert.throws(() => new Player(header, { catchup: 1 }), { name: 'TypeError', message: 'options.catchup: is none of keep, catchUp' });
  assert.throws(() => new Player(header, { catchUp: 0 }), { name: 'TypeError', message: 'catchUp: 0 is not a finite number above 0' });
});
