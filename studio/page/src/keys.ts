// Key poses: set, moved, bent, removed.
import { computed, signal } from '@preact/signals';
import { heading, only, turned } from './body';
import type { Pose, Triple } from './body';
import type { LibraryPose } from './generated/studio/studio_pb';
import { onPath } from './floor_path';
import { following } from './following';
import { danceFrom, edit, note } from './history';
import { dancer, skeleton, wire } from './link';
import { addLiveKey, changeLiveKey } from './live';
import { jointsOf, movable, partsOf, withPart, worked } from './masks';
import { limits } from './limits';
import { projectMessage, readKey } from './project_file';
import { emptyProject, freeId, holdOf, isInHold, sorted, spoken, wishes } from './project';
import type { Hands, Key } from './project';
import { audio } from './songs';
import { complain, danced, live, message, moment, motion, project, selectedKey, sketch, song, tell, work } from './state';
import type { Moment } from './state';

const reach = 15; // frames within which a key that finds its place taken looks for another

/// Whether a pose that is set at one frame takes the place of a key at the other.
export const isTooNear = (a: number, b: number) => Math.abs(a - b) < limits.tooNearS * dancer.fps;

/// Key poses of the library on the song's beats: a dance to begin with.
export async function compose() {
  const seconds = song.value?.heard.seconds ?? 20;
  const seed = Math.max(1, (project.value?.seed ?? 0) + 1);
  // Of the same song, not of one by the same name.
  const beats = (moment.value?.song === song.value && project.value?.beats) || null;
  const answer = await wire.ask({ case: 'compose', value: { seconds, seed: BigInt(seed), beats: beats?.list.map(({ time }) => time) } });
  if (answer.case !== 'keyframes') return;
  const keys = answer.value.keyframes.map((key) => readKey({ ...key, id: key.id.replace(/^\d+-/, '') }, dancer.fps, skeleton.height));
  const named: Key[] = [];
  for (const key of keys) named.push({ ...key, id: freeId(named, key.id) });
  message.value = null;
  const empty = emptyProject(song.value?.name ?? '', seconds);
  const before = { ...(project.value ?? empty), ...following.value };
  const markers = moment.value?.song === song.value ? before.markers : [];
  const wished = wishes(before);
  danceFrom({ ...empty, ...wished, dancers: before.dancers, apart: before.apart, beats, markers, seed, keys: named.map((key) => onPath(wished.path, key)) }, -1);
}

/// The nearest frame to a wanted one at which a key can stand; null if there is none near.
export function freeFrame(keys: Key[], frame: number): number | null {
  const most = dancer.frames(project.value) - 1;
  for (let away = 0; away < reach; ++away) {
    for (const at of [frame + away, frame - away]) {
      if (at >= 0 && at <= most && keys.every((key) => Math.abs(key.frame - at) >= limits.keyDistance)) return at;
    }
  }
  return null;
}

/// The key in whose place a pose comes that is set at a frame: the nearest, where one is as good as there.
export function keyNear(frame: number): Key | undefined {
  const away = (key: Key) => Math.abs(key.frame - frame);
  const near = live.value ? [] : project.value?.keys.filter((key) => isTooNear(key.frame, frame)) ?? [];
  return near.sort((a, b) => away(a) - away(b))[0];
}

