// How long the selected key's pose is held: its end is dragged on the timeline or moved by arrow
// keys.
import { useFrameDrag } from './drag';
import { limits } from '../project/limits';
import type { Key } from '../project/project';
import { seconds, x, zoom } from './scale';
import * as studio from '../session/studio';

function Grip({ item }: { item: Key }) {
  const { fps } = studio.dancer;
  const length = (end: number) => Math.max(0, end - item.frame);
  const [dragged, pull] = useFrameDrag({ drop: (end) => studio.holdKey(item.id, length(end)) });
  const frames = dragged === null ? item.hold : length(dragged);
  const press = (event: KeyboardEvent) => {
    const way = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (!way) return;
    event.preventDefault();
    studio.holdKey(item.id, item.hold + way * limits.holdStepS * fps);
  };
  return (
    <>
      <i class="held" style={{ left: `${x(item.frame / fps)}px`, width: `${(frames / fps) * zoom.value}px` }} />
      <i class="grip hold" role="slider" tabIndex={0} aria-label={`How long key ${item.id} is held`}
        title={`Held for ${(frames / fps).toFixed(1)} s: pull it, with Alt beside the beats`}
        aria-valuemin={0} aria-valuemax={seconds()} aria-valuenow={item.hold / fps} aria-valuetext={`${(item.hold / fps).toFixed(1)} s`}
        style={{ left: `${x((item.frame + frames) / fps)}px` }} onPointerDown={pull} onKeyDown={press} />
    </>
  );
}

export function HoldGrip() {
  const item = studio.live.value ? undefined : studio.keyOf(studio.selectedKey.value);
  return item ? <Grip key={item.id} item={item} /> : null;
}
