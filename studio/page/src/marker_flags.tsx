// The markers on the timeline: dragged, or moved by arrow keys.
import { signal } from '@preact/signals';
import type { Marker } from './project';
import { snapped, stepped, timeUnder, x } from './scale';
import * as studio from './studio';

const carried = signal<{ of: Marker; frame: number } | null>(null);

function Flag({ marker }: { marker: Marker }) {
  const { fps } = studio.dancer;
  const frame = carried.value?.of === marker ? carried.value.frame : marker.frame;
  const seek = () => (studio.audio.currentTime = marker.frame / fps);
  const grab = (event: PointerEvent) => {
    const flag = event.currentTarget as HTMLElement;
    const from = event.clientX;
    flag.setPointerCapture(event.pointerId);
    const move = ({ clientX, altKey }: PointerEvent) => {
      if (!carried.value && Math.abs(clientX - from) < 4) return;
      const time = timeUnder(clientX);
      carried.value = { of: marker, frame: altKey ? Math.max(0, Math.round(time * fps)) : snapped(time, marker) };
    };
    const end = ({ type }: PointerEvent) => {
      flag.removeEventListener('pointermove', move);
      flag.removeEventListener('pointerup', end);
      flag.removeEventListener('pointercancel', end);
      const to = carried.value;
      carried.value = null;
      if (to && type === 'pointerup') studio.moveMarker(marker, to.frame);
      else if (!to) seek();
    };
    flag.addEventListener('pointermove', move);
    flag.addEventListener('pointerup', end);
    flag.addEventListener('pointercancel', end);
  };
  const press = (event: KeyboardEvent) => {
    if (event.key === 'Enter') seek();
    else if (event.key === 'Delete' || event.key === 'Backspace') studio.removeMarker(marker);
    else if (event.key === 'ArrowRight') studio.moveMarker(marker, stepped(marker.frame, 1, event.shiftKey));
    else if (event.key === 'ArrowLeft') studio.moveMarker(marker, stepped(marker.frame, -1, event.shiftKey));
    else return;
    event.preventDefault();
  };
  return (
    <button class="marker" style={{ left: `${x(frame / fps)}px` }} data-marker={marker.name} aria-label={`Marker ${marker.name} at ${(frame / fps).toFixed(1)} s`}
      title={`${marker.name} at ${(frame / fps).toFixed(2)} s. Drag to move, press to go there.`}
      onPointerDown={grab} onKeyDown={press} onClick={(event) => event.detail === 0 && seek()}>
      {marker.name}
    </button>
  );
}

export function MarkerFlags() {
  return studio.project.value!.markers.filter(({ frame }) => frame < studio.total.value).map((marker) => <Flag key={marker.name + marker.frame} marker={marker} />);
}
