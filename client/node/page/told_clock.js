// Tells the back end where the page plays, so that it settles no more than the page soon shows.

const drift = 0.1; // seconds by which the back end may be wrong
const apart = 250; // milliseconds from one message to the next, at least
const look = 1000; // milliseconds: hidden pages draw no pictures, but their music plays or is paused

export class ToldClock {
  #send;
  #audio;
  #told; // {at, since, paused}: the last message, if it has arrived
  #isBusy = false;
  #timer;

  /** `send({time, paused})` resolves once the back end knows. */
  constructor(send) {
    this.#send = send;
  }

  /** Tells where this element is, if the back end does not know. Looks again until `stop()`. */
  follow(audio) {
    this.#audio = audio;
    this.#timer ??= setInterval(() => this.#tell(), look);
    this.#timer.unref?.(); // Node.js
    this.#tell();
  }

  stop() {
    clearInterval(this.#timer);
    this.#audio = undefined;
  }

  async #tell() {
    if (!this.#audio || this.#isBusy) return;
    const { currentTime: time, ended } = this.#audio;
    const paused = this.#audio.paused && !ended; // a dance may be longer than its song
    if (this.#knows(time, paused, ended)) return;
    this.#isBusy = true;
    const since = performance.now();
    this.#told = await this.#send({ time, paused }).then(() => ({ at: time, since, paused }), () => undefined); // if lost, it is told again
    setTimeout(() => (this.#isBusy = false), apart).unref?.();
  }

  #knows(time, paused, ended) {
    if (this.#told?.paused !== paused) return false;
    const { at, since } = this.#told;
    return ended || Math.abs(time - at - (paused ? 0 : (performance.now() - since) / 1000)) < drift;
  }
}
