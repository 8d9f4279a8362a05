// How hard the selected key is hit: a grip before it on the timeline, pulled away from the key or
// moved by arrow keys. A press lets her come to rest in the key, or dance through it. The first
// frame has nothing before it.
import { useFrameDrag } from './drag';
import { limits } from '../project/limits';
import type { Key } from '../project/project';
import { x, zoom } from './scale';
import * as studio from '../session/studio';

const tenths = 10; // a frame pulled is a tenth, as a step of the slider in the panel

function Grip({ item }: { item: Key }) {
  const { fps } = studio.dancer;
  const between = (hit: number) => Math.min(Math.max(Math.round(hit * tenths) / tenths, 0), limits.hit);
  const set = (hit: number | null) => studio.hitKey(item.id, hit);
  const framesOf = (hit: number | null) => (hit ?? 0) * tenths;
  const hitAt = (frame: number) => between((item.frame - frame) / tenths);
  const turn = () => set(item.hit === null ? limits.usualHit : null);
  const [dragged, pull] = useFrameDrag({ from: item.frame - framesOf(item.hit), isFree: true, drop: (frame) => set(hitAt(frame)), press: turn });
  const hit = dragged === null ? item.hit : hitAt(dragged);
  const text = hit === null ? 'danced through' : `hit ${hit.toFixed(1)}`;
  const press = (event: KeyboardEvent) => {
    const way = { ArrowLeft: 1, ArrowUp: 1, ArrowRight: -1, ArrowDown: -1 }[event.key];
    if (way) set(between((item.hit ?? 0) + way / tenths));
    else if (event.key === 'Enter') turn();
    else return;
    event.preventDefault();
  };
  const from = x((item.frame - framesOf(hit)) / fps);
  return (
    <>
      <i class="hitting" style={{ left: `${from}px`, width: `calc(${(framesOf(hit) / fps) * zoom.value}px + var(--beside))` }} />
      <i class={hit === null ? 'grip hit through' : 'grip hit'} role="slider" tabIndex={0} aria-label={`How hard key ${item.id} is hit`}
        title={`${text}: pull it away from the key to hit it harder, press it to ${item.hit === null ? 'come to rest in it' : 'dance through it'}`}
        aria-valuemin={0} aria-valuemax={limits.hit} aria-valuenow={hit ?? 0} aria-valuetext={text}
        style={{ left: `${from}px` }} onPointerDown={pull} onKeyDown={press}>{dragged !== null && <b>{text}</b>}</i>
    </>
  );
}

export function HitGrip() {
  const item = studio.live.value ? undefined : studio.keyOf(studio.selectedKey.value);
  return item && item.frame > 0 ? <Grip key={item.id} item={item} /> : null;
}
