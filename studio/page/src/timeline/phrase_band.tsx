// The selected phrase on the timeline; its ends are dragged or moved by arrow keys.
import { drag } from './drag';
import { content, frameAt, stepped, timeUnder, x } from './scale';
import * as studio from '../session/studio';

/// Drags one end to the pointer; the other stays.
const pull = (event: PointerEvent, stays: number) =>
  drag(event, ({ clientX, altKey }) => studio.choosePhrase(stays, frameAt(timeUnder(clientX), altKey)));

export function PhraseBand() {
  const phrase = studio.selection.value;
  if (!phrase || !content.value) return null;
  const { fps } = studio.dancer;
  const grip = (name: string, end: 0 | 1) => {
    const [frame, stays] = [phrase[end], phrase[1 - end]];
    const press = (event: KeyboardEvent) => {
      const way = { ArrowLeft: -1, ArrowRight: 1 }[event.key] as 1 | -1 | undefined;
      if (!way) return;
      event.preventDefault();
      const to = stepped(frame, way, event.shiftKey);
      if (Math.sign(to - stays) === Math.sign(frame - stays)) studio.choosePhrase(stays, to);
    };
    return (
      <i class={`grip ${name}`} role="slider" tabIndex={0} aria-label={`The phrase ${name}`} title={`The phrase ${name} here: drag it, with Alt beside the beats`}
        aria-valuemin={0} aria-valuemax={studio.total.value / fps} aria-valuenow={frame / fps} aria-valuetext={`${(frame / fps).toFixed(2)} s`}
        style={{ left: `${x(frame / fps)}px` }} onPointerDown={(event) => pull(event, stays)} onKeyDown={press} />
    );
  };
  const [from, to] = phrase.map((frame) => x(frame / fps));
  return (
    <>
      <i class="phrase" style={{ left: `${from}px`, width: `${to - from}px` }} />
      {grip('begins', 0)}
      {grip('ends', 1)}
    </>
  );
}
