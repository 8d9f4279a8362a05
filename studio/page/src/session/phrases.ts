// A phrase is the selection on the timeline: an interval between two keys or any part of the dance. Its keys can be mirrored, repeated or removed.
import { beats } from './beats';
import { heading, turned } from '../project/body';
import type { Triple } from '../project/body';
import { chosenKeys, moved } from './copies';
import { later, placeAmong, secondOf } from '../project/counts';
import { onPath } from './floor_path';
import { edit, total } from './history';
import { dancer, skeleton } from './link';
import { limits } from '../project/limits';
import { freeId, holdOf, sorted } from '../project/project';
import type { Key } from '../project/project';
import { audio } from './songs';
import { selection, showError, live, project, selectedKey, takes, notify } from '../project/state';

const usual = 8; // counts
const usualSeconds = 4; // without counts
const beside = 0.5; // seconds between two keys without counts

const timesOf = () => beats.value.list.map(({ time }) => time);
const isCounted = () => beats.value.list.length > 1;
const frameOf = (seconds: number) => Math.round(seconds * dancer.fps);
/// The exact second of a frame that counts move.
const countedSecond = (frame: number) => secondOf(frame, dancer.fps, timesOf());

/// Selects the frames between two, in any order; fewer than the least distance of keys is no phrase.
export function choosePhrase(a: number, b: number) {
  const [from, to] = [Math.max(0, Math.min(a, b)), Math.min(Math.max(a, b), total.value)];
  if (live.value || to - from < limits.keyDistance) return;
  takes.value = [];
  selection.value = [from, to];
}

export const chooseAll = () => choosePhrase(0, total.value);

/// Selects the eight at the playhead.
export function chooseEight() {
  const now = audio.currentTime + 0.5 / dancer.fps;
  const ones = beats.value.list.filter(({ count }) => count === 1).map(({ time }) => time);
  if (ones.length === 0) return choosePhrase(frameOf(now), frameOf(now + usualSeconds));
  const from = ones.findLast((time) => time <= now) ?? 0;
  choosePhrase(frameOf(from), frameOf(ones.find((time) => time > now) ?? later(from, usual, timesOf())));
}

/// Changes keys and keeps the selection.
function change(keys: Key[], touched: number[], phrase: [number, number]) {
  edit({ ...project.value, keys: sorted(keys) }, touched);
  selection.value = phrase;
}

/// Mirrors the phrase, relative to the dancer's place and facing at its first key.
export function mirrorPhrase() {
  const keys = chosenKeys();
  const [first] = keys;
  if (!first) return;
  const axis = heading(first.pose);
  const [ahead, side] = [[Math.sin(axis), Math.cos(axis)], [Math.cos(axis), -Math.sin(axis)]];
  const mirrored = keys.map((key): Key => {
    const [x, z] = [key.pose.root[0] - first.pose.root[0], key.pose.root[2] - first.pose.root[2]];
    const [far, wide] = [x * ahead[0] + z * ahead[1], -(x * side[0] + z * side[1])];
    const root: Triple = [
      first.pose.root[0] + far * ahead[0] + wide * side[0], key.pose.root[1], first.pose.root[2] + far * ahead[1] + wide * side[1],
    ];
    const pose = turned(skeleton.mirrored(key.pose), 2 * (axis - heading(key.pose)));
    return onPath(project.value.path, { ...key, pose: { ...pose, root: key.hasPlace ? root : key.pose.root }, joints: key.joints && skeleton.twinsOf(key.joints) });
  });
  const others = project.value.keys.filter((key) => !keys.includes(key));
  change([...others, ...mirrored], keys.map(({ frame }) => frame), selection.value!);
}

export function removePhrase() {
  const keys = chosenKeys();
  if (keys.length === 0) return;
  selectedKey.value = null;
  change(project.value.keys.filter((key) => !keys.includes(key)), keys.map(({ frame }) => frame), selection.value!);
  notify(`${keys.length === 1 ? 'One key is' : `${keys.length} keys are`} taken out. Undo brings them back.`);
}

