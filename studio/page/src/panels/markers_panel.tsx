// The markers beside the stage: named, and removed.
import * as studio from '../session/studio';

export function MarkersPanel() {
  const { value } = studio.project;
  const { fps } = studio.dancer ?? { fps: 30 };
  return (
    <section aria-label="Markers">
      <h2>Markers</h2>
      {value?.markers.map((marker) => (
        <div class="named" key={marker.frame}>
          <input aria-label={`Name of the marker at ${(marker.frame / fps).toFixed(1)} s`} value={marker.name} maxLength={40}
            onChange={(event) => {
              studio.renameMarker(marker, event.currentTarget.value);
              event.currentTarget.value = studio.project.value.markers.find(({ frame }) => frame === marker.frame)?.name ?? '';
            }} />
          <span class="small">{(marker.frame / fps).toFixed(2)} s</span>
          <button class="icon" aria-label={`Remove marker ${marker.name}`} title="Remove it" onClick={() => studio.removeMarker(marker)}>×</button>
        </div>
      ))}
      <div class="row"><button disabled={!value} title="A named moment, to which keys snap (M)" onClick={studio.addMarker}>Mark the playhead</button></div>
    </section>
  );
}
