// The keys that a page has asked for and that are neither danced nor refused.

const apart = 1; // seconds between keys that get their time from here: a dancer needs half a second from one to the next
const near = 0.05; // seconds: a key is reached in the nearest frame

export class PendingKeys {
  #asked = new Map(); // by id: what was asked for, the newest last: {from, to}, seconds; {} to take it back
  #count = 0;

  newId() {
    do ++this.#count;
    while (this.#asked.has(`key ${this.#count}`));
    return `key ${this.#count}`;
  }

  /** A key is set or moved. Returns a function that takes this back: what was asked for before it stands. */
  add({ id, time, hold }) {
    const [from, seconds] = [time, hold].map((value) => (Number.isFinite(value) ? value : 0));
    return this.#ask(id, { from, to: from + seconds });
  }

  /** A key is taken back. Returns a function that takes this back. */
  remove(id) {
    return this.#ask(id, {});
  }

  #ask(id, span) {
    this.#keep(id, [...this.#of(id), span]);
    return () => this.#keep(id, this.#of(id).filter((other) => other !== span));
  }

  /** What was asked for at `time`, null for a removal, or else the newest, is not done: what was asked for before it stands. */
  refuse(id, time) {
    const asked = this.#of(id);
    const at = asked.findLastIndex(({ from }) => (time === null ? from === undefined : Math.abs(from - time) < near));
    const refused = at < 0 ? asked.length - 1 : at;
    this.#keep(id, asked.filter((_, index) => index !== refused));
  }

  /** A key is reached, from where it may be held. */
  reach(id, time) {
    const asked = this.#of(id);
    const at = Math.max(0, asked.findLastIndex(({ from }) => Math.abs(from - time) < near));
    const [reached, ...later] = asked.slice(at);
    this.#keep(id, reached?.to > reached?.from ? [reached, ...later] : later);
  }

  #of = (id) => this.#asked.get(id) ?? [];

  #keep(id, asked) {
    if (asked.length > 0) this.#asked.set(id, asked);
    else this.#asked.delete(id);
  }

  /** The earliest time from `time` on that is near none of them, nor near the pose that one is held in. */
  after(time) {
    for (const [id, asked] of this.#asked) if (asked.every(({ to = 0 }) => to + apart <= time)) this.#asked.delete(id); // past
    const spans = [...this.#asked.values()].map((asked) => asked.at(-1)).filter(({ to }) => to !== undefined);
    for (const { from, to } of spans.sort((a, b) => a.from - b.from)) if (time > from - apart) time = Math.max(time, to + apart);
    return time;
  }
}
