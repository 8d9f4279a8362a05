// The dance's history. Each change is a moment, whose motion is danced while it is watched.
import { computed, signal } from '@preact/signals';
import type { Signal } from '@preact/signals';
import { reachOf } from '../project/edit_reach';
import { dancer, skeleton } from './link';
import { Motion } from '../project/motion';
import { trimmed } from '../project/project';
import type { Project } from '../project/project';
import { returnTo } from './songs';
import { busy, selection, showError, danced, live, message, moment, moments, motion, momentIndex, project, selectedKey, song, takes, notify, warnings, work } from '../project/state';
import type { Make, Moment, Warning } from '../project/state';

const mostMoments = 60;
/// The number of frames that must exist after an interval before it alone is danced anew.
const lead = 30;

/// The number of frames of the whole dance.
export const total = computed(() => (project.value && dancer ? dancer.frames(project.value) : 0));

/// The motion shown at a time.
export const motionAt = (time: number) => {
  if (live.value) return live.value.motion;
  const { value } = moment;
  const isThere = !value || value.isReady || value.motion.value.count > time * dancer.fps + 1;
  return isThere ? motion.value : value.before;
};

/// Records warnings at their frames, and shows the others as messages.
const recordWarning = (list: Signal<Warning[]>) => (text: string, frame?: number) => {
  if (frame === undefined) return notify(text);
  if (!list.value.some((known) => known.frame === frame && known.text === text)) list.value = [...list.value, { frame, text }];
};

/// Finds what looks wrong in a moment's motion.
async function findFaults(of: Moment) {
  const checked = of.motion.value;
  if (checked.count === 0) return;
  try {
    const found = await dancer.check(checked);
    if (of.isReady && of.motion.value === checked) of.faults.value = found;
  } catch (error) {
    showError(error);
  }
}

/// Makes a moment's motion. Until it is complete, the page shows the frames that `make` has so far.
function fill(filled: Moment, make: Make) {
  const show = (longer: Motion) => {
    filled.motion.value = longer;
    if (moment.value === filled) danced.value = longer.count;
  };
  busy.value += 1;
  filled.isReady = false;
  filled.unmade = null;
  filled.faults.value = null;
  filled.ready = make({ onFrames: show, onWarning: recordWarning(filled.warnings) })
    .then(show, (error) => {
      filled.unmade = make;
      showError(error);
    })
    .then(() => {
      busy.value -= 1;
      filled.isReady = true;
      if (!filled.unmade) void findFaults(filled);
      return filled.motion.value;
    });
}

/// Waits for a moment's motion. Retries one that failed.
export async function made(of: Moment): Promise<Motion> {
  if (of.unmade) fill(of, of.unmade);
  const there = await of.ready;
  if (of.unmade) throw new Error('The dance before this change could not be danced; take it back.');
  return there;
}

/// Adds a moment after the present one, and drops undone ones.
export function push(next: Project, shown: Motion, make: Make, known: Warning[] = []) {
  takes.value = [];
  selection.value = null;
  const kept = moments.value.slice(Math.max(0, momentIndex.value + 2 - mostMoments), momentIndex.value + 1);
  const added: Moment = {
    project: next,
    song: song.value,
    motion: signal(shown),
    before: motion.value ?? shown,
    warnings: signal(known),
    faults: signal(null),
    ready: Promise.resolve(shown),
    isReady: false,
    unmade: null,
  };
  moments.value = [...kept, added];
  momentIndex.value = kept.length;
  danced.value = shown.count;
  fill(added, make);
}

let streaming: AbortController | null = null;

/// Starts streaming a dance, and ends the previous stream: only one dance streams at a time.
export function stream(): AbortController {
  streaming?.abort();
  streaming = new AbortController();
  return streaming;
}

/// Dances a project from frame `from` of `before`.
const streamFrom = (next: Project, before: Motion, from: number): Make => (watch) => {
  const control = stream();
  return dancer.stream(next, before, from, watch, control.signal).finally(() => {
    if (streaming === control) streaming = null;
  });
};

/// Dances everything after `from` anew.
export function danceFrom(next: Project, from: number) {
  const before = motion.value ?? new Motion(skeleton.joints, dancer.fps);
  const stay = warnings.value.filter(({ frame }) => frame <= from);
  push(next, from >= 0 ? before.head(from + 1) : before, streamFrom(next, before, from), stay);
}

/// Changes the project, and dances anew the frames around the changed `frames`.
export function edit(next: Project, frames: number[]) {
  const before = moment.value;
  next = { ...next, keys: trimmed(next.keys, dancer.frames(next), dancer.fps) };
  const [from, to] = reachOf(before.project.keys, next.keys, frames, dancer.frames(next), dancer.fps);
  const long = !dancer.spans(to - from);
  const there = before.isReady || !streaming ? Infinity : before.motion.value.count;
  if (long || to + lead > there) return danceFrom(next, Math.min(from, before.motion.value.count - 1));
  const stay = before.warnings.value.filter(({ frame }) => frame <= from || frame > to);
  push(next, before.motion.value, async (watch) => {
    const whole = await made(before);
    return (await dancer.between(next, whole, from, Math.min(to, whole.count), 1, watch))[0];
  }, stay);
}

/// Changes settings on which the whole dance depends.
export const change = (what: Partial<Project>) => danceFrom({ ...project.value, ...what }, -1);

/// Changes settings on which no frame depends.
export function note(what: Partial<Project>) {
  const before = moment.value;
  push({ ...project.value, ...what }, before.motion.value, () => made(before), warnings.value);
}

export const undo = () => step(-1);
export const redo = () => step(1);
function step(by: number) {
  if (live.value) return;
  const to = momentIndex.value + by;
  if (to < 0 || to >= moments.value.length) return;
  takes.value = [];
  message.value = null; // it tells of the moment that is left
  momentIndex.value = to;
  danced.value = moment.value.motion.value.count;
  if (!project.value.keys.some(({ id }) => id === selectedKey.value)) selectedKey.value = null;
  const there = moment.value;
  if (!there.song || there.song === song.value) return finish(there);
  void work(async () => {
    await returnTo(there.song!);
    if (moment.value === there) finish(there);
  });
}

/// Continues a dance that was left unfinished.
export function finish(left: Moment) {
  if (!left.isReady) return;
  const there = left.motion.value;
  if (left.unmade) fill(left, left.unmade);
  else if (there.count < total.value && left.project.keys.length > 0)
    fill(left, streamFrom(left.project, there, there.count - 1));
}
