// Filters out the answers that a resumed dance repeats, so that the caller receives each once.
import grpc from '@grpc/grpc-js';
import { ChoreoError } from './error.js';
import { placeOf } from './journal.js';

const perFrame = ['root_positions', 'rotations', 'contacts'];

export class DeliveryFilter {
  #nextFrames = new Map(); // by candidate, at the output rate; a dance has one candidate
  #firstFrame;
  #rejected = []; // places of rejected keys, as delivered
  #expected = []; // answers that the present server has yet to repeat
  #told = new Set(); // delivered warnings, and keys that were reached
  #lastBeat = -1;

  constructor(firstFrame) {
    this.#firstFrame = firstFrame;
  }

  /** The next frame to deliver, at the output rate. */
  nextFrame(candidate = 0) {
    return this.#nextFrames.get(candidate) ?? this.#firstFrame;
  }

  /**
   * Prepares for another server, which continues from `frame` (at the model's rate) and receives all requests again. `late`: the keys before that
   * frame, each listed as often as it was sent. The new server will report these as rejected or as reached.
   */
  restart(frame, late) {
    // Keys without a frame are not in `late`.
    this.#expected = [...late, ...this.#rejected.filter((place) => parseInt(place) >= frame || parseInt(place) < 0)];
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
        return this.#isNewRejection(placeOf(event.keyframe_rejected.id, event.frame));
      case 'keyframe_reached':
        this.#takeExpected(placeOf(event.keyframe_reached.id, event.frame));
        return this.#isNew(`reached ${placeOf(event.keyframe_reached.id, event.frame)}`);
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

  #isNewRejection(place) {
    if (this.#takeExpected(place)) return false;
    this.#rejected.push(place);
    return true;
  }

  #takeExpected(place) {
    const at = this.#expected.indexOf(place);
    if (at >= 0) this.#expected.splice(at, 1);
    return at >= 0;
  }
}