/// Maps a frame of the phrase to its repetition, which begins at the phrase's end, on the same count.
function repeated([from, to]: [number, number], last: number): (frame: number) => number {
  const { fps } = dancer;
  const times = timesOf();
  if (!isCounted()) {
    const by = last < to ? (to - from) / fps : (to - from) / fps + beside;
    return (frame) => frameOf(frame / fps + by);
  }
  const [begin, end] = [placeAmong(from / fps, times), placeAmong(to / fps, times)];
  const counts = last < to ? Math.max(1, Math.round(end - begin)) : Math.floor(end - begin + 0.5) + 1;
  return (frame) => frameOf(later(countedSecond(frame), counts, times));
}

/// Repeats the phrase's keys right after it, moved and turned to the dancer's place then, replacing keys there. `withAnotherEnding` omits the last
/// key, for a pose that the user chooses next.
export function repeatPhrase(withAnotherEnding = false) {
  const keys = chosenKeys();
  if (keys.length === 0 || (withAnotherEnding && keys.length < 2)) return;
  const { fps } = dancer;
  const phrase = selection.value!;
  const again = repeated(phrase, keys.at(-1)!.frame);
  const frameOfKey = ({ frame }: Key) => again(frame);
  const [from, to] = phrase.map(again);
  const [begin, ending] = [frameOfKey(keys[0]), frameOfKey(keys.at(-1)!)];
  const most = total.value;
  const set = (withAnotherEnding ? keys.slice(0, -1) : keys).filter((key) => frameOfKey(key) < most);
  if (set.length === 0 || (withAnotherEnding && ending >= most)) return showError(new Error('The dance ends before the phrase could come again.'));
  const [first, last] = [Math.min(from, begin - limits.keyDistance + 1), Math.max(to, ending + limits.keyDistance)];
  const stay = project.value.keys.filter(({ frame }) => frame < first || frame >= last);
  const makeWay = project.value.keys.filter((key) => !stay.includes(key));
  const all = [...stay];
  for (const key of set) all.push(onPath(project.value.path, { ...moved(key, keys[0], begin), id: freeId(all, key.id), frame: frameOfKey(key) }));
  const touched = [...makeWay, ...all.slice(stay.length)].map(({ frame }) => frame);
  selectedKey.value = null;
  change(all, touched, [from, Math.min(to, most)]);
  if (withAnotherEnding) {
    audio.pause();
    audio.currentTime = ending / fps;
    return notify('The phrase is repeated without its last key: press a pose to end it.');
  }
  notifyOfLeftOut(keys.length - set.length, keys.length);
}

/// Stretches the phrase's keys about its beginning, in counts: 2 is half time, 0.5 double time.
/// Removes keys at their new places.
export function stretchPhrase(times: number) {
  const keys = chosenKeys();
  if (keys.length === 0) return;
  const { fps } = dancer;
  const [from, to] = selection.value!;
  const beatTimes = timesOf();
  const counted = (frame: number) => placeAmong(countedSecond(frame), beatTimes);
  const stretched = (frame: number) =>
    isCounted() ? frameOf(later(countedSecond(from), times * (counted(frame) - counted(from)), beatTimes)) : Math.round(from + times * (frame - from));
  const most = total.value;
  const set = keys.map((key) => onPath(project.value.path, {
    ...key, frame: stretched(key.frame), hold: holdOf(times * key.hold, fps),
  })).filter(({ frame }) => frame < most);
  if (set.some(({ frame }, i) => i > 0 && frame - set[i - 1].frame < limits.keyDistance)) return showError(new Error('Its keys would stand too close together.'));
  const touched = keys.filter((key, i) => set[i]?.frame !== key.frame);
  if (touched.length === 0) return notify('The phrase has no key after its beginning.');
  const begin = Math.min(from, (set[0]?.frame ?? from) - limits.keyDistance + 1);
  const end = Math.max(to, stretched(to), (set.at(-1)?.frame ?? 0) + limits.keyDistance);
  const stay = project.value.keys.filter((key) => !keys.includes(key) && (key.frame < begin || key.frame >= end));
  const makeWay = project.value.keys.filter((key) => !keys.includes(key) && !stay.includes(key));
  const moved = set.filter((key, i) => key.frame !== keys[i].frame);
  change([...stay, ...set], [...touched, ...makeWay, ...moved].map(({ frame }) => frame), [from, Math.min(stretched(to), most)]);
  notifyOfLeftOut(keys.length - set.length, keys.length);
}

const notifyOfLeftOut = (left: number, of: number) => left > 0 && notify(`${left} of ${of} keys would come behind the end, and are left out.`);
