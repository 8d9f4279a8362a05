// What has been said in a dance, in order, for another server to hear it again: a dance goes on from the last continuation and the same
// messages. Only music that it no longer needs is forgotten.
import { checked, requireSendable } from './check.js';
import { invalid } from './error.js';
import { hasMoment, RefusedKeys, requireKey } from './refused_keys.js';

export class Journal {
  #source;
  #requests = []; // null: forgotten
  #more; // while the source is asked
  #over = false;
  #musicEnd; // of what was forgotten
  #nextPiece; // of music: where it starts
  refusedKeys = new RefusedKeys();
  /** What the source threw. */
  failure;

  /** `requests`: an iterable, which may be asynchronous. It is asked for the next one when the server takes it. */
  constructor(requests) {
    const begin = requests?.[Symbol.asyncIterator] ?? requests?.[Symbol.iterator];
    const isOne = typeof requests === 'object' && requests !== null && !begin;
    if (isOne) throw invalid('requests', 'is one object: put it in a list, [{ config }, ...]');
    if (typeof requests !== 'object' || !begin) throw invalid('requests', `${typeof requests} is no iterable of messages`);
    this.#source = begin.call(requests);
  }

  /** Request number `index`: undefined where the source ended before it, null if it is forgotten. Throws what the source threw. */
  async at(index) {
    while (index >= this.#requests.length && !this.#over) {
      this.#more ??= this.#ask();
      await this.#more;
    }
    if (this.failure) throw this.failure;
    return this.#requests[index];
  }

  async #ask() {
    try {
      const { done, value } = await this.#source.next();
      if (done) this.#over = true;
      else this.#requests.push(this.#checked(await value));
    } catch (error) {
      this.#over = true;
      this.failure = error;
      throw error;
    } finally {
      this.#more = undefined;
    }
  }

  #checked(request) {
    try {
      const fine = checked('StreamDanceRequest', request, `requests[${this.#requests.length}]`, this.#format()?.encoding);
      requireKey(request, fine);
      requireSendable(fine.audio, 'send it in pieces');
      this.refusedKeys.note(fine);
      if (fine.audio && this.#format()) this.#numberPiece(fine.audio);
      return fine;
    } catch (error) {
      const goesOn = this.#requests[0]?.config?.reject_invalid_keys;
      const blank = goesOn ? this.refusedKeys.blank(request, error) : undefined;
      if (blank) return blank;
      this.close(); // the source knows nothing of it
      const keyframeId = request?.keyframe?.id;
      if (typeof keyframeId === 'string') error.violations.forEach((violation) => Object.assign(violation, { keyframeId }));
      throw error.locate(() => ({ request: this.#requests.length }), (field) => ({ field }));
    }
  }

  /** A piece of music starts where the one before has ended, unless the caller says where. A file's are counted in bytes. */
  #numberPiece(audio) {
    audio.first_sample ??= this.#nextPiece ?? this.#format().first_sample ?? 0;
    this.#nextPiece = Number(audio.first_sample) + Math.floor((audio.data?.length ?? 0) / (this.bytesPerSample() || 1));
  }

  /** Nobody will ask any more. */
  close() {
    if (this.#over) return;
    this.#over = true;
    // A source that is at work ends when it is done with that.
    Promise.resolve(this.#source.return?.()).catch(() => {});
  }

  /** The latest request that may have a field: of a key, the one of that id, if it is known. Its number, if no other one may have it. */
  find({ field, keyframeId }) {
    const kind = field.split(/[.[]/)[0];
    const ofKey = ({ keyframe }) => keyframeId === undefined || keyframe?.id === keyframeId;
    const mayHave = (request) => request?.[kind] && (kind !== 'keyframe' || ofKey(request));
    const last = this.#requests.findLastIndex(mayHave);
    const isAlone = last >= 0 && !this.#requests.some((request, at) => at !== last && (request === null ? kind === 'audio' : mayHave(request)));
    return { message: this.#requests[last], request: isAlone ? last : undefined };
  }

  /** Another server would need the music from this sample on alone. The present one has been told what stands before `sent`. */
  forgetMusicBefore(sample, sent) {
    const bytes = this.bytesPerSample();
    if (bytes === 0) return;
    for (let at = 0; at < sent && at < this.#requests.length; ++at) {
      const audio = this.#requests[at]?.audio;
      if (!audio) continue;
      const end = Number(audio.first_sample ?? 0) + (audio.data?.length ?? 0) / bytes;
      if (end > sample) return;
      this.#musicEnd = end;
      this.#requests[at] = null;
    }
  }

  /** Where the music starts that is still here. */
  firstSample() {
    const first = this.#requests.find((request) => request?.audio);
    return first ? (first.audio.first_sample ?? 0) : (this.#musicEnd ?? this.#format()?.first_sample ?? 0);
  }

  /** Of all channels together; 0 for a music file, which is decoded as a whole, and without music. */
  bytesPerSample() {
    const format = this.#format();
    const bytes = { AUDIO_ENCODING_PCM_F32LE: 4, 1: 4, AUDIO_ENCODING_PCM_S16LE: 2, 2: 2 }[format?.encoding] ?? 0;
    return bytes * (format?.channels ?? 0);
  }

  #format() {
    return this.#requests[0]?.config?.audio_format;
  }

  /** What was said of keys that stood before `frame` then: as `placeOf` writes them, in order. Models run at `rate`. */
  keysBefore(frame, rate) {
    const found = [];
    const frames = new Map();
    let previous = 0;
    for (const request of this.#requests) {
      const id = request?.keyframe?.id ?? request?.remove_keyframe?.id;
      if (id === undefined) continue;
      if (request.keyframe) {
        const at = hasMoment(request.keyframe) ? frameOf(request.keyframe, previous, rate) : -1;
        if (at < 0) continue; // it is nowhere
        if (!request.keyframe.pose) {
          // It moves no key that is there.
          if (at < frame) found.push(placeOf(id, at));
          if (!frames.has(id)) frames.set(id, at);
          continue;
        }
        previous = at;
        frames.set(id, at);
      }
      if (frames.get(id) < frame) found.push(placeOf(id, frames.get(id)));
    }
    return found;
  }
}

function frameOf({ frame, time, interval_after_previous: interval }, previous, rate) {
  if (frame !== undefined) return Number(frame);
  return time !== undefined ? Math.round(time * rate) : previous + Number(interval ?? 0);
}

/** A key by its id, and its frame at the model's rate. */
export function placeOf(id, frame) {
  return `${frame} ${id}`;
}
