// The markers on the timeline: dragged, or moved by arrow keys.
import { useFrameDrag } from './drag';
import type { Marker } from '../project/project';
import { stepped, x } from './scale';
import * as studio from '../session/studio';

function Flag({ marker }: { marker: Marker }) {
  const { fps } = studio.dancer;
  const seek = () => (studio.audio.currentTime = marker.frame / fps);
  const [dragged, grab] = useFrameDrag({ from: marker.frame, marker, drop: (to) => studio.moveMarker(marker, to), press: seek });
  const frame = dragged ?? marker.frame;
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
