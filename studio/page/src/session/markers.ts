// Named moments on the ruler: keys snap to them, and no frame depends on them.
import { note, total } from './history';
import { dancer } from './link';
import { freeName, withMarker } from '../project/project';
import type { Marker } from '../project/project';
import { audio } from './songs';
import { live, project, notify } from '../project/state';

function change(old: Marker | null, next: Marker | null) {
  const markers = withMarker(project.value.markers, old, next);
  if (markers) note({ markers });
  else notify('There is already a marker.');
}

/// Marks the playhead.
export function addMarker() {
  if (!project.value || live.value) return;
  const frame = Math.min(Math.round(audio.currentTime * dancer.fps), total.value - 1);
  change(null, { frame, name: freeName(project.value.markers.map(({ name }) => name), 'mark') });
}

export function moveMarker(marker: Marker, to: number) {
  const frame = Math.min(Math.max(Math.round(to), 0), total.value - 1);
  if (frame !== marker.frame) change(marker, { ...marker, frame });
}

export function renameMarker(marker: Marker, name: string) {
  const wanted = name.trim();
  if (wanted && wanted !== marker.name) change(marker, { ...marker, name: wanted });
}

export const removeMarker = (marker: Marker) => change(marker, null);
