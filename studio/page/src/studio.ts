// What the studio knows, and everything that can be done with it.
import { computed, signal } from '@preact/signals';
import type { Signal } from '@preact/signals';
import { heading, Skeleton, turned } from './body';
import type { Pose } from './body';
import { Dancer } from './dancer';
import type { Watch } from './dancer';
import type { Welcome, LibraryPose, SongHeard } from './generated/studio/studio_pb';
import { Motion } from './motion';
import { emptyProject, freeId, fromJson, sorted, toJson } from './project';
import type { Key, Project } from './project';
import { Wire } from './wire';

/// A state that undo comes back to. `motion` grows while it is danced.
/// `before` is seen where `motion` has no frames yet.
type Moment = {
  project: Project;
  motion: Signal<Motion>;
  before: Motion;
  warnings: Signal<Warning[]>;
  ready: Promise<Motion>;
  isReady: boolean;
};
/// What may look other than wished, and where.
type Warning = { frame: number; text: string };
type Song = { name: string; url: string; bytes: Uint8Array; heard: SongHeard };
export type Take = { seed: number; motion: Motion };

/// Keys stand at least so many frames apart.
const closest = 2;
const mostMoments = 60;

export const welcome = signal<Welcome | null>(null);
export const isConnected = signal(false);
export const song = signal<Song | null>(null);
export const moments = signal<Moment[]>([]);
export const present = signal(-1);
export const message = signal<{ text: string; isError: boolean } | null>(null);
/// Frames of the dance that are there, and of the dance.
export const danced = signal(0);
export const busy = signal(0);
export const selectedKey = signal<string | null>(null);
/// The interval that is chosen: the frames of the keys around it.
export const chosen = signal<[number, number] | null>(null);
export const takes = signal<Take[]>([]);
export const audio = new Audio();

export const moment = computed(() => moments.value[present.value]);
export const project = computed(() => moment.value?.project);
export const motion = computed(() => moment.value?.motion.value);
export const warnings = computed(() => moment.value?.warnings.value ?? []);
export const total = computed(() => (project.value && dancer ? dancer.frames(project.value) : 0));

export let skeleton: Skeleton;
export let dancer: Dancer;

const wire = new Wire(
  ({ response }) => {
    if (response.case !== 'welcome') return;
    const first = !welcome.value;
    skeleton = new Skeleton(response.value.model!.skeleton!);
    dancer = new Dancer(wire, response.value.model!);
    welcome.value = response.value;
    isConnected.value = true;
    if (!first) {
      tell('The studio program is there again.');
      if (song.value) void hear(song.value.name, song.value.bytes).catch(complain);
    } else if (response.value.song && response.value.heard) {
      takeSong(response.value.song.name, response.value.song.data, response.value.heard);
      void compose().catch(complain);
    }
  },
  () => {
    if (isConnected.value) complain(new Error('The studio program is gone. It is asked again each second.'));
    isConnected.value = false;
  },
);

export const tell = (text: string) => (message.value = { text, isError: false });
export const complain = (error: unknown) =>
  (message.value = { text: error instanceof Error ? error.message : String(error), isError: true });
/// What is shown at a time.
export const motionAt = (time: number) => {
  const { value } = moment;
  const isThere = !value || value.isReady || value.motion.value.count > time * dancer.fps + 1;
  return isThere ? motion.value : value.before;
};

/// Notes warnings where they belong; the rest is told.
const note = (list: Signal<Warning[]>) => (text: string, frame?: number) => {
  if (frame === undefined) return tell(text);
  if (!list.value.some((known) => known.frame === frame && known.text === text)) list.value = [...list.value, { frame, text }];
};

// ------------------------------------------------------------------------------------------- songs

const types: Record<string, string> = { mp3: 'audio/mpeg', ogg: 'audio/ogg', flac: 'audio/flac', wav: 'audio/wav' };

