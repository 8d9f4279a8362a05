// Copying keys: a single one, or those of a phrase.
import { computed, signal } from '@preact/signals';
import { beats } from './beats';
import { heading, turned } from '../project/body';
import type { Triple } from '../project/body';
import { onPath } from './floor_path';
import { edit, total } from './history';
import { isTooNear, keyOf, noteOfWay, roomFor } from './keys';
import { dancer } from './link';
import { limits } from '../project/limits';
import { freeId, sorted, displayName } from '../project/project';
import type { Key } from '../project/project';
import { audio } from './songs';
import { selection, showError, live, motion, project, selectedKey, notify, notifyOf } from '../project/state';

const copied = signal<Key[]>([]);
export const canPaste = computed(() => copied.value.length > 0);

/// The keys of the selected phrase, from its beginning until before its end, like an eight from one 1 to the next; for an interval between two keys,
/// both keys.
export function chosenKeys(): Key[] {
  if (live.value || !selection.value) return [];
  const [from, to] = selection.value;
  const keys = project.value?.keys.filter(({ frame }) => frame >= from && frame <= to) ?? [];
  const isInterval = keys.length === 2 && keys[0].frame === from && keys[1].frame === to;
  return isInterval ? keys : keys.filter(({ frame }) => frame < to);
}

/// The keys to copy: the selection's, or the selected key if it is outside the selection.
function taken(): Key[] {
  const key = keyOf(selectedKey.value);
  const inside = chosenKeys();
  return inside.length && (!key || inside.includes(key)) ? inside : key ? [key] : [];
}

/// Returns whether there was something to copy.
export function copyKeys(): boolean {
  const keys = live.value ? [] : taken();
  if (keys.length === 0) return false;
  copied.value = keys;
  notify(keys.length === 1 ? 'The key is copied.' : `${keys.length} keys are copied.`);
  return true;
}

/// Pastes the copied keys from the playhead on, relative to where the dancer is then.
export const pasteKeys = () => void (canPaste.value && set(copied.value, Math.round(audio.currentTime * dancer.fps)));

const offBeat = 15; // frames from try to try where no beat is free

/// Copies the selected key to the playhead, or, if a key is there, to the next free beat, or to where no other key must make way.
export function duplicateKey() {
  const key = keyOf(selectedKey.value);
  if (!key || live.value) return;
  const now = Math.round(audio.currentTime * dancer.fps);
  const isTaken = (frame: number) => project.value.keys.some((other) => isTooNear(other.frame, frame));
  const next = beats.value.list.map(({ time }) => Math.round(time * dancer.fps)).find((frame) => frame > key.frame && !isTaken(frame));
  let free = now + offBeat;
  while (isTaken(free)) free += offBeat;
  const spare = free < total.value ? free : Infinity; // set() says that there is no room
  set([key], isTaken(now) ? next ?? spare : now);
}

const endHold = 1; // seconds that an ending is held at least, as in the program (client/authoring/keys/ending.cpp)
const endHoldUncounted = 1.5; // without beats

/// Lets the dance come to rest in a key's pose where the dancer is then: on the last beat that leaves time to hold it, and to the last frame.
export function endIn(id: string) {
  const key = keyOf(id);
  const last = total.value - 1;
  const { fps } = dancer;
  if (!key || live.value) return;
  const beat = beats.value.list.findLast(({ time }) => time >= endHold && time <= last / fps - endHold);
  const frame = Math.round((beat?.time ?? last / fps - endHoldUncounted) * fps);
  if (frame < limits.keyDistance) return showError(new Error('The dance is too short for an ending.'));
  const way = Math.round(limits.wayFromHoldS * fps);
  const stay = project.value.keys.filter((other) => other.frame === 0 || other.frame <= frame - way);
  const gone = project.value.keys.filter((other) => !stay.includes(other));
  const end = onPath(project.value.path, { ...moved(key, key, frame), id: freeId(stay, key.id), frame, hold: last - frame, hit: key.hit ?? limits.usualHit });
  selectedKey.value = end.id;
  edit({ ...project.value, keys: [...stay, end] }, [frame, ...gone.map((other) => other.frame)]);
  const others = gone.filter((other) => other !== key).length;
  notify(`The dance ends in ${displayName(key.id)}.${others ? ` ${others === 1 ? 'One key makes' : `${others} keys make`} way.` : ''} Undo takes that back.`);
}

function set(keys: Key[], at: number) {
  if (live.value || !project.value) return;
  const first = keys[0];
  const before = project.value.keys;
  const added: Key[] = []; // which keep each other
  const gone = new Set<Key>();
  for (const key of keys) {
    const room = roomFor(before, at + key.frame - first.frame);
    if (!room || added.some(({ frame }) => Math.abs(frame - room.frame) < limits.keyDistance)) continue;
    added.push(onPath(project.value.path, { ...moved(key, first, at), id: freeId([...before, ...added], key.id), frame: room.frame }));
    for (const other of room.gone) gone.add(other);
  }
  if (added.length === 0) return showError(new Error('There is no room for a key here.'));
  selectedKey.value = added[0].id;
  const stay = before.filter((key) => !gone.has(key));
  edit({ ...project.value, keys: sorted([...stay, ...added]) }, [...added, ...gone].map(({ frame }) => frame));
  const without = keys.length - added.length;
  notifyOf(without ? `${without} of ${keys.length} keys found no room.` : '', noteOfWay(added, [...gone]));
}

/// Turns and moves a key by the transform that takes the first key to the dancer's place at that frame.
export function moved(key: Key, first: Key, at: number): Key {
  if (!key.hasPlace || !first.hasPlace || motion.value.count <= at) return key;
  const here = motion.value.pose(at);
  const angle = heading(here) - heading(first.pose);
  const [x, z] = [key.pose.root[0] - first.pose.root[0], key.pose.root[2] - first.pose.root[2]];
  const root: Triple = [
    here.root[0] + x * Math.cos(angle) + z * Math.sin(angle), key.pose.root[1], here.root[2] - x * Math.sin(angle) + z * Math.cos(angle),
  ];
  return { ...key, pose: { ...turned(key.pose, angle), root } };
}
