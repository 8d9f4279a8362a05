// client/node/page: the keys that a page waits for.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { PendingKeys } from '../../client/node/page/pending_keys.js';

test('a key that cannot be moved or taken back still stands where it was', () => {
  const keys = new PendingKeys();
  keys.add({ id: 'a', time: 5 });
  const undo = keys.add({ id: 'a', time: 9 });
  assert.equal(keys.after(5), 5);
  undo();
  assert.equal(keys.after(5), 6);
  keys.add({ id: 'a', time: 9 });
  keys.refuse('a');
  assert.equal(keys.after(5), 6);
  keys.remove('a');
  assert.equal(keys.after(5), 5);
  keys.refuse('a');
  assert.equal(keys.after(5), 6);
});

test('the move that is refused is taken back, not a good one that followed', () => {
  const keys = new PendingKeys();
  keys.add({ id: 'a', time: 9 });
  keys.add({ id: 'a', time: 5 });
  keys.refuse('a', 9);
  assert.deepEqual([keys.after(5), keys.after(9)], [6, 9]);
  keys.remove('a');
  keys.add({ id: 'a', time: 20 });
  keys.refuse('a', null);
  assert.deepEqual([keys.after(5), keys.after(20)], [5, 21]);
});

test('a held key takes its place until its end, and moves that are on their way survive its news', () => {
  const keys = new PendingKeys();
  keys.add({ id: 'a', time: 5, hold: 2 });
  keys.reach('a', 5.01);
  assert.equal(keys.after(6), 8);
  keys.add({ id: 'b', time: 20 });
  keys.add({ id: 'b', time: 30 });
  keys.reach('b', 20);
  assert.deepEqual([keys.after(20), keys.after(30)], [20, 31]);
  keys.reach('nobody', 3);
  assert.equal(keys.newId(), 'key 1');
});
