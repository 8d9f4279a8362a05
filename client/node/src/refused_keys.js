// Keys, and removals of keys, that the package's own check refuses, in dances that go on without bad keys. In place of each the server is told
// a blank: a key without a pose, at the moment that the key names. It rejects that in its turn, and again where the dance is resumed; the
// caller is told what was wrong here.
import { checked } from './check.js';

const nowhere = { frame: -1 };
const kinds = { keyframe: 'Keyframe', remove_keyframe: 'RemoveKeyframe' };

export class RefusedKeys {
  #bodiless = []; // of all keys without a pose, in order: {field, reason}, or undefined for one that the caller left so
  #answered = 0; // of them, by the present server

  /** Another server is told all again. */
  restart() {
    this.#answered = 0;
  }

  /** A request that is said as it is. */
  note({ keyframe }) {
    if (keyframe && hasMoment(keyframe) && !keyframe.pose) this.#bodiless.push(undefined);
  }

  /** What to say instead of a request for a key that `error` refuses; undefined where more than the key is wrong. */
  blank(request, error) {
    const kind = kindOf(request);
    if (!kind) return undefined;
    const { id, ...key } = request[kind] ?? {};
    try {
      checked('StreamDanceRequest', { ...request, [kind]: {} }, 'request');
    } catch {
      return undefined;
    }
    const [{ field, description: reason }] = error.violations;
    this.#bodiless.push({ field, reason });
    return { keyframe: { id: typeof id === 'string' ? id : '', ...momentOf(key) } };
  }

  /** What the caller is to hear of an event. */
  event(event) {
    const rejected = event.keyframe_rejected;
    const ofBodiless = rejected?.code === 'REJECTION_CODE_INVALID' && rejected.field === 'keyframe.pose';
    return ofBodiless ? { ...event, keyframe_rejected: { ...rejected, ...this.#bodiless[this.#answered++] } } : event;
  }
}

/** Throws for a request that is empty because its key is none. */
export function requireKey(request, copy) {
  const kind = kindOf(request);
  if (kind && Object.keys(copy).length === 0) checked(kinds[kind], request[kind], kind);
}

/** Whether a request is for a key or for its removal. */
function kindOf(request) {
  const named = Object.keys(kinds).filter((kind) => Object.hasOwn(Object(request), kind));
  return named.find((kind) => (request[kind] ?? undefined) !== undefined) ?? named[0];
}

/** Whether a key says when. */
export function hasMoment({ frame, time, interval_after_previous: interval }) {
  return (frame ?? time ?? interval) !== undefined;
}

/** When a key of any kind is to be, if it says so. */
function momentOf({ frame, time, interval_after_previous }) {
  try {
    const moment = checked('Keyframe', { frame, time, interval_after_previous }, 'keyframe');
    return hasMoment(moment) ? moment : nowhere;
  } catch {
    return nowhere;
  }
}
