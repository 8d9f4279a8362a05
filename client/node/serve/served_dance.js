// A dance for a page, paced by the page's clock. Keeps its server-sent events for pages that reconnect.
import { randomUUID } from 'node:crypto';
import { EventEmitter, once } from 'node:events';
import { setTimeout as sleep } from 'node:timers/promises';
import { invalid } from '../src/error.js';
import { firstOutputFrame } from '../src/header.js';
import { isFile } from './order.js';
import { PageClock } from './page_clock.js';
import { Refusal, refusalOf } from './refusal.js';

const lead = 1; // seconds beyond the page's clock up to which frames are final and sent; pages need 0.7 to play
const tick = 0.1; // seconds
const pieceOfFile = 1 << 20; // bytes
const mostWaiting = 1000; // keys: the most that a dance has

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

  say(requests) {
    if (this.#edits.length + requests.length > mostWaiting) throw new Refusal(429, 'too many keys wait');
    this.#requireInside(requests[0].keyframe ?? {});
    this.#edits.push(...requests);
  }

  /** Throws for a key that is not before the end. A time is that of the nearest frame. */
  #requireInside({ time, frame }) {
    const { seconds } = this.#order;
    const rate = this.model.model_frame_rate;
    const end = Math.round(seconds * rate);
    if (frame >= end) throw invalid('frame', `${frame} is not before the end of the dance, ${end}`);
    if (time >= seconds) throw invalid('time', `${time} s is not before the end of the dance, ${seconds} s`);
    if (Math.round(time * rate) >= end) {
      throw invalid('time', `${time} s is nearest to the end of the dance, ${seconds} s; its last frame is at ${Math.round((1000 * (end - 1)) / rate) / 1000} s`);
    }
  }

  /** Hears where its page plays, {time, paused}. */
  hearClock(body) {
    this.#clock.tell(body);
  }

  warn(id, message) {
    this.#tell('warning', { id, message });
  }

  /** The number of the event after a page's `last` one; undefined if that event is forgotten. */
  after(last) {
    const next = /^\d+$/.test(last) ? Number(last) + 1 : NaN;
    if (!(next <= this.#dropped + this.#told.length)) throw new Refusal(400, `${last} is not an event`);
    return next < this.#dropped ? undefined : next;
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
    const onRejected = (rejected) => this.#tell('key', { id: rejected.id, refused: this.#whyRefused(rejected) });
    const onResume = (resumed) => {
      this.#tell('moved', { frame: resumed.frame }); // without the address, which pages need not know
      this.#options.onResume?.(resumed);
    };
    try {
      const { models } = await this.#client.info({ signal });
      const wanted = this.#order.config?.model;
      this.model = models.find(({ name }) => !wanted || name === wanted) ?? models[0];
      for await (const answer of this.#client.streamDance(this.#requests(), { signal, onResume, onRejected })) this.#take(answer);
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
    const isLate = code === 'REJECTION_CODE_TOO_LATE' || code === 'REJECTION_CODE_FROZEN';
    if (Number(earliest_frame) < 0 && (isLate || /^(remove_)?keyframe$/.test(field))) return 'too late: all of the dance is settled';
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
    if (event?.keyframe_reached) this.#tell('key', { id: event.keyframe_reached.id, time: event.time });
    if (event?.warning) this.warn(event.warning.keyframe_id, event.warning.message);
    if (continuation) this.#options.onContinuation?.(continuation, this.id);
    if (summary) this.#tell('over', { frames: this.#frames });
  }

  /** The dance's requests, each when the page's clock comes near it. */
  async *#requests() {
    const { config = {}, seconds, music, keys = [], speed = 1 } = this.#order;
    const rate = this.model.model_frame_rate;
    const end = Math.round(seconds * rate);
    const first = Number(config.continuation?.frame ?? config.history?.first_frame ?? 0);
    if (end <= first) throw invalid('seconds', `${seconds} s leaves no frame to dance: the dance begins at ${first / rate} s`);
    let granted = 0;
    const step = () => {
      // A page that does not keep up is waited for.
      const waits = this.watchers > 0 && this.#frames - this.#taken > this.#options.behind * this.#shownRate;
      // What is settled stays so when a page goes back.
      if (!waits) granted = Math.max(granted, Math.min(Math.round((this.#clock.time + lead) * rate), end));
      return [...this.#edits.splice(0), { generate_until: { frame: granted } }];
    };
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
    yield* keys;
    if (isFile(music)) yield* piecesOf(music);
    for await (const request of isFile(music) ? [] : (music ?? [])) {
      yield* step();
      yield request;
    }
    if (music) yield { end_of_audio: {} };
    while (granted < end) {
      yield* step();
      await sleep((1000 * tick) / speed);
    }
    yield { keyframes_complete: {} };
  }
}

function* piecesOf(file) {
  const bytes = ArrayBuffer.isView(file) ? new Uint8Array(file.buffer, file.byteOffset, file.byteLength) : new Uint8Array(file);
  for (let start = 0; start < bytes.length; start += pieceOfFile) yield { audio: { data: bytes.subarray(start, start + pieceOfFile) } };
}

/** Numbers to a tenth of a millimetre: a third of the text. */
const short = (numbers) => numbers.map((number) => Math.round(1e4 * number) / 1e4);
