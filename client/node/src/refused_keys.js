// Handles keys, and removals of keys, that the package's own check refuses, in dances that continue without invalid keys. Instead of each, the
// server is sent a blank: a key without a pose at the same moment. The server rejects the blank in order, also after a resumption; the caller
// receives the reason that the check found.
import { checked } from './check.js';
import { wellFormed } from './words.js';

const nowhere = { frame: -1 };
const kinds = { keyframe: 'Keyframe', remove_keyframe: 'RemoveKeyframe' };

export class RefusedKeys {
  #bodiless = []; // for all keys without a pose, in order: {field, reason}, or undefined for a key that the caller sent so
  #answered = 0; // how many of these the present server has answered

  /** Prepares for another server, which receives all requests again. */
  restart() {
    this.#answered = 0;
  }

  /** Notes a request that is sent unchanged. */
  note({ keyframe }) {
    if (keyframe && hasMoment(keyframe) && !keyframe.pose) this.#bodiless.push(undefined);
  }

  /** Returns the blank to send instead of a key's request that `error` refuses; undefined if more than the key is invalid. */
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
    return { keyframe: { id: typeof id === 'string' ? wellFormed(id) : '', ...momentOf(key) } };
  }

  /** Translates an event for the caller. */
  event(event) {
    const rejected = event.keyframe_rejected;
    const ofBodiless = rejected?.code === 'REJECTION_CODE_INVALID' && rejected.field === 'keyframe.pose';
    return ofBodiless ? { ...event, keyframe_rejected: { ...rejected, ...this.#bodiless[this.#answered++] } } : event;
  }
}

/** Throws for a request whose copy is empty because its key is null or undefined. */
export function requireKey(request, copy) {
  const kind = kindOf(request);
  if (kind && Object.keys(copy).length === 0) checked(kinds[kind], request[kind], kind);
}

/** Returns which field of a request has a key or its removal. */
function kindOf(request) {
  const named = Object.keys(kinds).filter((kind) => Object.hasOwn(Object(request), kind));
  return named.find((kind) => (request[kind] ?? undefined) !== undefined) ?? named[0];
}

/** Whether a key has a moment. */
function hasMoment({ frame, time, interval_after_previous: interval }) {
  return (frame ?? time ?? interval) !== undefined;
}

/** Returns the moment of a key, valid or not, if it has one. */
function momentOf({ frame, time, interval_after_previous }) {
  try {
    const moment = checked('Keyframe', { frame, time, interval_after_previous }, 'keyframe');
    return hasMoment(moment) ? moment : nowhere;
  } catch {
    return nowhere;
  }
}
