// A dance for a page, paced by the page's clock. Keeps its server-sent events for pages that reconnect.
import { randomUUID } from 'node:crypto';
import { EventEmitter, once } from 'node:events';
import { setTimeout as sleep } from 'node:timers/promises';
import { invalid } from '../src/error.js';
import { firstOutputFrame } from '../src/header.js';
import { beside } from './beside.js';
import { DanceKeys } from './dance_keys.js';
import { isFile } from './order.js';
import { PageClock } from './page_clock.js';
import { Refusal, refusalOf } from './refusal.js';

const lead = 1; // seconds beyond the page's clock up to which frames are final and sent; pages need 0.7 to play
const tick = 0.1; // seconds
const pieceOfFile = 1 << 20; // bytes
const mostWaiting = 1000; // keys: the most that a dance has
const [tooLate, frozen] = ['REJECTION_CODE_TOO_LATE', 'REJECTION_CODE_FROZEN'];
const allSettled = 'too late: all of the dance is settled';

export class ServedDance {
  id = randomUUID();
  /** The model, known once a server has answered. */
  model;
  over = false;
  watchers = 0;
  /** Where the dancer stands in the newest frame, {here: [x, z], time: seconds}. */
  dancer = { here: [0, 0], time: 0 };
  /** The timer after which the server forgets it. */
  forget;
  #client;
  #order;
  #options;
  #end = new AbortController();
  #edits = []; // requests not yet sent
  #keys; // DanceKeys, known with the model
  #granted = 0; // frames of the model that are final, or about to be
  #told = []; // events: {text, frames sent so far}
  #dropped = 0; // number of forgotten events
  #bytes = 0; // in the kept events
  #frames = 0; // sent
  #taken = 0; // frames received by the page that has most
  #shownRate = Infinity; // frames per second
  #clock;
  #news = new EventEmitter().setMaxListeners(0);

  /** `order`: a DanceOrder of index.d.ts. */
  constructor(client, order, options) {
    this.#client = client;
    this.#order = order;
    this.#options = options;
    this.#clock = new PageClock(order.speed ?? 1);
    this.#dance();
  }

  stop() {
    this.#end.abort();
  }

  /** Sets or moves a key: the requests of editsOf(). */
  setKey(requests) {
    const [{ keyframe }, ...steps] = requests;
    this.#requireInside(keyframe, steps.at(-1)?.keyframe);
    const { id, time = keyframe.frame / this.model.model_frame_rate } = keyframe;
    const warn = (...given) => this.warn(...given);
    this.#say({ id, asked: time }, this.#keys.isLate(keyframe), () => this.#keys.set(requests, warn));
  }

  removeKey(id) {
    const warn = (...given) => this.warn(...given);
    this.#say({ id, asked: null }, false, () => this.#keys.remove(id, warn));
  }

  #say(news, isLate, requests) {
    if (this.#edits.length >= mostWaiting) throw new Refusal(429, 'too many keys wait');
    // Nobody would answer it.
    if (this.#granted >= this.#last) this.#tell('key', { ...news, refused: allSettled });
    else if (isLate) this.#tell('key', { ...news, refused: this.#whyRefused({ code: tooLate, earliest_frame: this.#granted }) }); // nor may its steps be danced
    else this.#edits.push(...requests());
  }

  /** The dance's end, in the model's frames. */
  get #last() {
    return Math.round(this.#order.seconds * this.model.model_frame_rate);
  }

  /** Throws for a key that is not before the end, or is held beyond it. A time is that of the nearest frame. */
  #requireInside({ time, frame }, held) {
    const { seconds } = this.#order;
    const rate = this.model.model_frame_rate;
    const end = this.#last;
    const last = `its last frame is at ${Math.round((1000 * (end - 1)) / rate) / 1000} s`;
    if (frame >= end) throw invalid('frame', `${frame} is not before the end of the dance, ${end}`);
    if (time >= seconds) throw invalid('time', `${time} s is not before the end of the dance, ${seconds} s`);
    if (Math.round(time * rate) >= end) throw invalid('time', `${time} s is nearest to the end of the dance, ${seconds} s; ${last}`);
    if (held && Math.round(held.time * rate) > end) throw invalid('hold', `ends at ${Number(held.time.toFixed(3))} s, after the end of the dance: ${last}`);
  }

