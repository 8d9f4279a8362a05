import type { Event, GenerateTransitionResponse, StreamDanceResponse } from 'choreo-client';
function tell(event: Event): string {
  switch (event.event) {
    case 'keyframe_reached':
      return event.keyframe_reached.id + event.frame;
    case 'beat':
      return event.beat.source;
    case 'warning':
      // @ts-expect-error: no beat
      event.beat.source;
      return event.warning.message;
  }
  if (event.keyframe_rejected) return event.event satisfies 'keyframe_rejected';
  return event.event satisfies undefined ?? 'of a newer server';
}
function hear(answer: StreamDanceResponse): string | number {
  // @ts-expect-error: nobody has asked
  answer.frames.count;
  if (answer.response === 'frames') return answer.frames.count;
  if (answer.response === 'event') return tell(answer.event);
  return answer.summary ? (answer.summary.report?.frames ?? 0) : answer.response satisfies 'header' | 'continuation' | undefined ?? '';
}
function compare(answer: GenerateTransitionResponse): number {
  return answer.response === 'summary' ? answer.summary.candidates.length : 0;
}
