// What the studio knows: signals, which everything that is shown follows.
import { computed, signal } from '@preact/signals';
import type { Signal } from '@preact/signals';
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
/// The interval that is chosen: the frames of the keys around it.
export const chosen = signal<[number, number] | null>(null);
export const takes = signal<Take[]>([]);

export const moment = computed(() => moments.value[present.value]);
export const project = computed(() => moment.value?.project);
export const motion = computed(() => moment.value?.motion.value);
export const warnings = computed(() => moment.value?.warnings.value ?? []);

export const tell = (text: string) => (message.value = { text, isError: false });
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
