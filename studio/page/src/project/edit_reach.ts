// The frames that an edit affects.
import { limits } from './limits';
import type { Key } from './project';

const end = ({ frame, hold }: Key) => frame + hold;

/// The frames before and after the part to dance anew when keys at `frames` change: the
/// neighbouring keys, if near, as in the program (client/cli/edit/edited_report.cpp). -1 and `count` mean
/// the beginning and the end.
export function reachOf(before: Key[], after: Key[], frames: number[], count: number, fps: number): [number, number] {
  const first = Math.min(...frames);
  const stay = after.filter(({ frame }) => !frames.includes(frame));
  const previous = stay.findLast(({ frame }) => frame < first);
  // A hold has ended or begun.
  const changed = [...before, ...after].filter((key) => frames.includes(key.frame) || (previous && key.frame === previous.frame));
  const last = Math.max(...frames, ...changed.map(end));
  const next = stay.find(({ frame }) => frame > Math.max(...frames));
  const [around, near] = [limits.editAroundS * fps, limits.nextKeyNearS * fps];
  const from = previous && first - end(previous) <= near ? end(previous) : Math.max(first - around, previous ? end(previous) : -1);
  const to = next && next.frame - last <= near ? next.frame : Math.min(last + around, next?.frame ?? count);
  return [from <= 0 && !previous ? -1 : Math.round(from), to >= count - 1 ? count : Math.round(to)];
}
