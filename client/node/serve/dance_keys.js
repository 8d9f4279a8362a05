// The keys of a page's dance. At the server a held key is several: itself, and steps that hold its pose. Pages know of one.
import { invalid } from '../src/error.js';
import { heldUpTo } from '../src/keys.js';

const ahead = 5; // seconds beyond what is settled up to which steps are sent: a long hold would be hundreds of keys
const wayFromHold = 0.5; // seconds before the next key at which a hold ends, as in `choreo dance`
const ofHold = /^(.+) held \d+$/s;

export class DanceKeys {
  #rate;
  #end; // frames
  #settled = 0; // frames
  #sendable; // frames: up to there steps are sent
  #keys = new Map(); // by id: what was asked for, the newest last: {frame, steps}; {steps: []} to take it back
  #sent = new Map(); // the steps that the server has, by id
  #owners = new Map(); // of all steps that were ever sent: the key's id, by their own
  #cut = new Map(); // by id of a held key: the id of the key that ends its hold, as was told

  /** `rate`: the model's frames per second. `end`: of the dance, in frames. */
  constructor(rate, end) {
    [this.#rate, this.#end, this.#sendable] = [rate, end, ahead * rate];
  }

  /** Notes a request that the back end itself sends: of readKeys(), say. */
  note({ keyframe, remove_keyframe: gone }) {
    if (gone) this.#keys.delete(gone.id);
    if (typeof keyframe?.id !== 'string') return;
    const owner = ofHold.exec(keyframe.id)?.[1];
    const held = this.#newest(owner);
    if (!held) return this.#ask(keyframe.id, { frame: this.#frame(keyframe), steps: [] });
    held.steps.push(keyframe);
    this.#sent.set(keyframe.id, keyframe);
    this.#owners.set(keyframe.id, owner);
  }

  /** The requests that set or move a key, given those of itself and of the steps of its hold. `warn(id, message)`: where a hold ends early. */
  set([{ keyframe }, ...steps], warn) {
    this.#requireOwn(keyframe.id);
    const taken = steps.find((step) => this.#newest(step.keyframe.id)?.frame !== undefined)?.keyframe.id;
    if (taken) throw invalid('hold', `needs the id "${taken}", which another key has`);
    this.#owners.delete(keyframe.id);
    this.#ask(keyframe.id, { frame: this.#frame(keyframe), steps: steps.map((step) => this.#inside(step.keyframe)) });
    const { gone, come } = this.#changes(warn);
    return [...gone, { keyframe }, ...come];
  }

  /** Whether a key is asked for where all is settled, or is itself settled where it stands. */
  isLate(keyframe) {
    return this.#frame(keyframe) < this.#settled || this.#newest(keyframe.id)?.frame < this.#settled;
  }

  /** The requests that take a key back or, once it is reached, the rest of its hold. `warn` as in set(). */
  remove(id, warn) {
    this.#requireOwn(id);
    const now = this.#newest(id);
    if (now?.isReached && now.steps.some((step) => this.#isOpen(step))) {
      now.steps = [];
      const { gone, come } = this.#changes(warn);
      return [...gone, ...come];
    }
    this.#ask(id, { steps: [] });
    const { gone, come } = this.#changes(warn); // a hold that it has cut goes on
    return [...gone, { remove_keyframe: { id } }, ...come];
  }

  /** The requests that are due before all up to `frame` is settled. */
  settle(frame) {
    this.#sendable = frame + ahead * this.#rate;
    const { gone, come } = this.#changes();
    this.#settled = frame;
    const isHeld = ({ steps }) => steps.some((step) => this.#isOpen(step));
    // Also the keys that end the holds that are left.
    const first = Math.min(frame, ...[...this.#keys.values()].flatMap((asked) => asked.filter(isHeld).map((one) => one.frame)));
    for (const [id, asked] of this.#keys) if (!asked.some((one) => one.frame >= first)) this.#forget(id);
    return [...gone, ...come];
  }

  /** Whose key it is: the id that its page knows. */
  owner(id) {
    return this.#owners.get(id) ?? id;
  }

  /** A key is reached. Returns whether it is the page's own, and not a step of its hold. */
  reach(id, frame) {
    if (this.#owners.has(id)) return false;
    const asked = this.#keys.get(id) ?? [];
    const at = asked.findLastIndex((one) => one.frame === frame);
    if (at < 0) return true;
    asked[at].isReached = true;
    asked.splice(0, at);
    return true;
  }

  /** A key, or its removal, is refused: what was asked for before it stands. Returns whether it is the page's own, and not a step of its hold. */
  refuse(id, frame, { isRemoval = false, isFrozen = false } = {}) {
    const owner = this.#owners.get(id);
    if (owner !== undefined) {
      for (const one of this.#keys.get(owner) ?? []) one.steps = one.steps.filter((step) => step.id !== id);
      this.#sent.delete(id);
      return false;
    }
    const asked = this.#keys.get(id) ?? [];
    // What is frozen stands first, and moves of it may be refused with its own frame.
    const stands = (index) => isFrozen && index === 0 && asked.length > 1;
    const at = asked.findLastIndex((one, index) => (isRemoval ? one.frame === undefined : one.frame === frame && !stands(index)));
    asked.splice(at < 0 ? asked.length - 1 : at, 1);
    if (asked.length === 0) this.#forget(id);
    return true;
  }

  /** A step of the hold of the key `id` is refused for good. Returns whether it is the first of that hold. */
  shorten(id) {
    const now = this.#newest(id);
    if (now?.frame === undefined || now.isShort) return false;
    return (now.isShort = true);
  }

  /** Throws for the id of a step. */
  #requireOwn(id) {
    const owner = ofHold.exec(id)?.[1];
    if (this.#newest(owner)?.steps.some((step) => step.id === id)) throw invalid('id', `"${id}" is of the hold of the key "${owner}"`);
  }

  #ask(id, one) {
    this.#keys.set(id, [...(this.#keys.get(id) ?? []), one]);
  }

  #forget(id) {
    this.#keys.delete(id);
    this.#cut.delete(id);
  }

  #newest(id) {
    return this.#keys.get(id)?.at(-1);
  }

  #frame({ frame, time }) {
    return Number(frame ?? Math.round(time * this.#rate));
  }

  #isOpen(step) {
    return this.#frame(step) >= this.#settled;
  }

  /** The last step of a hold, which may end with the dance, is in its last frame. */
  #inside(step) {
    return this.#frame(step) === this.#end ? { ...step, time: (this.#end - 1) / this.#rate } : step;
  }

  /** The requests that make the server's steps those of the holds, as far as they are near. */
  #changes(warn = () => {}) {
    const wanted = this.#wanted(warn);
    const [gone, come] = [[], []];
    for (const [id, step] of this.#sent) {
      if (wanted.get(id) === step) continue;
      this.#sent.delete(id);
      if (this.#isOpen(step)) gone.push({ remove_keyframe: { id } });
    }
    for (const [id, step] of wanted) {
      if (this.#sent.has(id)) continue;
      this.#sent.set(id, step);
      come.push({ keyframe: step });
    }
    return { gone, come };
  }

  #wanted(warn) {
    const keys = [...this.#keys].map(([id, asked]) => ({ id, ...asked.at(-1) }));
    const wanted = new Map();
    for (const { id, frame, steps } of keys.filter((key) => key.steps.length > 0)) {
      const next = keys.reduce((first, key) => (key.frame > frame && !(key.frame >= first?.frame) ? key : first), undefined);
      const planned = this.#frame(steps.at(-1));
      const most = next?.frame <= planned ? next.frame - wayFromHold * this.#rate : planned;
      if (most < planned && this.#cut.get(id) !== next.id) {
        const last = Math.max(frame, ...steps.map((step) => this.#frame(step)).filter((at) => at <= most));
        warn(id, heldUpTo(last / this.#rate, planned / this.#rate, next.id, next.frame / this.#rate));
      }
      this.#cut.set(id, most < planned ? next.id : undefined);
      for (const step of steps) {
        const at = this.#frame(step);
        const isFar = at > this.#sendable && this.#sent.get(step.id) !== step;
        if (at > most || !this.#isOpen(step) || isFar) continue;
        wanted.set(step.id, step);
        this.#owners.set(step.id, id);
      }
    }
    return wanted;
  }
}