/// Sets a pose of the library at the dancer's place and facing of that moment. It replaces a key that is too near.
/// In a live dance the pose goes on a beat ahead, or at `at`.
export function addKey(pose: LibraryPose, at?: number) {
  if (!project.value) return;
  if (live.value) return addLiveKey(pose, at ?? null);
  const wanted = at ?? Math.round(audio.currentTime * dancer.fps);
  const old = keyNear(wanted);
  const keys = project.value.keys.filter((key) => key !== old);
  const frame = freeFrame(keys, old?.frame ?? wanted);
  if (frame === null) return complain(new Error('There is no room for a key here.'));
  const root = pose.pose!.rootPosition!;
  let placed: Pose = { root: [root.x, root.y, root.z], rotations: [...pose.pose!.rotations] };
  if (motion.value.count > frame) {
    const here = motion.value.pose(frame);
    placed = turned(placed, heading(here));
    placed.root = [here.root[0], root.y, here.root[2]];
  }
  const key = onPath(project.value.path, { id: freeId(keys, pose.id), frame, pose: placed, hasPlace: true, asks: null, hold: old?.hold ?? 0, hit: old?.hit ?? null, hands: old?.hands ?? null });
  selectedKey.value = key.id;
  edit({ ...project.value, keys: sorted([...keys, key]) }, [frame]);
  tellOfHold(keys, key);
  if (old) tell(`${spoken(key.id)} stands in place of ${spoken(old.id)} now. Undo brings that back.`);
}

/// Says that a hold ends for a key that comes in it.
function tellOfHold(others: Key[], key: Key) {
  const held = others.find((other) => isInHold(other, key.frame));
  if (held) tell(`${spoken(held.id)} is held no longer than to ${limits.wayFromHoldS} s before ${spoken(key.id)}.`);
}

export const keyOf = (id: string | null) => project.value?.keys.find((key) => key.id === id);

export function moveKey(id: string, to: number) {
  if (live.value) return changeLiveKey(id, to);
  const key = keyOf(id);
  if (!key) return;
  const others = project.value.keys.filter((other) => other !== key);
  const frame = freeFrame(others, to);
  if (frame === null || frame === key.frame) return;
  edit({ ...project.value, keys: sorted([...others, onPath(project.value.path, { ...key, frame })]) }, [key.frame, frame]);
  tellOfHold(others, { ...key, frame });
  const near = others.find((other) => isTooNear(other.frame, frame));
  if (near) tell(`${spoken(key.id)} stands ${(Math.abs(near.frame - frame) / dancer.fps).toFixed(2)} s from ${spoken(near.id)}: too near to be danced well.`);
}

/// Keeps its pose for so many frames, in steps of those that hold it. The program refuses what cannot be held.
export const holdKey = (id: string, frames: number) => work(async () => {
  const key = keyOf(id);
  if (!key || live.value) return;
  const [{ fps }, before] = [dancer, project.value];
  const hold = holdOf(Math.min(frames + (limits.holdStepS * fps) / 2, limits.holdS * fps), fps);
  const next = { ...before, keys: before.keys.map((other) => (other === key ? { ...key, hold } : other)) };
  if (hold > key.hold) await wire.ask({ case: 'write', value: projectMessage(next, fps) });
  if (project.value === before) edit(next, [key.frame]);
});

/// How hard it is hit; null: it is danced through.
export function hitKey(id: string, hit: number | null) {
  const key = keyOf(id);
  if (key && key.hit !== hit) edit({ ...project.value, keys: project.value.keys.map((other) => (other === key ? { ...key, hit } : other)) }, [key.frame]);
}

/// What hands do at it; null: nothing is said. No frame depends on it.
export function handKey(id: string, hands: Hands | null) {
  const key = keyOf(id);
  if (key && key.hands !== hands) note({ keys: project.value.keys.map((other) => (other === key ? { ...key, hands } : other)) });
}

export function removeKey(id: string) {
  if (live.value) return changeLiveKey(id, null);
  const key = keyOf(id);
  if (!key) return;
  selectedKey.value = null;
  edit({ ...project.value, keys: project.value.keys.filter((other) => other !== key) }, [key.frame]);
}

/// A key's pose as it is shown: what it leaves free is as it is danced.
function shown(key: Key): Pose {
  if (key.hasPlace && !key.asks) return key.pose;
  const dance = motion.value.count > key.frame || danced.value > key.frame ? motion.value : moment.value.before;
  if (dance.count <= key.frame) return key.pose;
  const there = dance.pose(key.frame);
  const { rotations } = only(there, key.pose, key.asks);
  return { root: key.hasPlace ? key.pose.root : there.root, rotations };
}