function takeSong(name: string, bytes: Uint8Array, heard: SongHeard) {
  if (song.value) URL.revokeObjectURL(song.value.url);
  const type = types[name.split('.').at(-1)!.toLowerCase()] ?? '';
  const url = URL.createObjectURL(new Blob([bytes as BlobPart], { type }));
  audio.src = url;
  song.value = { name, url, bytes, heard };
}

/// A sound to play a dance to that has no song.
function silence(seconds: number) {
  const [rate, header] = [8000, 44];
  const samples = Math.ceil(seconds * rate);
  const wav = new DataView(new ArrayBuffer(header + samples));
  const word = (at: number, text: string) => [...text].forEach((c, i) => wav.setUint8(at + i, c.charCodeAt(0)));
  word(0, 'RIFF');
  wav.setUint32(4, header - 8 + samples, true);
  word(8, 'WAVEfmt ');
  wav.setUint32(16, 16, true);
  wav.setUint16(20, 1, true);
  wav.setUint16(22, 1, true);
  wav.setUint32(24, rate, true);
  wav.setUint32(28, rate, true);
  wav.setUint16(32, 1, true);
  wav.setUint16(34, 8, true);
  word(36, 'data');
  wav.setUint32(40, samples, true);
  new Uint8Array(wav.buffer).fill(128, header);
  return URL.createObjectURL(new Blob([wav], { type: 'audio/wav' }));
}

async function hear(name: string, bytes: Uint8Array) {
  const answer = await wire.ask({ case: 'song', value: { name, data: bytes } });
  if (answer.case === 'song') takeSong(name, bytes, answer.value);
}

/// What was dropped or chosen: a song, a project, or a motion file.
export async function openFile(file: File) {
  const extension = file.name.split('.').at(-1)!.toLowerCase();
  busy.value += 1;
  try {
    const bytes = new Uint8Array(await file.arrayBuffer());
    if (extension === 'json') return openProject(new TextDecoder().decode(bytes));
    if (['npz', 'bvh', 'glb'].includes(extension)) return await openMotion(file.name, bytes);
    tell(`Listening to ${file.name} …`);
    await hear(file.name, bytes);
    await compose();
  } catch (error) {
    complain(error);
  } finally {
    busy.value -= 1;
  }
}

function openProject(text: string) {
  const opened = fromJson(text, skeleton.joints, dancer.fps);
  if (song.value) opened.seconds = song.value.heard.seconds;
  if (!opened.seconds) opened.seconds = ((opened.keys.at(-1)?.frame ?? 60) + 30) / dancer.fps;
  if (opened.song && opened.song !== song.value?.name) tell(`This project was made to ${opened.song}: drop that song, too.`);
  if (!song.value) audio.src = silence(opened.seconds);
  danceFrom(opened, -1);
}

async function openMotion(name: string, bytes: Uint8Array) {
  const answer = await wire.ask({ case: 'open', value: { name, data: bytes } });
  if (answer.case !== 'clip') return;
  const opened = Motion.fromClip(answer.value, skeleton.joints, dancer.fps);
  const from = project.value ?? emptyProject(song.value?.name ?? '', 0);
  const seconds = song.value?.heard.seconds ?? opened.count / dancer.fps;
  push({ ...from, seconds, keys: [] }, opened, async () => opened);
  if (!song.value) audio.src = silence(seconds);
  tell(`${name}: ${(opened.count / dancer.fps).toFixed(1)} s of dance.`);
}

// ---------------------------------------------------------------------------------- the dance itself

let streaming: AbortController | null = null;

type Make = (watch: Watch) => Promise<Motion>;

/// Gives a moment its motion; until that is there, what `make` shows is seen.
function fill(filled: Moment, make: Make) {
  const show = (grown: Motion) => {
    filled.motion.value = grown;
    if (moment.value === filled) danced.value = grown.count;
  };
  busy.value += 1;
  filled.isReady = false;
  filled.ready = make({ grown: show, noted: note(filled.warnings) })
    .then(show, complain)
    .then(() => {
      busy.value -= 1;
      filled.isReady = true;
      return filled.motion.value;
    });
}

