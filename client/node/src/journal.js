// Stores all requests of a dance, in order, to repeat them to another server: a dance resumes from the last continuation and the same messages.
// Discards only music that is no longer needed.
import { types } from 'node:util';
import { checked, requireKind, requireSendable } from './check.js';
import { invalid } from './error.js';
import { RefusedKeys, requireKey } from './refused_keys.js';
import { quoted } from './words.js';

/** Kinds of requests of which a dance takes one. */
const once = ['config', 'end_of_audio', 'keyframes_complete'];

export class Journal {
  #source;
  #requests = []; // null: discarded
  #more; // a promise, while the next request is awaited
  #over = false;
  #musicEnd; // end of the discarded music
  #nextPiece; // start of the next piece of music
  refusedKeys = new RefusedKeys();
  /** The error that the source threw. */
  failure;

  /** `requests`: an iterable, which may be asynchronous. The next request is taken from it when the server is ready to receive one. */
  constructor(requests) {
    const begin = requests?.[Symbol.asyncIterator] ?? requests?.[Symbol.iterator];
    const isOne = typeof requests === 'object' && requests !== null && !begin;
    if (types.isPromise(requests)) throw invalid('requests', 'is a Promise: await it first');
    if (isOne) throw invalid('requests', 'is one object: put it in a list, [{ config }, ...]');
    if (typeof requests !== 'object' || !begin) throw invalid('requests', `${quoted(requests)} is not an iterable of messages`);
    this.#source = begin.call(requests);
  }

  /** Returns request number `index`: undefined if the source ended before it, null if it is discarded. Throws what the source threw. */
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
      requireKind(fine, this.#requests.length);
      requireSendable(fine.audio, 'send it in pieces');
      this.refusedKeys.note(fine);
      if (fine.audio && this.#format()) this.#numberPiece(fine.audio);
      return fine;
    } catch (error) {
      const goesOn = this.#requests[0]?.config?.reject_invalid_keys;
      const blank = goesOn ? this.refusedKeys.blank(request, error) : undefined;
      if (blank) return blank;
      this.close(); // the source did not fail itself
      const keyframeId = request?.keyframe?.id;
      if (typeof keyframeId === 'string') error.violations.forEach((violation) => Object.assign(violation, { keyframeId }));
      throw error.locate(() => ({ request: this.#requests.length }), (field) => ({ field }));
    }
  }

  /** Numbers a piece of music: it starts at the end of the previous one unless the caller gives its start. For a file, counts bytes. */
  #numberPiece(audio) {
    audio.first_sample ??= this.#nextPiece ?? this.#format().first_sample ?? 0;
    this.#nextPiece = Number(audio.first_sample) + Math.floor((audio.data?.length ?? 0) / (this.bytesPerSample() || 1));
  }

  /** Ends the source: no more requests are needed. */
  close() {
    if (this.#over) return;
    this.#over = true;
    // A source that is producing a request ends after it.
    Promise.resolve(this.#source.return?.()).catch(() => {});
  }

  /**
   * Finds the latest request that may contain a field; for a key, the request with its id, if it is known. Includes the request's index if no
   * other one may contain the field, if no other one has the value with which the error's description begins, or if it is the second of a kind that
   * may come once.
   */
  find({ field, keyframeId, description = '' }) {
    const [kind, ...members] = field.split(/[.[\]]+/).filter(Boolean);
    const ofKey = ({ keyframe }) => keyframeId === undefined || keyframe?.id === keyframeId;
    const mayHave = (request) => request?.[kind] && (kind !== 'keyframe' || ofKey(request));
    const found = this.#requests.flatMap((request, at) => (mayHave(request) ? at : []));
    const value = (at) => members.reduce((one, member) => one?.[member], this.#requests[at][kind]);
    const said = found.filter((at) => members.length > 0 && description.startsWith(`${value(at)} `));
    const isLost = kind === 'audio' && this.#requests.includes(null); // one that may have it is discarded
    const request = said.length === 1 ? said[0] : found.length === 1 && !isLost ? found[0] : once.includes(field) ? found[1] : undefined;
    return { message: this.#requests[request ?? found.at(-1)], request };
  }

  /** Discards music before this sample, which another server would not need. The present server has been sent the first `sent` requests. */
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

  /** The first sample of music still stored. */
  firstSample() {
    const first = this.#requests.find((request) => request?.audio);
    return first ? (first.audio.first_sample ?? 0) : (this.#musicEnd ?? this.#format()?.first_sample ?? 0);
  }

  /** Bytes per sample, of all channels together; 0 without music, and for a music file, which is decoded as a whole. */
  bytesPerSample() {
    const format = this.#format();
    const bytes = { AUDIO_ENCODING_PCM_F32LE: 4, 1: 4, AUDIO_ENCODING_PCM_S16LE: 2, 2: 2 }[format?.encoding] ?? 0;
    return bytes * (format?.channels ?? 0);
  }

  #format() {
    return this.#requests[0]?.config?.audio_format;
  }
}
