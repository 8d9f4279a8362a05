// Filters out the answers that a resumed dance repeats, so that the caller receives each once.
import grpc from '@grpc/grpc-js';
import { ChoreoError } from './error.js';
import { firstOutputFrame } from './header.js';

const perFrame = ['root_positions', 'rotations', 'contacts'];

export class DeliveryFilter {
  #nextFrames = new Map(); // by candidate, at the output rate; a dance has one candidate
  #header;
  #rejections = 0; // delivered
  #repeats = 0; // rejections that the present server has yet to repeat
  #told = new Set(); // delivered warnings, and keys that were reached
  #lastBeat = -1;

  /** `header`: the first server's. */
  constructor(header) {
    this.#header = header;
  }

  /** The next frame to deliver, at the output rate. */
  nextFrame(candidate = 0) {
    return this.#nextFrames.get(candidate) ?? firstOutputFrame(this.#header);
  }

  /** Prepares for another server, which receives all requests again. */
  restart() {
    this.#repeats = this.#rejections;
  }

  /** Removes frames that were delivered already; undefined if none is left. */
  frames(frames) {
    const due = this.nextFrame(frames.candidate);
    const first = Number(frames.first_frame);
    if (first > due) {
      const details = `the server left out frames: ${first} came where ${due} was due`;
      throw new ChoreoError({ code: grpc.status.DATA_LOSS, details });
    }
    if (first + frames.count <= due) return undefined;
    this.#nextFrames.set(frames.candidate, first + frames.count);
    if (first === due) return frames;
    const rest = { ...frames, first_frame: String(due), count: first + frames.count - due };
    for (const field of perFrame) {
      rest[field] = frames[field].slice((frames[field].length / frames.count) * (due - first));
    }
    return rest;
  }

  /** Whether an event is new. */
  event(event) {
    switch (event.event) {
      case 'keyframe_rejected':
        return this.#isNewRejection(event);
      case 'keyframe_reached':
        return this.#isNew(`reached ${event.frame} ${event.keyframe_reached.id}`);
      case 'warning':
        return this.#isNew(`warning ${event.frame} ${event.warning.message}`);
      case 'beat':
        if (event.time <= this.#lastBeat) return false;
        this.#lastBeat = event.time;
    }
    return true;
  }

  #isNew(what) {
    if (this.#told.has(what)) return false;
    this.#told.add(what);
    return true;
  }

  /**
   * Rejections depend on the order of the requests alone, so every server sends the same ones, in this order. A resumed server also
   * rejects, as already danced, keys that the first server accepted; those are left out.
   */
  #isNewRejection({ frame, keyframe_rejected: { code } }) {
    if (code === 'REJECTION_CODE_ALREADY_DANCED' && Number(frame) >= Number(this.#header.first_frame)) return false;
    if (this.#repeats > 0) {
      --this.#repeats;
      return false;
    }
    ++this.#rejections;
    return true;
  }
}
