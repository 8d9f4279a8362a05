// Key poses: set, moved, bent, removed.
import { heading, turned } from './body';
import type { Pose } from './body';
import type { LibraryPose } from './generated/studio/studio_pb';
import { onPath } from './floor_path';
import { danceFrom, edit } from './history';
import { dancer, wire } from './link';
import { addLiveKey, changeLiveKey } from './live';
import { closest, emptyProject, freeId, sorted } from './project';
import type { Key } from './project';
import { audio } from './songs';
import { complain, live, message, motion, project, selectedKey, sketch, song } from './state';

const reach = 15; // frames within which a key that finds its place taken looks for another

/// Key poses of the library on the song's beats: a dance to begin with.
export async function compose() {
  const seconds = song.value?.heard.seconds ?? 20;
  const seed = Math.max(1, (project.value?.seed ?? 0) + 1);
  const answer = await wire.ask({ case: 'compose', value: { seconds, seed: BigInt(seed) } });
  if (answer.case !== 'keyframes') return;
  const keys = answer.value.keyframes.map((key): Key => {
    const at = key.pose!.rootPosition!;
    const frame = key.when.case === 'frame' ? Number(key.when.value) : Math.round(Number(key.when.value) * dancer.fps);
    return { id: key.id.replace(/^\d+-/, ''), frame, pose: { root: [at.x, at.y, at.z], rotations: key.pose!.rotations }, hasPlace: true };
  });
  const named: Key[] = [];
  for (const key of keys) named.push({ ...key, id: freeId(named, key.id) });
  message.value = null;
  const asked = emptyProject(song.value?.name ?? '', seconds);
  const { lively, style, path } = project.value ?? asked;
  danceFrom({ ...asked, lively, style, path, seed, keys: named.map((key) => onPath(path, key)) }, -1);
}

/// The nearest frame to a wanted one at which a key can stand; null if there is none near.
function freeFrame(keys: Key[], frame: number): number | null {
  const most = dancer.frames(project.value) - 1;
  for (let away = 0; away < reach; ++away) {
    for (const at of [frame + away, frame - away]) {
      if (at >= 0 && at <= most && keys.every((key) => Math.abs(key.frame - at) >= closest)) return at;
    }
  }
  return null;
}

/// Sets a pose of the library where the dancer is at that moment, facing as she does.
/// While it is danced live, on a beat to come, or at `at`.
export function addKey(pose: LibraryPose, at?: number) {
  if (!project.value) return;
  if (live.value) return addLiveKey(pose, at ?? null);
  const keys = project.value.keys;
  const frame = freeFrame(keys, at ?? Math.round(audio.currentTime * dancer.fps));
  if (frame === null) return complain(new Error('There is no room for a key here.'));
  const root = pose.pose!.rootPosition!;
  let placed: Pose = { root: [root.x, root.y, root.z], rotations: [...pose.pose!.rotations] };
  if (motion.value.count > frame) {
    const here = motion.value.pose(frame);
    placed = turned(placed, heading(here));
    placed.root = [here.root[0], root.y, here.root[2]];
  }
  const key = onPath(project.value.path, { id: freeId(keys, pose.id), frame, pose: placed, hasPlace: true });
  selectedKey.value = key.id;
  edit({ ...project.value, keys: sorted([...keys, key]) }, [frame]);
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
}

export function removeKey(id: string) {
  if (live.value) return changeLiveKey(id, null);
  const key = keyOf(id);
  if (!key) return;
  selectedKey.value = null;
  edit({ ...project.value, keys: project.value.keys.filter((other) => other !== key) }, [key.frame]);
}

export function poseKey(id: string, pose: Pose) {
  const key = keyOf(id);
  if (!key) return;
  const keys = project.value.keys.map((other) => (other === key ? { ...key, pose, hasPlace: true } : other));
  edit({ ...project.value, keys }, [key.frame]);
}

/// The pose that is bent, where there is one: the photo's, or the chosen key's.
export const bent = () => sketch.value?.pose ?? keyOf(selectedKey.value)?.pose;

export function bend(pose: Pose) {
  if (sketch.value) sketch.value = { ...sketch.value, pose };
  else if (selectedKey.value) poseKey(selectedKey.value, pose);
}