/// A new moment behind the present one, in place of those that were undone.
function push(next: Project, shown: Motion, make: Make, known: Warning[] = []) {
  takes.value = [];
  chosen.value = null;
  const kept = moments.value.slice(Math.max(0, present.value + 2 - mostMoments), present.value + 1);
  const added: Moment = {
    project: next,
    motion: signal(shown),
    before: motion.value ?? shown,
    warnings: signal(known),
    ready: Promise.resolve(shown),
    isReady: false,
  };
  moments.value = [...kept, added];
  present.value = kept.length;
  danced.value = shown.count;
  fill(added, make);
}

/// Dances a project from behind frame `from` of `before` on. One dance streams at a time.
function streamFrom(next: Project, before: Motion, from: number): Make {
  streaming?.abort();
  const control = new AbortController();
  streaming = control;
  return (watch) =>
    dancer.stream(next, before, from, watch, control.signal).finally(() => {
      if (streaming === control) streaming = null;
    });
}

/// Dances everything behind `from` anew.
function danceFrom(next: Project, from: number) {
  const before = motion.value ?? new Motion(skeleton.joints, dancer.fps);
  const stay = warnings.value.filter(({ frame }) => frame <= from);
  push(next, from >= 0 ? before.head(from + 1) : before, streamFrom(next, before, from), stay);
}

/// Changes the project and dances what it touches, `frames`, anew: from the key before them to the
/// one behind.
function edit(next: Project, frames: number[]) {
  const before = moment.value;
  const stays = next.keys.filter(({ frame }) => !frames.includes(frame)).map(({ frame }) => frame);
  const from = stays.filter((frame) => frame < Math.min(...frames)).at(-1) ?? -1;
  const to = stays.find((frame) => frame > Math.max(...frames)) ?? dancer.frames(next);
  const long = !dancer.spans(to - from);
  const there = before.isReady || !streaming ? Infinity : before.motion.value.count;
  if (long || to + 30 > there) return danceFrom(next, Math.min(from, before.motion.value.count - 1));
  const stay = before.warnings.value.filter(({ frame }) => frame <= from || frame > to);
  push(next, before.motion.value, async (watch) => {
    const made = await before.ready;
    return (await dancer.between(next, made, from, Math.min(to, made.count), next.seed, 1, watch))[0];
  }, stay);
}

export const undo = () => step(-1);
export const redo = () => step(1);
function step(by: number) {
  const to = present.value + by;
  if (to < 0 || to >= moments.value.length) return;
  takes.value = [];
  present.value = to;
  const there = moment.value.motion.value;
  danced.value = there.count;
  // A dance that was left before its end goes on.
  const isWhole = there.count >= total.value || project.value.keys.length === 0;
  if (moment.value.isReady && !isWhole) fill(moment.value, streamFrom(project.value, there, there.count - 1));
  if (!project.value.keys.some(({ id }) => id === selectedKey.value)) selectedKey.value = null;
}

// -------------------------------------------------------------------------------------------- keys

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
  danceFrom({ ...emptyProject(song.value?.name ?? '', seconds), lively: project.value?.lively ?? [1, 1, 1, 1, 1], seed, keys: named }, -1);
}

/// The nearest frame to a wanted one at which a key can stand; null if there is none near.
function freeFrame(keys: Key[], frame: number): number | null {
  const most = dancer.frames(project.value) - 1;
  for (let away = 0; away < 15; ++away) {
    for (const at of [frame + away, frame - away]) {
      if (at >= 0 && at <= most && keys.every((key) => Math.abs(key.frame - at) >= closest)) return at;
    }
  }
  return null;
}

