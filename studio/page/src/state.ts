// What the studio knows: signals, which everything that is shown follows.
import { computed, signal } from '@preact/signals';
import type { Signal } from '@preact/signals';
import type { Pose } from './body';
import type { Watch } from './dancer';
import type { Welcome, SongHeard } from './generated/studio/studio_pb';
import type { Motion } from './motion';
import type { Project } from './project';

/// How a moment's motion comes to be.
export type Make = (watch: Watch) => Promise<Motion>;
/// A state that undo comes back to. `motion` grows while it is danced.
/// `before` is seen where `motion` has no frames yet.
export type Moment = {
  project: Project;
  song: Song | null;
  motion: Signal<Motion>;
  before: Motion;
  warnings: Signal<Warning[]>;
  ready: Promise<Motion>;
  isReady: boolean;
  /// Set where its motion could not be made: how it would be.
  unmade: Make | null;
};
/// What may look other than wished, and where.
export type Warning = { frame: number; text: string };
export type Song = { name: string; url: string; bytes: Uint8Array; heard: SongHeard };
/// A picture, and the landmarks that were seen in it, 0 to 1 along its sides.
export type Photo = { url: string; width: number; height: number; marks: { x: number; y: number; visibility: number }[] };
/// A pose that was seen in a photo and is no key yet.
export type Sketch = { id: string; pose: Pose; photo: Photo };
/// A dance to the microphone in progress; `beats` that were heard, seconds.
export type Live = { project: Project; motion: Motion; beats: number[] };
export type Take = { seed: number; motion: Motion };

export const welcome = signal<Welcome | null>(null);
export const isConnected = signal(false);
export const song = signal<Song | null>(null);
export const moments = signal<Moment[]>([]);
export const present = signal(-1);
export const message = signal<{ text: string; isError: boolean } | null>(null);
/// Frames of the dance that are there.
export const danced = signal(0);
export const busy = signal(0);
export const selectedKey = signal<string | null>(null);
/// The phrase that is chosen, from a frame until another: an interval between two keys, or any.
export const chosen = signal<[number, number] | null>(null);
export const takes = signal<Take[]>([]);
/// What is seen through beside the dancer: nothing, the keys around, or the frames around.
export const onion = signal<'off' | 'keys' | 'frames'>('off');
/// How much of a film is made, 0 to 1, and how long the rest takes, for people: empty while nobody knows. Null while none is made.
export const filming = signal<{ share: number; left: string } | null>(null);
export const live = signal<Live | null>(null);
export const sketch = signal<Sketch | null>(null);

export const moment = computed(() => moments.value[present.value]);
export const project = computed(() => live.value?.project ?? moment.value?.project);
export const motion = computed(() => live.value?.motion ?? moment.value?.motion.value);
/// The song on the timeline.
export const shownSong = computed(() => (live.value ? null : song.value));
export const warnings = computed(() => moment.value?.warnings.value ?? []);

/// The project as it was begun, opened or saved last: it is there again in no time.
export const kept = signal<Project | undefined>(undefined);
/// Whether work is lost with the page.
export const isUnsaved = computed(() => !!live.value || project.value !== kept.value);

/// Begins or opens something: what was no work before is none now.
export async function begin(body: () => Promise<void>) {
  const wasUnsaved = isUnsaved.value;
  await body();
  if (!wasUnsaved) kept.value = project.value;
}

export const tell = (text: string) => (message.value = { text, isError: false });
/// What was opened, and what its file says otherwise.
export const opened = (name: string, what: string, notes: string[]) => [`${name}: ${what}.`, ...notes.map((note) => `Note: ${note}.`)].join(' ');
export const complain = (error: unknown) =>
  (message.value = { text: error instanceof Error ? error.message : String(error), isError: true });

/// Does something that takes a while; what goes wrong is told.
export async function work(body: () => Promise<void>) {
  busy.value += 1;
  try {
    await body();
  } catch (error) {
    complain(error);
  } finally {
    busy.value -= 1;
  }
}