  /** Hears where its page plays, {time, paused}. */
  hearClock(body) {
    this.#clock.tell(body);
  }

  warn(id, message) {
    this.#tell('warning', { id, message });
  }

  /** The number of the event after the last one that a page has heard, `heard`; undefined if that is forgotten, or no more will come. */
  after(heard) {
    const [, last] = /^[^/]+\/(\d+)$/.exec(heard) ?? [];
    const [next, end] = [Number(last) + 1, this.#dropped + this.#told.length];
    if (!(next <= end)) throw new Refusal(400, `Last-Event-ID: "${heard}" is not an event`);
    return next < this.#dropped || (this.over && next === end) ? undefined : next;
  }

  /** Sends a page all events from `next` on, as fast as it reads, until none is left or the page is gone. */
  async tell(next, response, signal) {
    ++this.watchers;
    try {
      for (let at = next; at >= this.#dropped; ) {
        const one = this.#told[at - this.#dropped];
        if (!one && this.over) return;
        if (!one) {
          await once(this.#news, 'told', { signal });
          continue;
        }
        ++at;
        if (!response.write(one.text)) await once(response, 'drain', { signal });
        this.#taken = Math.max(this.#taken, one.frames);
        if (one.frames > 0) this.#clock.start();
      }
    } catch (error) {
      if (!signal.aborted) throw error;
    } finally {
      --this.watchers;
    }
  }

  #tell(event, data) {
    const text = `id: ${this.id}/${this.#dropped + this.#told.length}\nevent: ${event}\ndata: ${JSON.stringify(data)}\n\n`;
    this.#told.push({ text, frames: this.#frames });
    this.#bytes += text.length;
    while (this.#bytes > this.#options.keep && this.#told.length > 1) {
      this.#bytes -= this.#told.shift().text.length;
      ++this.#dropped;
    }
    this.#news.emit('told');
  }

  async #dance() {
    const { signal } = this.#end;
    const onResume = (resumed) => {
      this.#tell('moved', { frame: resumed.frame }); // without the address, which pages need not know
      this.#options.onResume(resumed);
    };
    try {
      const { models } = await this.#client.info({ signal });
      const wanted = this.#order.config?.model;
      this.model = models.find(({ name }) => !wanted || name === wanted) ?? models[0];
      this.#keys = new DanceKeys(this.model.model_frame_rate, this.#last);
      for await (const answer of this.#client.streamDance(this.#requests(), { signal, onResume, onRejected: () => {} })) this.#take(answer);
    } catch (error) {
      if (!signal.aborted) {
        const { code, message, retryAfter } = refusalOf(error);
        this.#tell('failed', { code, message, retry_after: retryAfter });
        this.#options.onFailed(error);
      }
    } finally {
      this.over = true;
      this.#news.emit('told');
    }
  }

  /** The reason for a page, which counts in seconds. */
  #whyRefused({ code, field, reason, earliest_frame }) {
    const isLate = code === tooLate || code === frozen;
    if (Number(earliest_frame) < 0 && (isLate || /^(remove_)?keyframe$/.test(field))) return allSettled;
    if (isLate) return `too late: all before ${Math.ceil((100 * Number(earliest_frame)) / this.model.model_frame_rate) / 100} s is settled`;
    return field && !field.startsWith('remove_keyframe') ? `${this.#asOwn(field)}: ${reason}` : reason;
  }

