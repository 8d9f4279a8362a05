// The live dance to the microphone. Afterwards the recording is the song, and the dance is kept.
import { signal } from '@preact/signals';
import { AudioEncoding } from '../generated/choreo/v1/choreography_pb';
import type { LibraryPose } from '../generated/studio/studio_pb';
import { countedLive } from '../project/counts';
import { drawing } from './floor_path';
import { following } from './following';
import { push } from './history';
import { dancer, skeleton, wire } from './link';
import { listen } from './microphone';
import type { Microphone } from './microphone';
import { Motion } from '../project/motion';
import { limits } from '../project/limits';
import { beatAfter, shownAhead } from './live_beats';
import { emptyProject, freeId, sorted, settingsOf } from '../project/project';
import { keyMessage, projectMessage } from '../project/project_file';
import type { Key } from '../project/project';
import { dropSketch } from './photos';
import { audio, analyseSong } from './songs';
import { selection, showError, isConnected, live, message, moment, selectedKey, takes, notify, work } from '../project/state';
import type { Live, LiveHint } from '../project/state';
import { wav } from './wav';

const lookAhead = 0.3; // seconds; nearer frames are already danced
const ahead = 1; // seconds; least time until a requested pose
const spare = 0.07; // seconds for a piece of sound, and the way to the program and back
const lastWait = 10000; // ms for the end of the dance
const unheard = 10; // seconds; live music ends this long before the longest song
const name = 'microphone.wav';

let call = 0;
let microphone: Microphone | null = null;
let pieces: Float32Array[] = [];
let samples = 0;
let rate = 48000;
let last = 0; // arrival of the last piece, ms
let granted = 0;
let latency = 0; // seconds of music that the model hears ahead
let ended: (() => void) | null = null;
let isLost = false; // the call, before its end

/// The sound's level, 0 to 1.
export const level = signal(0);

const send = (value: Extract<Parameters<typeof wire.send>[1], { case: 'live' }>['value']) => wire.send(call, { case: 'live', value });

const heardSeconds = () => samples / rate;
const sinceLast = () => Math.min(0.05, (performance.now() - last) / 1000);

/// The current second of the music.
export const soundingNow = () => heardSeconds() + sinceLast();

/// The playback position: in the song, or far enough behind the microphone that the frames exist.
export function now(): number {
  if (!live.value) return audio.currentTime;
  if (samples === 0) return 0;
  return Math.max(0, soundingNow() - latency - spare);
}

const update = (what: Partial<Live>) => {
  if (live.value) live.value = { ...live.value, ...what };
};

const asHeard: LiveHint = { tempo: null, pace: null, later: 0, one: null };
/// Whether the dance uses the beats as detected.
export const isAsHeard = () => Object.entries(asHeard).every(([name, value]) => live.value?.hint[name as keyof LiveHint] === value);

/// Sets how beats are detected from now on; as they come without an argument.
export function hintLive(change?: Partial<LiveHint>) {
  if (!live.value) return;
  const hint = change ? { ...live.value.hint, ...change } : asHeard;
  const { tempo, pace, later, one } = hint;
  update({ hint });
  wire.send(call, { case: 'liveBeats', value: { tempo: tempo ?? undefined, halfTime: pace === 'half', doubleTime: pace === 'double', later, downbeat: one ?? undefined } });
}

export const startLive = () => work(async () => {
  if (live.value) return;
  audio.pause();
  dropSketch();
  [message.value, selectedKey.value, selection.value, takes.value] = [null, null, null, []];
  [pieces, samples, granted, latency, isLost, drawing.value] = [[], 0, 0, 0, false, false];
  const empty = emptyProject(name, shownAhead);
  const before = { ...(moment.value?.project ?? empty), ...following.value };
  const early: Float32Array[] = [];
  microphone = await listen((piece) => (live.value ? sendPiece(piece) : early.push(piece)), () => void stopLive());
  rate = microphone.rate;
  const motion = new Motion(skeleton.joints, dancer.fps);
  live.value = { project: { ...empty, ...settingsOf(before), path: empty.path, seed: before.seed }, motion, beats: [], hint: asHeard };
  call = wire.open(
    { case: 'dance', value: { project: projectMessage(live.value.project, dancer.fps), liveMusic: { encoding: AudioEncoding.PCM_F32LE, sampleRate: rate, channels: 1 } } },
    { onResponse: ({ response }) => response.case === 'dance' && receive(response.value.response, motion), onFailure: failed },
  );
  early.forEach(sendPiece);
});

function failed(error: Error) {
  showError(error);
  isLost = true;
  ended?.();
  if (microphone) void stopLive();
}

type Part = Extract<Parameters<Parameters<typeof wire.open>[1]['onResponse']>[0]['response'], { case: 'dance' }>['value']['response'];