/// Sets a pose of the library where the dancer is at that moment, facing as she does.
export function addKey(pose: LibraryPose, at: number) {
  if (!project.value) return;
  const keys = project.value.keys;
  const frame = freeFrame(keys, at);
  if (frame === null) return complain(new Error('There is no room for a key here.'));
  const root = pose.pose!.rootPosition!;
  let placed: Pose = { root: [root.x, root.y, root.z], rotations: [...pose.pose!.rotations] };
  if (motion.value.count > frame) {
    const here = motion.value.pose(frame);
    placed = turned(placed, heading(here));
    placed.root = [here.root[0], root.y, here.root[2]];
  }
  const key: Key = { id: freeId(keys, pose.id), frame, pose: placed, hasPlace: true };
  selectedKey.value = key.id;
  edit({ ...project.value, keys: sorted([...keys, key]) }, [frame]);
}

export const keyOf = (id: string | null) => project.value?.keys.find((key) => key.id === id);

export function moveKey(id: string, to: number) {
  const key = keyOf(id);
  if (!key) return;
  const others = project.value.keys.filter((other) => other !== key);
  const frame = freeFrame(others, to);
  if (frame === null || frame === key.frame) return;
  edit({ ...project.value, keys: sorted([...others, { ...key, frame }]) }, [key.frame, frame]);
}

export function removeKey(id: string) {
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

export function setLively(part: number, factor: number) {
  const lively = project.value.lively.map((old, i) => (i === part ? factor : old));
  danceFrom({ ...project.value, lively }, -1);
}

// ------------------------------------------------------------------------------------------- takes

/// Of takes that may never be kept, nothing is said.
const silent: Watch = { grown: () => {}, noted: () => {} };

/// Other ways to dance the chosen interval, or all of it.
export async function tryTakes(count = 3) {
  const before = moment.value;
  busy.value += 1;
  try {
    const seed = before.project.seed + moments.value.length * 100 + takes.value.length;
    const made = await before.ready;
    if (moment.value !== before) return;
    if (chosen.value) {
      const [from, to] = chosen.value;
      const motions = await dancer.between(before.project, made, from, Math.min(to, made.count), seed, count, silent);
      if (moment.value === before) takes.value = motions.map((other) => ({ seed: before.project.seed, motion: other }));
      return;
    }
    const control = new AbortController();
    streaming?.abort();
    streaming = control;
    const others: Take[] = [];
    await Promise.all(Array.from({ length: count }, async (_, i) => {
      const next = { ...before.project, seed: seed + 1 + i };
      const take: Take = { seed: next.seed, motion: new Motion(skeleton.joints, dancer.fps) };
      others.push(take);
      await dancer.stream(next, null, -1, { ...silent, grown: (grown) => {
        if (take.motion === grown || moment.value !== before) return;
        take.motion = grown;
        takes.value = others.filter(({ motion: some }) => some.count > 0);
      } }, control.signal);
    }));
  } catch (error) {
    complain(error);
  } finally {
    busy.value -= 1;
  }
}

export function keepTake(take: Take) {
  const { motion: kept, seed } = take;
  if (kept.count < total.value) return tell('This take is not danced to its end yet.');
  push({ ...project.value, seed }, kept, async () => kept, warnings.value);
  tell('Kept.');
}

// ------------------------------------------------------------------------------------------- files

export function download(name: string, data: BlobPart, type = 'application/octet-stream') {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob([data], { type }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

export const stem = () => (project.value?.song || 'dance').replace(/\.[^.]*$/, '');

export const saveProject = () => download(`${stem()}.json`, toJson(project.value, dancer.fps), 'application/json');

export async function exportAs(extension: string) {
  busy.value += 1;
  try {
    const made = await moment.value.ready;
    const answer = await wire.ask({ case: 'export', value: { name: `${stem()}.${extension}`, clip: made.toClip() } });
    if (answer.case === 'file') download(answer.value.name, answer.value.data as BlobPart);
  } catch (error) {
    complain(error);
  } finally {
    busy.value -= 1;
  }
}

export const togglePlay = () => {
  if (!audio.paused) return audio.pause();
  if (audio.ended) audio.currentTime = 0;
  void audio.play().catch(complain);
};
