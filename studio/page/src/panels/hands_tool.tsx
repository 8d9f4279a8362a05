// The hand pose at the selected key, for characters with fingers.
import { handPoses } from '../project/project';
import type { Key } from '../project/project';
import * as studio from '../session/studio';

export function HandsTool({ item }: { item: Key }) {
  return (
    <label class="row" title="Characters with fingers show it: choreo convert --character --report">
      <span>hands</span>
      <select aria-label="What hands do" value={item.hands} onChange={(event) => studio.handKey(item.id, Number(event.currentTarget.value))}>
        {['as before', ...handPoses].map((pose, i) => <option key={pose} value={i}>{pose}</option>)}
      </select>
    </label>
  );
}
