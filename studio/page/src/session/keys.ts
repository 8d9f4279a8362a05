// Sets, moves, edits and removes key poses.
import { computed, signal } from '@preact/signals';
import { heading, only, turned } from '../project/body';
import type { Pose, Triple } from '../project/body';
import type { HandPose } from '../generated/choreo/v1/choreography_pb';
import type { LibraryPose } from '../generated/studio/studio_pb';
import { onPath } from './floor_path';
import { following } from './following';
import { danceFrom, edit, note } from './history';
import { dancer, skeleton, wire } from './link';
import { addLiveKey, changeLiveKey } from './live';
import { jointsOf, movable, partsOf, withPart, worked } from './masks';
import { limits } from '../project/limits';
import { projectMessage, readKey } from '../project/project_file';
import { emptyProject, freeId, holdOf, isInHold, sorted, displayName, settingsOf } from '../project/project';
import type { Key } from '../project/project';
import { audio } from './songs';
import { showError, danced, live, message, moment, motion, project, selectedKey, sketch, song, notify, notifyOf, work } from '../project/state';
import type { Moment } from '../project/state';

const reach = 15; // frames behind the end from which a key comes to the last frame

/// Whether a key set at one frame removes one at the other.
export const isTooNear = (a: number, b: number) => Math.abs(a - b) < limits.tooNearS * dancer.fps;

/// Key poses from the library on the song's beats, as a first dance.
export async function compose() {
  const seconds = song.value?.analysis.seconds ?? 20;
  const seed = Math.max(1, (project.value?.seed ?? 0) + 1);
  // For the same song, not one of the same name.
  const beats = (moment.value?.song === song.value && project.value?.beats) || null;
  const answer = await wire.request({ case: 'compose', value: { seconds, seed: BigInt(seed), beats: beats?.list.map(({ time }) => time) } });
  if (answer.case !== 'keyframes') return;
  const keys = answer.value.keyframes.map((key) => readKey({ ...key, id: key.id.replace(/^\d+-/, '') }, dancer.fps, skeleton.height));
  const named: Key[] = [];
  for (const key of keys) named.push({ ...key, id: freeId(named, key.id) });
  message.value = null;
  const empty = emptyProject(song.value?.name ?? '', seconds);
  const before = { ...(project.value ?? empty), ...following.value };
  const markers = moment.value?.song === song.value ? before.markers : [];
  const settings = settingsOf(before);
  danceFrom({ ...empty, ...settings, dancers: before.dancers, apart: before.apart, beats, markers, seed, keys: named.map((key) => onPath(settings.path, key)) }, -1);
}

/// The frame of a key that is set at a wanted one, and those of `keys` that make way for it, as in the program
/// (client/cli/edit/key_room.cpp): where the dance begins, a key stays unless another is set there. Null outside the dance.
export function roomFor(keys: Key[], wanted: number): { frame: number; gone: Key[] } | null {
  const most = dancer.frames(project.value) - 1;
  if (wanted >= most + reach) return null;
  const asked = Math.max(0, Math.min(wanted, most));
  const first = asked > 0 && keys.find(({ frame }) => frame === 0);
  const frame = first ? Math.max(asked, limits.keyDistance) : asked;
  return frame > most ? null : { frame, gone: keys.filter((key) => key !== first && isTooNear(key.frame, frame)) };
}

/// The keys that a pose set at a frame would replace. One at the very frame gives its place alone.
export function replaced(frame: number): Key[] {
  if (live.value || !project.value) return [];
  const there = project.value.keys.find((key) => key.frame === frame);
  return there ? [there] : roomFor(project.value.keys, frame)?.gone ?? [];
}

/// Which keys made way for others; empty for none.
export function noteOfWay(keys: Key[], gone: Key[]): string {
  if (gone.length === 0) return '';
  const names = (some: Key[]) => some.map(({ id }) => displayName(id)).join(' and ');
  const isAt = ({ frame }: Key) => keys.some((key) => key.frame === frame);
  const away = gone.every(isAt) ? '' : ` less than ${limits.tooNearS} s away`;
  return `${names(keys)} ${keys.length === 1 ? 'stands' : 'stand'} in place of ${names(gone)}${away} now. Undo brings ${gone.length === 1 ? 'that' : 'those'} back.`;
}

