// Poses that come at a dance's frame rate, shown when a clock says so: a page draws at its own rate, and music has its own time.
import { positive, requireObject, requireOptions } from './given.js';
import { slerp } from './linear.js';

const mix = (a, b, t) => ({
  turns: Array.from({ length: a.turns.length / 4 }, (_, i) => slerp(a.turns.slice(4 * i, 4 * i + 4), b.turns.slice(4 * i, 4 * i + 4), t)).flat(),
  places: a.places.map((one, i) => one + t * (b.places[i] - one)),
});

const smooth = (share) => share * share * (3 - 2 * share);

export class Player {
  #rate;
  #kept;
  #catchUp;
  #poses = new Map(); // by frame
  #last = -1; // frame
  #first = 0; // that is kept
  #hasForgotten = false;
  #over = false;
  #behind; // {pose, since}: starved until then, in that pose

  constructor(header, options = {}) {
    requireObject('header', header, "a dance's header");
    requireOptions(options, ['keep', 'catchUp']);
    const { keep = 2, catchUp = 0.3 } = options;
    this.#rate = positive('header.frame_rate', header.frame_rate);
    this.#kept = keep === Infinity ? keep : positive('keep', keep);
    this.#catchUp = positive('catchUp', catchUp);
  }

  add(poses) {
    for (const pose of poses) {
      if (pose.frame < this.#first) continue; // it is past
      this.#poses.set(pose.frame, pose);
      if (pose.frame > this.#last) this.#last = pose.frame;
    }
  }

  end() {
    this.#over = true;
  }

  ahead(seconds) {
    return Math.max(0, this.#last / this.#rate - seconds);
  }

  at(seconds) {
    if (!Number.isFinite(seconds)) throw new TypeError(`seconds: ${seconds} is not a finite number`);
    this.#forget(seconds);
    const found = this.#find(seconds * this.#rate);
    const pose = found.pose && this.#withoutJump(found, seconds);
    return { state: found.state, pose, ahead: this.ahead(seconds) };
  }

  /** The pose of a time in frames, and whether it is the right one. */
  #find(time) {
    const before = Math.floor(time);
    const [from, to] = [this.#poses.get(before), this.#poses.get(before + 1)];
    if (from && (to || time === before)) return { state: 'playing', pose: time === before ? from : mix(from, to, time - before) };
    if (this.#poses.size === 0) return { state: 'waiting' };
    const earliest = this.#earliest();
    if (time < earliest) return { state: this.#hasForgotten ? 'past' : 'waiting', pose: this.#poses.get(earliest) };
    if (this.#over && time >= this.#last) return { state: 'over', pose: this.#poses.get(this.#last) };
    return { state: 'starved', pose: this.#latest(before) };
  }

  #earliest() {
    let earliest = Infinity; // as many as are kept would be too many arguments
    for (const frame of this.#poses.keys()) earliest = Math.min(earliest, frame);
    return earliest;
  }

  /** The last pose until a frame. */
  #latest(frame) {
    for (let at = Math.min(frame, this.#last); at >= this.#first; --at) if (this.#poses.has(at)) return this.#poses.get(at);
    return this.#poses.get(this.#earliest());
  }

  /** A dancer who had to wait comes back on the way, instead of jumping. */
  #withoutJump({ state, pose }, seconds) {
    if (state === 'starved') {
      this.#behind = { pose, since: seconds };
      return pose;
    }
    if (!this.#behind) return pose;
    const share = (seconds - this.#behind.since) / this.#catchUp;
    if (share < 0 || share >= 1) {
      this.#behind = undefined;
      return pose;
    }
    return mix(this.#behind.pose, pose, smooth(share));
  }

  #forget(seconds) {
    const first = Math.floor(Math.min(seconds * this.#rate, this.#last) - this.#kept * this.#rate);
    for (; this.#first < first; ++this.#first) this.#hasForgotten = this.#poses.delete(this.#first) || this.#hasForgotten;
  }
}
