// The button that keeps a take, with the colour that its dancer wears.
import { shirtOf } from '../scene/palette';
import * as studio from '../session/studio';

/// For the present dance (0) or another take (from 1).
export function KeepTake({ nth }: { nth: number }) {
  const keep = () => (nth === 0 ? (studio.takes.value = []) : studio.keepTake(studio.takes.value[nth - 1]));
  return <button class="take" style={{ '--shirt': `var(--${shirtOf(nth)})` }} onClick={keep}>Keep {'ABCDEFG'[nth]}</button>;
}