/// Sets a pose of the library at the dancer's present place and facing. Removes keys that are too
/// near; at the very frame of one it takes over how that is held and hit. In a live dance the pose is set on a coming beat, or at `at`.
export function addKey(pose: LibraryPose, at?: number) {
  if (!project.value) return;
  if (live.value) return addLiveKey(pose, at ?? null);
  const wanted = at ?? Math.round(audio.currentTime * dancer.fps);
  const room = roomFor(project.value.keys, wanted);
  if (!room) return showError(new Error('There is no room for a key here.'));
  const { frame } = room;
  const gone = replaced(frame);
  const old = gone.find((key) => key.frame === frame);
  const keys = project.value.keys.filter((key) => !gone.includes(key));
  const root = pose.pose!.rootPosition!;
  let placed: Pose = { root: [root.x, root.y, root.z], rotations: [...pose.pose!.rotations] };
  if (motion.value.count > frame) {
    const here = motion.value.pose(frame);
    placed = turned(placed, heading(here));
    placed.root = [here.root[0], root.y, here.root[2]];
  }
  const key = onPath(project.value.path, { id: freeId(keys, pose.id), frame, pose: placed, hasPlace: true, joints: null, hold: old?.hold ?? 0, hit: old?.hit ?? null, hands: old?.hands ?? 0 });
  selectedKey.value = key.id;
  edit({ ...project.value, keys: sorted([...keys, key]) }, [frame, ...gone.map((other) => other.frame)]);
  notifyOf(noteOfHold(keys, key), noteOfWay([key], gone));
}

/// Whose hold ends early because a key follows within it; empty for none.
function noteOfHold(others: Key[], key: Key): string {
  const held = others.find((other) => isInHold(other, key.frame));
  return held ? `${displayName(held.id)} is held no longer than to ${limits.wayFromHoldS} s before ${displayName(key.id)}.` : '';
}

export const keyOf = (id: string | null) => project.value?.keys.find((key) => key.id === id);

export function moveKey(id: string, to: number) {
  if (live.value) return changeLiveKey(id, to);
  const key = keyOf(id);
  if (!key) return;
  const others = project.value.keys.filter((other) => other !== key);
  const room = roomFor(others, to);
  if (!room || room.frame === key.frame) return;
  const { frame, gone } = room;
  const stay = others.filter((other) => !gone.includes(other));
  const moved = onPath(project.value.path, { ...key, frame });
  edit({ ...project.value, keys: sorted([...stay, moved]) }, [key.frame, frame, ...gone.map((other) => other.frame)]);
  notifyOf(noteOfHold(stay, moved), noteOfWay([moved], gone));
}

/// Sets for how many frames a key's pose is held, in whole steps. The program refuses poses that
/// cannot be held.
export const holdKey = (id: string, frames: number) => work(async () => {
  const key = keyOf(id);
  if (!key || live.value) return;
  const [{ fps }, before] = [dancer, project.value];
  const hold = holdOf(Math.min(frames + (limits.holdStepS * fps) / 2, limits.holdS * fps), fps);
  const next = { ...before, keys: before.keys.map((other) => (other === key ? { ...key, hold } : other)) };
  if (hold > key.hold) await wire.request({ case: 'write', value: projectMessage(next, fps) });
  if (project.value === before) edit(next, [key.frame]);
});

/// Sets how hard a key is hit; null: it is danced through.
export function hitKey(id: string, hit: number | null) {
  const key = keyOf(id);
  if (key && key.hit !== hit) edit({ ...project.value, keys: project.value.keys.map((other) => (other === key ? { ...key, hit } : other)) }, [key.frame]);
}

