// The beats of the song that is danced to.
import { computed } from '@preact/signals';
import { counted } from './counts';
import type { Beats } from './counts';
import { sections } from './form';
import { shownSong } from './state';

const none: Beats = { bar: 4, list: [] };

/// As the program heard them.
export const heardBeats = computed(() => {
  const heard = shownSong.value?.heard;
  return heard ? counted(heard.beats, heard.counts, heard.beatsInBar) : none;
});

export const beats = heardBeats;

/// What comes back in the song.
export const form = computed(() => sections(shownSong.value?.heard.passages ?? []));
