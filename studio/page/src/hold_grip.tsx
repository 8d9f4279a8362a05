// How long the chosen key's pose is kept: its end is pulled on the timeline, or moved by arrow keys.
import { signal } from '@preact/signals';
import { holdStep } from './project';
import type { Key } from './project';
import { seconds, snapped, timeUnder, x, zoom } from './scale';
import * as studio from './studio';

const pulled = signal<{ id: string; frames: number } | null>(null);

function pull(event: PointerEvent, { id, frame }: Key) {
  const grip = event.currentTarget as HTMLElement;
  event.stopPropagation();
  grip.setPointerCapture(event.pointerId);
  const move = ({ clientX, altKey }: PointerEvent) => {
    const time = timeUnder(clientX);
    pulled.value = { id, frames: Math.max(0, (altKey ? Math.round(time * studio.dancer.fps) : snapped(time)) - frame) };
  };
  const end = ({ type }: PointerEvent) => {
    grip.removeEventListener('pointermove', move);
    grip.removeEventListener('pointerup', end);
    grip.removeEventListener('pointercancel', end);
    const to = pulled.value;
    pulled.value = null;
    if (to && type === 'pointerup') studio.holdKey(id, to.frames);
  };
  grip.addEventListener('pointermove', move);
  grip.addEventListener('pointerup', end);
  grip.addEventListener('pointercancel', end);
}

export function HoldGrip() {
  const item = studio.live.value ? undefined : studio.keyOf(studio.selectedKey.value);
  if (!item) return null;
  const { fps } = studio.dancer;
  const frames = pulled.value?.id === item.id ? pulled.value.frames : item.hold;
  const press = (event: KeyboardEvent) => {
    const way = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (!way) return;
    event.preventDefault();
    studio.holdKey(item.id, item.hold + way * holdStep * fps);
  };
  return (
    <>
      <i class="held" style={{ left: `${x(item.frame / fps)}px`, width: `${(frames / fps) * zoom.value}px` }} />
      <i class="grip hold" role="slider" tabIndex={0} aria-label={`How long key ${item.id} is held`}
        title={`Held for ${(frames / fps).toFixed(1)} s: pull it, with Alt beside the beats`}
        aria-valuemin={0} aria-valuemax={seconds()} aria-valuenow={item.hold / fps} aria-valuetext={`${(item.hold / fps).toFixed(1)} s`}
        style={{ left: `${x((item.frame + frames) / fps)}px` }} onPointerDown={(event) => pull(event, item)} onKeyDown={press} />
    </>
  );
}
