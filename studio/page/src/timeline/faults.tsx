// What looks wrong in the dance: marks on the timeline, and a list beside the stage. A press goes there.
import { clock, x, zoom } from './scale';
import type { Fault } from '../project/motion';
import * as studio from '../session/studio';

const goTo = ({ from }: Fault) => {
  studio.audio.pause();
  studio.audio.currentTime = from / studio.dancer.fps;
};

/// A list of these is beside the stage, for keyboards and fingers.
export function FaultMarks() {
  const { fps } = studio.dancer;
  return studio.faults.value?.map((fault, nth) => (
    <i class="fault" key={nth} aria-hidden="true" title={fault.text} onClick={() => goTo(fault)}
      style={{ left: `${x(fault.from / fps)}px`, width: `${((fault.to - fault.from + 1) / fps) * zoom.value}px` }} />
  ));
}

export function FaultsPanel() {
  const { value } = studio.faults;
  return (
    <section aria-label="Faults">
      <h2>Faults <small>{value === null ? '' : value.length || 'none found'}</small></h2>
      {!!value?.length && (
        <ul class="faults">
          {value.map((fault, nth) => (
            <li key={nth}>
              <button title="Go there" onClick={() => goTo(fault)}><span>{clock(fault.from / studio.dancer.fps)}</span> {fault.text}</button>
            </li>
          ))}
        </ul>
      )}
    </section>
  );
}