function receive(part: Part, motion: Motion) {
  if (part.case === 'header') latency = part.value.latencyFrames / part.value.frameRate;
  else if (part.case === 'frames') motion.append(part.value);
  else if (part.case === 'summary') ended?.();
  else if (part.case === 'event') {
    const { event, time } = part.value;
    if (event.case === 'beat') update({ beats: [...live.value!.beats, { time, isDown: event.value.downbeat, sure: event.value.confidence }] });
    else if (event.case === 'warning') notify(event.value.message);
    else if (event.case === 'keyframeRejected') {
      const { id, reason } = event.value;
      if (live.value) setKeys(live.value.project.keys.filter((key) => key.id !== id));
      notify(`${id} is refused: ${reason}`);
    }
  }
}

/// Sends a piece of sound: first the grant of frames, then the sound.
function sendPiece(piece: Float32Array) {
  if (!live.value || !microphone) return;
  pieces.push(piece);
  samples += piece.length;
  last = performance.now();
  level.value = Math.max(level.value * 0.9, ...piece.map(Math.abs));
  granted = Math.round((heardSeconds() + lookAhead) * dancer.fps);
  send({ request: { case: 'generateUntil', value: { frame: BigInt(granted) } } });
  send({ request: { case: 'audio', value: { data: new Uint8Array(piece.buffer, piece.byteOffset, piece.byteLength) } } });
  if (live.value.project.seconds < heardSeconds() + shownAhead - 1)
    update({ project: { ...live.value.project, seconds: Math.floor(heardSeconds()) + shownAhead } });
  if (heardSeconds() > limits.songS - unheard) void stopLive();
}

/// Releases the microphone. Its recording becomes the song, and the dance to it is kept.
export const stopLive = () => work(async () => {
  if (!microphone || !live.value) return;
  microphone.stop();
  microphone = null;
  const { project, motion } = live.value;
  const keys = project.keys.filter(({ frame }) => frame < granted);
  const heardOtherwise = !isAsHeard();
  const isWhole = !isLost && await new Promise<boolean>((resolve) => {
    ended = () => resolve(true);
    for (const key of project.keys.filter((some) => !keys.includes(some))) send({ request: { case: 'removeKeyframe', value: { id: key.id } } });
    send({ request: { case: 'endOfAudio', value: {} } });
    send({ request: { case: 'keyframesComplete', value: {} } });
    setTimeout(() => resolve(false), lastWait);
  });
  ended = null;
  wire.end(call);
  const all = new Float32Array(samples);
  let at = 0;
  for (const piece of pieces) {
    all.set(piece, at);
    at += piece.length;
  }
  pieces = [];
  const beats = heardOtherwise ? countedLive(live.value.beats) : null;
  live.value = null;
  if (motion.count === 0) throw new Error('Nothing was heard to dance to.');
  if (isLost) await connected();
  await analyseSong(name, wav(all, rate, 16));
  push({ ...project, seconds: samples / rate, keys, beats }, motion, async () => motion);
  notify(isWhole
    ? 'Export the dance to keep it: its project holds no frames, and becomes another dance when it is opened.'
    : 'The dance ended early; its frames so far stay.');
});

/// The program may be restarting.
async function connected() {
  for (let i = 0; i < 120 && !isConnected.value; ++i) await new Promise((resolve) => setTimeout(resolve, 500));
}

const setKeys = (keys: Key[]) => update({ project: { ...live.value!.project, keys: sorted(keys) } });
const earliest = () => granted + 3;

/// Requests a pose at a frame or on a coming beat, wherever the dancer is then.
export function addLiveKey(pose: LibraryPose, wanted: number | null) {
  const { keys } = live.value!.project;
  const soon = heardSeconds() + ahead;
  let frame = Math.max(earliest(), wanted ?? Math.round(beatAfter(soon) * dancer.fps));
  while (keys.some((key) => Math.abs(key.frame - frame) < limits.keyDistance)) frame += limits.keyDistance;
  const { x, y, z } = pose.pose!.rootPosition!;
  const key: Key = { id: freeId(keys, pose.id), frame, pose: { root: [x, y, z], rotations: [...pose.pose!.rotations] }, hasPlace: false, joints: null, hold: 0, hit: null, hands: 0 };
  send({ request: { case: 'keyframe', value: keyMessage(key) } });
  setKeys([...keys, key]);
}

/// Moves a future key to another frame; removes it if `to` is null.
export function changeLiveKey(id: string, to: number | null) {
  const { keys } = live.value!.project;
  const key = keys.find((some) => some.id === id);
  if (!key || key.frame < earliest()) return notify('This pose has already been danced.');
  const others = keys.filter((some) => some !== key);
  if (to === null) {
    send({ request: { case: 'removeKeyframe', value: { id } } });
    return setKeys(others);
  }
  const moved = { ...key, frame: Math.max(earliest(), to) };
  if (others.some(({ frame }) => Math.abs(frame - moved.frame) < limits.keyDistance)) return;
  send({ request: { case: 'keyframe', value: keyMessage(moved) } });
  setKeys([...others, moved]);
}