  /** The field of a key as the page names it. */
  #asOwn(field) {
    const [, turn] = /^keyframe\.pose\.rotations\[(\d+)\]$/.exec(field) ?? [];
    if (turn !== undefined) return `rotations.${this.model.skeleton.joint_names[Math.floor(turn / 3)]}`;
    return field.replace('keyframe.pose.root_position', 'place').replace('keyframe.mask', 'rotations').replace(/^keyframe\./, '');
  }

  #take({ header, frames, event, continuation, summary }) {
    if (header) {
      this.#shownRate = header.frame_rate;
      this.#clock.begin(Number(header.first_frame) / header.model_frame_rate);
      const { frame_rate, skeleton } = header;
      this.#tell('dance', { id: this.id, frame_rate, first_frame: firstOutputFrame(header), skeleton });
    }
    if (frames) {
      this.#frames += frames.count;
      const [x, , z] = frames.root_positions.slice(-3);
      const first = Number(frames.first_frame);
      this.dancer = { here: [x, z], time: (first + frames.count) / this.#shownRate };
      this.#tell('frames', { first, places: short(frames.root_positions), turns: short(frames.rotations) });
    }
    if (event) this.#hear(event);
    if (continuation) this.#options.onContinuation(continuation, this.id);
    if (summary) {
      this.over = true; // from now on nobody would answer a key
      this.#tell('over', { frames: this.#frames });
    }
  }

  #hear({ frame, time, keyframe_reached: reached, keyframe_rejected: rejected, warning }) {
    if (reached && this.#keys.reach(reached.id, Number(frame))) this.#tell('key', { id: reached.id, time });
    if (rejected) this.#hearRefused(rejected, Number(frame), time);
    if (warning) this.warn(this.#keys.owner(warning.keyframe_id), warning.message);
  }

  #hearRefused(rejected, frame, time) {
    const { id, field, code } = rejected;
    const [isRemoval, isFrozen] = [field.startsWith('remove_keyframe'), code === frozen];
    const refused = this.#whyRefused(rejected);
    const owner = this.#keys.owner(id);
    // The frame of what is frozen is its own, and not what was asked for.
    if (this.#keys.refuse(id, frame, { isRemoval, isFrozen })) this.#tell('key', { id, refused, asked: isRemoval ? null : isFrozen ? undefined : time });
    else if (code === 'REJECTION_CODE_INVALID' && !isRemoval && this.#keys.shorten(owner)) this.warn(owner, `it is not held to its end: ${refused}`);
  }

  /** The dance's requests, each when the page's clock comes near it. */
  async *#requests() {
    const { config = {}, seconds, music, keys = [], speed = 1 } = this.#order;
    const rate = this.model.model_frame_rate;
    const end = this.#last;
    const first = Number(config.continuation?.frame ?? config.history?.first_frame ?? 0);
    if (end <= first) throw invalid('seconds', `${seconds} s leaves no frame to dance: the dance begins at ${first / rate} s`);
    const step = () => {
      // A page that does not keep up is waited for.
      const waits = this.watchers > 0 && this.#frames - this.#taken > this.#options.behind * this.#shownRate;
      // What is settled stays so when a page goes back.
      if (!waits) this.#granted = Math.max(this.#granted, Math.min(Math.round((this.#clock.time + lead) * rate), end));
      return [...this.#edits.splice(0), ...this.#keys.settle(this.#granted), { generate_until: { frame: this.#granted } }];
    };
    const wait = 1000 / speed; // milliseconds of a second
    yield {
      config: {
        ...config,
        ...(isFile(music) && { audio_format: { encoding: 'AUDIO_ENCODING_FILE' } }),
        frames: end,
        encoding: 'ROTATION_ENCODING_QUATERNION',
        generate_until: 0, // else each key would settle the frames up to itself
        reject_invalid_keys: true,
      },
    };
    for (const key of keys) this.#keys.note(key);
    yield* keys;
    if (isFile(music)) yield* piecesOf(music);
    else if (music) yield* this.#live(music, step, wait);
    if (music) yield { end_of_audio: {} };
    while (this.#granted < end) {
      yield* step();
      await sleep(wait * tick);
    }
    yield { keyframes_complete: {} };
  }

  /** Music while it sounds, to its end, or that of the dance: frames are settled, and keys sent, beside it. */
  async *#live(music, step, wait) {
    let end = Infinity;
    for await (const pieces of beside(music, wait * tick)) {
      if (pieces.length === 0) yield* step();
      for (const piece of pieces) this.#keys.note(Object(piece));
      yield* pieces;
      if (this.#granted >= this.#last) end = Math.min(end, performance.now() + wait * lead); // so much of it is still to sound
      if (performance.now() >= end) return;
    }
  }
}

function* piecesOf(file) {
  const bytes = ArrayBuffer.isView(file) ? new Uint8Array(file.buffer, file.byteOffset, file.byteLength) : new Uint8Array(file);
  for (let start = 0; start < bytes.length; start += pieceOfFile) yield { audio: { data: bytes.subarray(start, start + pieceOfFile) } };
}

/** Numbers to a tenth of a millimetre: a third of the text. */
const short = (numbers) => numbers.map((number) => Math.round(1e4 * number) / 1e4);
