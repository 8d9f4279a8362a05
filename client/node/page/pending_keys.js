// The keys that a page has asked for and that are neither reached nor refused.

const apart = 1; // seconds between keys that get their time from here: a dancer needs half a second from one to the next

export class PendingKeys {
  #times = new Map(); // by id: [from, to], seconds
  #count = 0;

  newId() {
    do ++this.#count;
    while (this.#times.has(`key ${this.#count}`));
    return `key ${this.#count}`;
  }

  add({ id, time, hold = 0 }) {
    this.#times.set(id, [time, time + (Number(hold) || 0)]);
  }

  delete(id) {
    this.#times.delete(id);
  }

  /** The earliest time from `time` on that is near none of them. */
  after(time) {
    for (const [from, to] of [...this.#times.values()].sort(([a], [b]) => a - b)) if (time > from - apart) time = Math.max(time, to + apart);
    return time;
  }
}
