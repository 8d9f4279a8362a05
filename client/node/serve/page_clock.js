// Where a page plays, as far as its back end knows.
import { invalid } from '../src/error.js';
import { isObject, number } from '../src/fields.js';
import { quoted } from '../src/words.js';

/** Stands where the dance begins until the page has a frame. Then runs, `speed` times as fast as time, until the page tells where it plays; then as fast as time. */
export class PageClock {
  #first = 0; // seconds: where the dance begins
  #at = 0; // seconds, at `since`
  #since; // milliseconds; undefined while it stands
  #speed;
  #isTold = false;

  constructor(speed) {
    this.#speed = speed;
  }

  get time() {
    const passed = this.#since === undefined ? 0 : (this.#speed * (performance.now() - this.#since)) / 1000;
    return Math.max(this.#first, this.#at + passed);
  }

  /** The dance begins at `first` seconds. A page that plays from earlier on waits for nothing before. */
  begin(first) {
    this.#first = first;
    if (!this.#isTold) this.#at = first;
  }

  /** The page has its first frame. A page that has told its time before knows better. */
  start() {
    if (!this.#isTold) this.#since ??= performance.now();
  }

  /** What a page tells, {time, paused}. */
  tell(body) {
    if (!isObject(body)) throw invalid('clock', `${quoted(body)} is not {time, paused}`);
    const { time, paused } = body;
    if (number(time, 'time') < 0) throw invalid('time', `${time} s is before 0`);
    if (typeof paused !== 'boolean') throw invalid('paused', `${quoted(paused)} is not a boolean`);
    this.#at = time;
    this.#since = paused ? undefined : performance.now();
    this.#speed = 1;
    this.#isTold = true;
  }
}
