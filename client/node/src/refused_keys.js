// Keys that the package's own check refuses, in dances that go on without bad keys. In place of each the server is told a blank: a key with
// neither a moment nor a pose. It rejects that in its turn, and again where the dance is resumed; the caller is told what was wrong here.
import { checked } from './check.js';

export class RefusedKeys {
  #unplaced = []; // of all keys without a moment, in order: {field, reason}, or undefined for one that the caller left so
  #answered = 0; // of them, by the present server

  /** Another server is told all again. */
  restart() {
    this.#answered = 0;
  }

  /** A request that is said as it is. */
  note({ keyframe }) {
    if (keyframe && !hasMoment(keyframe)) this.#unplaced.push(undefined);
  }

  /** What to say instead of a request for a key that `error` refuses; undefined where more than the key is wrong. */
  blank(request, error) {
    const key = request?.keyframe;
    if (key === undefined || key === null) return undefined;
    const keyframe = { id: typeof key.id === 'string' ? key.id : '' };
    try {
      const blank = checked('StreamDanceRequest', { ...request, keyframe }, 'request');
      const [{ field, description: reason }] = error.violations;
      this.#unplaced.push({ field, reason });
      return blank;
    } catch {
      return undefined;
    }
  }

  /** What the caller is to hear of an event. */
  event(event) {
    const rejected = event.keyframe_rejected;
    const ofUnplaced = rejected?.code === 'REJECTION_CODE_INVALID' && rejected.field === 'keyframe' && Number(event.frame) < 0;
    return ofUnplaced ? { ...event, keyframe_rejected: { ...rejected, ...this.#unplaced[this.#answered++] } } : event;
  }
}

/** Whether a key says when. */
export function hasMoment({ frame, time, interval_after_previous: interval }) {
  return (frame ?? time ?? interval) !== undefined;
}