const isSame = (a: Triple, b: Triple) => a.every((value, i) => Math.abs(value - b[i]) < 1e-6);

/// Another pose for a key. One without a place gets one where the body was moved, unless it leaves the hips free.
export function poseKey(id: string, pose: Pose, asks?: number[] | null) {
  const key = keyOf(id);
  if (!key) return;
  const joints = asks === undefined ? key.asks : asks;
  const isMoved = !isSame(pose.root, shown(key).root) && (!joints || joints.includes(0));
  const posed = { ...key, pose, hasPlace: key.hasPlace || isMoved, asks: joints };
  edit({ ...project.value, keys: project.value.keys.map((other) => (other === key ? posed : other)) }, [key.frame]);
}

/// A pose that changes step by step: it is shown at once, and danced once the hand rests.
const draft = signal<{ id: string; pose: Pose; of: Moment } | null>(null);
const rest = 400; // ms
let resting: ReturnType<typeof setTimeout>;

const shownKey = computed(() => {
  const key = keyOf(selectedKey.value);
  if (key && draft.value?.id === key.id && draft.value.of === moment.value) return draft.value.pose;
  return key && shown(key);
});

/// The pose that is bent, where there is one: the photo's, or the chosen key's.
export const bent = () => sketch.value?.pose ?? shownKey.value;

export function bend(pose: Pose) {
  draft.value = null;
  if (sketch.value) sketch.value = { ...sketch.value, pose };
  else if (selectedKey.value) poseKey(selectedKey.value, pose);
}

export function bendSoon(pose: Pose) {
  if (sketch.value || !selectedKey.value) return bend(pose);
  draft.value = { id: selectedKey.value, pose, of: moment.value };
  clearTimeout(resting);
  resting = setTimeout(() => {
    const last = draft.value;
    draft.value = null;
    if (last?.of === moment.value) poseKey(last.id, last.pose);
  }, rest);
}

/// Left becomes right, and the joints that a key asks for with it.
export function mirror() {
  const now = bent()!;
  const key = sketch.value ? undefined : keyOf(selectedKey.value);
  const turnedOver = skeleton.mirrored(now);
  if (key?.asks) poseKey(key.id, turnedOver, skeleton.twinsOf(key.asks));
  else bend(only(now, turnedOver, movable.value));
}

/// Takes a pose of the library where the body stands; of the parts that are worked on, where these are not all.
export function takeFrom({ pose }: LibraryPose) {
  const now = bent()!;
  const from = turned({ root: [now.root[0], pose!.rootPosition!.y, now.root[2]], rotations: pose!.rotations }, heading(now));
  bend(only(now, from, movable.value));
}

/// Works on a part of the body, or no more. A partial key asks for it then, or no more.
export function workOn(part: number, isOn: boolean) {
  const key = sketch.value ? undefined : keyOf(selectedKey.value);
  const chosen = (key?.asks ? partsOf(key.asks) : worked.value).map((old, i) => (i === part ? isOn : old));
  if (!chosen.some(Boolean)) return tell('One part at least is worked on.');
  worked.value = chosen;
  if (key?.asks) ask(key, withPart(key.asks, part, isOn));
}

/// Makes a key ask for the parts that are worked on alone, or for the whole body.
export function askForParts(id: string, isPartial: boolean) {
  const key = keyOf(id);
  if (key) ask(key, isPartial ? jointsOf(worked.value) : null);
}

/// A key that leaves the hips free does not say where they are; the whole body stands where it was.
function ask(key: Key, asks: number[] | null) {
  const changed = { ...key, pose: shown(key), asks, hasPlace: !asks || (key.hasPlace && asks.includes(0)) };
  edit({ ...project.value, keys: project.value.keys.map((other) => (other === key ? changed : other)) }, [key.frame]);
}
