// How dances follow music: how strongly its energy affects them, and how much they vary where it
// repeats.
import { computed, signal } from '@preact/signals';
import { change, note } from './history';
import { limits } from '../project/limits';
import type { Project } from '../project/project';
import { project, shownSong } from '../project/state';

type Following = Pick<Project, 'dynamics' | 'variation'>;

const settings = signal<Partial<Following>>({});

/// The setting of the present dance or, without one, of the first dance.
export const following = computed((): Following => {
  const { dynamics, variation } = project.value ?? { dynamics: limits.usualMusicDynamics, variation: limits.usualVariation, ...settings.value };
  return { dynamics, variation };
});

export function follow(next: Partial<Following>) {
  if (!project.value) return void (settings.value = { ...settings.value, ...next });
  const song = shownSong.value;
  const isHeard = !!song && (next.dynamics !== undefined || song.analysis.passages.length > 0);
  if (isHeard) change(next);
  else note(next);
}
