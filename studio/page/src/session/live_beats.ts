// The beats of a live dance: detected ones, and predicted ones.
import { computed } from '@preact/signals';
import { countedLive, eight } from '../project/counts';
import type { Beat, Beats } from '../project/counts';
import { live } from '../project/state';

export const shownAhead = 8; // seconds of the timeline after now

const heardBeats = computed(() => countedLive(live.value?.beats ?? []));

/// Future beats, extrapolated from the detected ones.
const coming = computed((): Beat[] => {
  const { bar, list } = heardBeats.value;
  if (list.length < 3) return [];
  const last = list.at(-1)!;
  const period = (last.time - list.at(-3)!.time) / 2;
  return Array.from({ length: Math.min(64, Math.ceil(shownAhead / period) + 4) }, (_, i) => ({
    time: last.time + (i + 1) * period,
    count: last.count && ((last.count + i) % eight(bar)) + 1,
  }));
});

export const liveBeats = computed((): Beats => ({ bar: heardBeats.value.bar, list: [...heardBeats.value.list, ...coming.value] }));

/// The first future beat at or after a second; the second itself if there is none.
export const beatAfter = (seconds: number) => coming.value.find(({ time }) => time >= seconds)?.time ?? seconds;
