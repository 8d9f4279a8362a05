// The floor path's corners as numbers, for keyboards and screen readers.
import { NumberField } from './number_field';
import * as studio from '../session/studio';

const most = 100; // metres from the middle of the floor

export function PathPoints() {
  const spots = studio.corners.value;
  const change = (point: number, what: Partial<{ x: number; z: number }>) =>
    studio.setCorners(spots.map((spot, i) => (i === point ? { ...spot, ...what } : spot)));
  const field = (i: number, axis: 'x' | 'z') => (
    <NumberField label={axis} name={`Point ${i + 1}, ${axis} in metres`} value={spots[i][axis]} low={-most} high={most} step={0.1}
      rule={`${axis} is ${-most} to ${most} metres`} set={(value) => change(i, { [axis]: value })} focused={() => (studio.heldCorner.value = i)} />
  );
  return (
    <details onToggle={(event) => (studio.areCornersShown.value = event.currentTarget.open)}>
      <summary>Points by keyboard</summary>
      <p class="small">Metres on the floor: x to her left, z ahead, as she faces at the beginning. Arrow keys move a point by 0.1, with Shift by 1.</p>
      {spots.length > 0 && (
        <ol class="points" aria-label="Points of the path">
          {spots.map((_, i) => (
            <li key={`${i} of ${spots.length}`}>
              {field(i, 'x')}
              {field(i, 'z')}
              <button class="icon" aria-label={`Remove point ${i + 1}`} title="Remove this point" onClick={() => studio.setCorners(spots.filter((_, j) => j !== i))}>×</button>
            </li>
          ))}
        </ol>
      )}
      <div class="row"><button disabled={!studio.project.value} onClick={studio.addCorner}>Add a point</button></div>
    </details>
  );
}
