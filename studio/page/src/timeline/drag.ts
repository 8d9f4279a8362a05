// Dragging with the pointer.
import { useState } from 'preact/hooks';
import type { Marker } from '../project/project';
import { frameAt, timeUnder } from './scale';
import * as studio from '../session/studio';

/// Calls `move` until the pointer is released or the browser cancels the drag. `events`: captures
/// the pointer, unless it is the window.
export function drag(event: PointerEvent, move: (at: PointerEvent) => void, end: (isDropped: boolean) => void = () => {},
  events: HTMLElement | Window = event.currentTarget as HTMLElement) {
  const listening = new AbortController();
  const { signal } = listening;
  const over = ({ type }: Event) => {
    listening.abort();
    end(type === 'pointerup');
  };
  if (events instanceof HTMLElement) events.setPointerCapture(event.pointerId);
  event.stopPropagation();
  events.addEventListener('pointermove', move as EventListener, { signal });
  events.addEventListener('pointerup', over, { signal });
  events.addEventListener('pointercancel', over, { signal });
}

const slip = 4; // pixels

type FrameDrag = {
  /// The frame that keeps its distance to the pointer. Without it, the pointer's own frame is used.
  from?: number;
  /// The dragged marker, to which nothing snaps.
  marker?: Marker;
  /// Whether nothing snaps, even without Alt. Frames before the first are then possible.
  isFree?: boolean;
  drop: (frame: number) => void;
  /// Called instead of a drop after a press that moves only slightly. Without it every move is a
  /// drag.
  press?: () => void;
};

/// Drags a frame along the timeline, from beat to beat, or freely with Alt. Returns the frame
/// during the drag, otherwise null, and the function that begins a drag.
export function useFrameDrag({ from, marker, isFree, drop, press }: FrameDrag): [number | null, (event: PointerEvent) => void] {
  const [frame, setFrame] = useState<number | null>(null);
  const begin = (event: PointerEvent) => {
    const offset = from === undefined ? 0 : from / studio.dancer.fps - timeUnder(event.clientX);
    let to: number | null = null;
    drag(event, ({ clientX, altKey }) => {
      if (to === null && press && Math.abs(clientX - event.clientX) < slip) return;
      const time = timeUnder(clientX) + offset;
      setFrame((to = isFree ? Math.round(time * studio.dancer.fps) : frameAt(time, altKey, marker)));
    }, (isDropped) => {
      setFrame(null);
      if (to === null) press?.();
      else if (isDropped) drop(to);
    });
  };
  return [frame, begin];
}