/// Sets a key's hand pose; 0: none. No frame depends on it.
export function handKey(id: string, hands: HandPose) {
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

/// A key's pose as displayed; joints that it leaves free are as danced.
function shown(key: Key): Pose {
  if (key.hasPlace && !key.joints) return key.pose;
  const dance = motion.value.count > key.frame || danced.value > key.frame ? motion.value : moment.value.before;
  if (dance.count <= key.frame) return key.pose;
  const there = dance.pose(key.frame);
  const { rotations } = only(there, key.pose, key.joints);
  return { root: key.hasPlace ? key.pose.root : there.root, rotations };
}

const isSame = (a: Triple, b: Triple) => a.every((value, i) => Math.abs(value - b[i]) < 1e-6);

/// Sets another pose for a key. A key without a place gets one if the body was moved, unless it
/// leaves the hips free.
export function poseKey(id: string, pose: Pose, fixed?: number[] | null) {
  const key = keyOf(id);
  if (!key) return;
  const joints = fixed === undefined ? key.joints : fixed;
  const isMoved = !isSame(pose.root, shown(key).root) && (!joints || joints.includes(0));
  const posed = { ...key, pose, hasPlace: key.hasPlace || isMoved, joints };
  edit({ ...project.value, keys: project.value.keys.map((other) => (other === key ? posed : other)) }, [key.frame]);
}

/// Changes a pose step by step. Shows each step at once, and dances it after a pause.
const draft = signal<{ id: string; pose: Pose; of: Moment } | null>(null);
const rest = 400; // ms
let resting: ReturnType<typeof setTimeout>;

const shownKey = computed(() => {
  const key = keyOf(selectedKey.value);
  if (key && draft.value?.id === key.id && draft.value.of === moment.value) return draft.value.pose;
  return key && shown(key);
});

/// The pose being edited, if any: the photo's, or the selected key's.
export const editedPose = () => sketch.value?.pose ?? shownKey.value;

export function setEditedPose(pose: Pose) {
  draft.value = null;
  if (sketch.value) sketch.value = { ...sketch.value, pose };
  else if (selectedKey.value) poseKey(selectedKey.value, pose);
}

export function previewEditedPose(pose: Pose) {
  if (sketch.value || !selectedKey.value) return setEditedPose(pose);
  draft.value = { id: selectedKey.value, pose, of: moment.value };
  clearTimeout(resting);
  resting = setTimeout(() => {
    const last = draft.value;
    draft.value = null;
    if (last?.of === moment.value) poseKey(last.id, last.pose);
  }, rest);
}

/// Mirrors the pose, and the set of joints that a key fixes.
export function mirror() {
  const now = editedPose()!;
  const key = sketch.value ? undefined : keyOf(selectedKey.value);
  const turnedOver = skeleton.mirrored(now);
  if (key?.joints) poseKey(key.id, turnedOver, skeleton.twinsOf(key.joints));
  else setEditedPose(only(now, turnedOver, movable.value));
}

/// Uses a pose of the library at the body's place; only its edited parts, unless these are all.
export function copyPose({ pose }: LibraryPose) {
  const now = editedPose()!;
  const from = turned({ root: [now.root[0], pose!.rootPosition!.y, now.root[2]], rotations: pose!.rotations }, heading(now));
  setEditedPose(only(now, from, movable.value));
}

/// Starts or stops editing a part of the body. A partial key then fixes or frees that part.
export function workOn(part: number, isOn: boolean) {
  const key = sketch.value ? undefined : keyOf(selectedKey.value);
  const chosen = (key?.joints ? partsOf(key.joints) : worked.value).map((old, i) => (i === part ? isOn : old));
  if (!chosen.some(Boolean)) return notify('Pick at least one part.');
  worked.value = chosen;
  if (key?.joints) fixJoints(key, withPart(key.joints, part, isOn));
}

/// Makes a key fix only the edited parts, or the whole body.
export function fixParts(id: string, isPartial: boolean) {
  const key = keyOf(id);
  if (key) fixJoints(key, isPartial ? jointsOf(worked.value) : null);
}

/// A key that leaves the hips free has no place. The whole body keeps its place.
function fixJoints(key: Key, joints: number[] | null) {
  const changed = { ...key, pose: shown(key), joints, hasPlace: !joints || (key.hasPlace && joints.includes(0)) };
  edit({ ...project.value, keys: project.value.keys.map((other) => (other === key ? changed : other)) }, [key.frame]);
}
