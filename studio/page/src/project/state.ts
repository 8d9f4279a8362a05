// The studio's state, as signals.
import { computed, signal } from '@preact/signals';
import type { Signal } from '@preact/signals';
import type { Pose } from './body';
import type { Watch } from './dancer';
import type { Welcome, SongHeard } from '../generated/studio/studio_pb';
import type { Fault, Motion } from './motion';
import type { Project } from './project';

/// Makes a moment's motion.
export type Make = (watch: Watch) => Promise<Motion>;
/// A state for undo. `motion` grows while it is danced; `before` is shown where it has no frames yet.
export type Moment = {
  project: Project;
  song: Song | null;
  motion: Signal<Motion>;
  before: Motion;
  warnings: Signal<Warning[]>;
  /// What looks wrong in its motion; null while that is not known.
  faults: Signal<Fault[] | null>;
  ready: Promise<Motion>;
  isReady: boolean;
  /// How to make its motion, if that has failed.
  unmade: Make | null;
};
/// A possible problem, and its frame.
export type Warning = { frame: number; text: string };
export type Song = { name: string; url: string; bytes: Uint8Array; analysis: SongHeard };
/// A picture and its landmarks, 0 to 1 along its sides.
export type Photo = { url: string; width: number; height: number; marks: { x: number; y: number; visibility: number }[] };
/// A pose from a photo that is not a key yet.
export type Sketch = { id: string; pose: Pose; photo: Photo };
/// How to detect the beats of live music. `tempo`: the approximate tempo, per minute; `pace`: half
/// or double tempo; `later`: the beats' delay, seconds; `one`: a second at which a bar began.
export type LiveHint = { tempo: number | null; pace: 'half' | 'double' | null; later: number; one: number | null };
/// A live dance in progress; `beats`: those heard, seconds.
export type Live = { project: Project; motion: Motion; beats: { time: number; isDown: boolean; sure: number }[]; hint: LiveHint };
export type Take = { seed: number; motion: Motion };

export const welcome = signal<Welcome | null>(null);
export const isConnected = signal(false);
export const song = signal<Song | null>(null);
export const moments = signal<Moment[]>([]);
export const momentIndex = signal(-1);
export const message = signal<{ text: string; isError: boolean } | null>(null);
/// The number of frames danced so far.
export const danced = signal(0);
export const busy = signal(0);
export const selectedKey = signal<string | null>(null);
/// The selected phrase, as frames [from, to): an interval between two keys, or any part.
export const selection = signal<[number, number] | null>(null);
export const takes = signal<Take[]>([]);
/// The onion skin: nothing, neighbouring keys, or neighbouring frames.
export const onion = signal<'off' | 'keys' | 'frames'>('off');
/// The progress of a film, 0 to 1, and the remaining time as text, empty if unknown. Null while none is made.
export const filming = signal<{ share: number; left: string } | null>(null);
export const live = signal<Live | null>(null);
export const sketch = signal<Sketch | null>(null);

export const moment = computed(() => moments.value[momentIndex.value]);
export const project = computed(() => live.value?.project ?? moment.value?.project);
export const motion = computed(() => live.value?.motion ?? moment.value?.motion.value);
/// The song on the timeline.
export const shownSong = computed(() => (live.value ? null : song.value));
export const warnings = computed(() => moment.value?.warnings.value ?? []);
export const faults = computed(() => moment.value?.faults.value ?? null);

/// The project as last begun, opened or saved.
export const savedProject = signal<Project | undefined>(undefined);
/// Whether closing the page loses work.
export const isUnsaved = computed(() => !!live.value || project.value !== savedProject.value);

/// Begins or opens something without marking it as unsaved work.
export async function begin(body: () => Promise<void>) {
  const wasUnsaved = isUnsaved.value;
  await body();
  if (!wasUnsaved) savedProject.value = project.value;
}

export const notify = (text: string) => (message.value = { text, isError: false });
/// Shows those notes that are not empty, together.
export const notifyOf = (...notes: string[]) => notes.some(Boolean) && notify(notes.filter(Boolean).join(' '));
/// The opened file's name and problems.
export const opened = (name: string, what: string, notes: string[]) => [`${name}: ${what}.`, ...notes.map((note) => `Note: ${note}.`)].join(' ');
export const showError = (error: unknown) =>
  (message.value = { text: error instanceof Error ? error.message : String(error), isError: true });

/// Runs something that takes a while; reports errors.
export async function work(body: () => Promise<void>) {
  busy.value += 1;
  try {
    await body();
  } catch (error) {
    showError(error);
  } finally {
    busy.value -= 1;
  }
}
