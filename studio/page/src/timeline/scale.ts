// Converts between seconds and positions on the timeline.
import { signal } from '@preact/signals';
import type { Marker } from '../project/project';
import * as studio from '../session/studio';

export const zoom = signal(48); // pixels a second
export const edge = 40; // pixels of margin beside the song
const snap = 10; // pixels within which a beat attracts
/// The element with the timeline's content, once it exists.
export const content = signal<HTMLElement | null>(null);

export const x = (seconds: number) => edge + seconds * zoom.value;
export const clock = (seconds: number) => `${Math.floor(seconds / 60)}:${(seconds % 60).toFixed(1).padStart(4, '0')}`;
export const seconds = () => studio.project.value?.seconds ?? 0;

export const beatTimes = () => studio.beats.value.list.map(({ time }) => time);

/// The frame of the nearest beat, marker, or one of `others`, if one is near on the screen; not of the marker that is `moved`.
export function snapped(time: number, moved?: Marker, others: number[] = []): number {
  const at = Math.min(Math.max(time, 0), seconds());
  let best = at;
  let away = snap / zoom.value;
  const marks = studio.project.value?.markers.filter((marker) => marker !== moved) ?? [];
  for (const beat of [...[...marks.map(({ frame }) => frame), ...others].map((frame) => frame / studio.dancer.fps), ...studio.suggested.value.map(({ time }) => time), ...beatTimes()]) {
    if (Math.abs(beat - at) < away) [best, away] = [beat, Math.abs(beat - at)];
  }
  return Math.round(best * studio.dancer.fps);
}

export const timeUnder = (clientX: number) => (clientX - content.value!.getBoundingClientRect().left - edge) / zoom.value;

/// The frame of a time under the pointer: that of a near beat or marker, unless it moves freely.
export const frameAt = (time: number, isFree: boolean, moved?: Marker, others?: number[]) =>
  (isFree ? Math.max(0, Math.round(time * studio.dancer.fps)) : snapped(time, moved, others));

export const zoomTo = (pixels: number) => (zoom.value = Math.min(200, Math.max(8, pixels)));

/// Zooms in as far as two frames and everything between them still fit.
export function show(from: number, to: number) {
  const view = content.value!.parentElement!;
  zoomTo(((view.clientWidth - 2 * edge) * studio.dancer.fps) / (to - from));
  requestAnimationFrame(() => (view.scrollLeft = x(from / studio.dancer.fps) - edge));
}

/// The frame of the next beat on either side, or half a second away; the next frame if single
/// frames are requested.
export function stepped(frame: number, way: 1 | -1, byFrames: boolean): number {
  if (byFrames) return frame + way;
  const frames = beatTimes().map((beat) => Math.round(beat * studio.dancer.fps));
  return (way > 0 ? frames.find((beat) => beat > frame) : frames.findLast((beat) => beat < frame)) ?? frame + 15 * way;
}

/// The frame under the pointer, that of a near beat, marker or key unless it moves freely; null outside the timeline.
export function frameUnder({ clientX, clientY, altKey }: PointerEvent): number | null {
  const box = content.value?.parentElement!.getBoundingClientRect();
  if (!box || !studio.project.value) return null;
  const inside = clientX >= box.left && clientX <= box.right && clientY >= box.top && clientY <= box.bottom;
  return inside ? frameAt(timeUnder(clientX), altKey, undefined, studio.project.value.keys.map(({ frame }) => frame)) : null;
}
