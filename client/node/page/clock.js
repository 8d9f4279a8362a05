// Replaces an <audio> element for dances without music.

export class Clock {
  paused = true;
  ended = false;
  #at = 0; // seconds, when it was started or stopped last
  #since = 0; // milliseconds: when it was started

  get currentTime() {
    return this.paused ? this.#at : this.#at + (performance.now() - this.#since) / 1000;
  }

  set currentTime(seconds) {
    this.#at = seconds;
    this.#since = performance.now();
  }

  play() {
    this.#since = performance.now();
    this.paused = false;
  }

  pause() {
    this.#at = this.currentTime;
    this.paused = true;
  }
}
