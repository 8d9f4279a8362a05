// How hard the selected key is hit: danced through, or held after an arrival from gentle to late
// and fast.
import { limits } from '../project/limits';
import type { Key } from '../project/project';
import * as studio from '../session/studio';

export function HitTool({ item }: { item: Key }) {
  const set = (hit: number | null) => studio.hitKey(item.id, hit);
  return (
    <>
      <label class="check" title="Otherwise she dances through it">
        <input type="checkbox" checked={item.hit !== null} onChange={(event) => set(event.currentTarget.checked ? limits.usualHit : null)} />
        Come to rest in it
      </label>
      {item.hit !== null && (
        <label class="slider" title="0 settles into it early and gently, 1 takes her own time, 3 comes late and fast, and stops dead">
          <span>hit</span>
          <input type="range" aria-label="How hard it is hit" min={0} max={limits.hit} step="0.1" value={item.hit}
            onChange={(event) => set(Number(event.currentTarget.value))} />
          <output>{item.hit.toFixed(1)}</output>
        </label>
      )}
    </>
  );
}
