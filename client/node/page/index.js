// A dance of serveDance() on a page. See index.d.ts.
import { requireOptions } from '../character/given.js';
import { Player, smplPoses } from '../character/index.js';
import { Clock } from './clock.js';
import { DanceError } from './dance_error.js';
import { eventsOf } from './events.js';
import { isolated } from './isolated.js';
import { addressOf, givenOf, textOf } from './key_request.js';
import { PendingKeys } from './pending_keys.js';
import { ToldClock } from './told_clock.js';

const before = 0.7; // seconds of poses needed before the music continues
const soonest = 2; // the least seconds from a request to its key: the back end settles one ahead, and the dancer needs time to get there
const beyond = 1.2; // seconds after the newest frame: earlier ones are settled
const kept = 1; // seconds of the past, for another character
const callbacks = ['onKey', 'onWarning', 'onMoved', 'onLost', 'onEnd'];
const names = ['headers', 'patience', 'fetch', ...callbacks];

export { DanceError };

export function connectDance(url, options = {}) {
  requireOptions(options, names);
  return new PageDance(url, options);
}

class PageDance {
  begun;
  over = false;
  #url;
  #options;
  #stop = new AbortController();
  #header;
  #recent = []; // messages that are not past
  #seconds = 0; // the time shown last
  #worn; // {character, player, add(frames), end()}
  #holds = true; // the music waits for the dancer
  #clock; // for dances without music
  #placed; // the element that has been set to the dance's beginning
  #newest = 0; // seconds: the end of what has come
  #pending = new PendingKeys();
  #told = new ToldClock((clock) => this.#send('POST', '/clock', JSON.stringify(clock)));

  constructor(url, options) {
    this.#url = String(url);
    this.#options = { patience: 10, ...options, ...Object.fromEntries(callbacks.map((name) => [name, isolated(options[name])])) };
    this.begun = new Promise((resolve, reject) => this.#listen(resolve, reject));
    this.begun.catch(() => {}); // onEnd hears of it, too
  }

  close() {
    this.#stop.abort(new DanceError('the dance is closed', { code: 'CANCELLED' }));
  }

  wear(character) {
    if (!this.#header) throw new DanceError('the dance has not begun: await its begun', { code: 'FAILED_PRECONDITION' });
    const player = new Player(this.#header);
    const dance = character?.dance(this.#header) ?? { add: (frames) => smplPoses(frames, this.#header.skeleton), end: () => [] };
    const add = (frames) => player.add(dance.add(frames));
    const end = () => (player.add(dance.end()), player.end());
    this.#recent.forEach(add);
    if (this.over) end();
    this.#worn = { player, add, end };
  }

  at(seconds) {
    this.#seconds = seconds;
    if (this.#header && !this.#worn) this.wear();
    return this.#worn ? this.#worn.player.at(seconds) : { state: 'waiting', ahead: 0 };
  }

  follow(audio = (this.#clock ??= new Clock())) {
    this.#place(audio);
    const shown = this.at(audio.currentTime);
    if (shown.state === 'starved' && !audio.paused && !this.over) {
      this.#holds = true;
      audio.pause();
    }
    if (this.#holds && this.#worn && (shown.ahead > before || this.over)) {
      this.#holds = false;
      if (!audio.ended) Promise.resolve(audio.play()).catch((error) => this.#options.onWarning({ message: error.message }));
    }
    if (this.#header && !this.over) this.#told.follow(audio);
    return shown;
  }

  /** Sets an element that stands before the dance to its first frame: there is nothing to wait for. Only once: elements round their times. */
  #place(audio) {
    if (!this.#header || this.#placed === audio) return;
    this.#placed = audio;
    if (audio.currentTime < this.#start()) audio.currentTime = this.#start();
  }

  #start() {
    return this.#header.first_frame / this.#header.frame_rate;
  }

  soon() {
    return this.#pending.after(Math.max(this.#seconds + soonest, this.#newest + beyond));
  }

  async setKey(key) {
    const given = givenOf(key);
    const said = { id: this.#pending.newId(), time: this.soon(), ...given };
    const text = textOf(said);
    await this.#ask(this.#pending.add(said), this.#send('POST', '/keys', text));
    return said;
  }

  async removeKey(id) {
    const address = addressOf(id);
    await this.#ask(this.#pending.remove(id), this.#send('DELETE', address));
  }

  /** Calls `undo` if `sent` fails: what was asked for before it stands. */
  #ask(undo, sent) {
    return sent.catch((error) => {
      undo();
      throw error;
    });
  }

  async #send(method, path, body) {
    const { headers, fetch = globalThis.fetch } = this.#options;
    const { id } = await this.begun;
    if (this.#stop.signal.aborted) throw this.#stop.signal.reason;
    if (this.over) throw new DanceError('the dance is over', { code: 'FAILED_PRECONDITION' });
    const [place] = this.#url.split(/[?#]/);
    const asked = { method, body, headers: { ...headers, 'Content-Type': 'application/json' } };
    const answer = await fetch(`${place}/${id}${path}`, asked).catch((error) => Promise.reject(DanceError.of(error)));
    if (!answer.ok) throw await DanceError.by(answer);
    await answer.text(); // browsers show a request whose answer nobody reads as cancelled
  }

  async #listen(begin, fail) {
    const { onKey, onWarning, onMoved, onEnd } = this.#options;
    let failure;
    try {
      for await (const [event, data] of eventsOf(this.#url, { ...this.#options, signal: this.#stop.signal })) {
        if (event === 'dance') this.#begin(data, begin);
        else if (event === 'frames') this.#take(data);
        else if (event === 'key') onKey(this.#settle(data));
        else if (event === 'warning') onWarning(data);
        else if (event === 'moved') onMoved(data);
        else if (event === 'failed') throw new DanceError(data.message, { code: data.code, retryAfter: data.retry_after });
        else if (event === 'over') this.over = true;
        if (this.over) break;
      }
      if (!this.over) throw new DanceError('the dance is gone', { code: 'NOT_FOUND' });
    } catch (error) {
      failure = DanceError.of(error);
    }
    this.over = true;
    this.#told.stop();
    this.#worn?.end();
    if (failure) fail(failure);
    if (!this.#stop.signal.aborted) onEnd(failure);
  }

  /** Returns what the page is to hear. */
  #settle({ asked, ...news }) {
    const { id, time, refused } = news;
    if (refused === undefined) this.#pending.reach(id, time);
    else this.#pending.refuse(id, asked);
    return news;
  }

  #begin(header, begin) {
    this.#header = header;
    this.#seconds = Math.max(this.#seconds, this.#start());
    begin(header);
  }

  #take({ first, places, turns }) {
    const frames = { first_frame: first, count: places.length / 3, root_positions: places, rotations: turns };
    const past = (this.#seconds - kept) * this.#header.frame_rate;
    this.#recent = [...this.#recent.filter(({ first_frame }) => first_frame > past), frames];
    this.#newest = (first + frames.count) / this.#header.frame_rate;
    this.#worn?.add(frames);
  }
}
