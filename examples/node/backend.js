// A back end that streams dances to web pages as server-sent events. Whoever watches adds key poses meanwhile:
//
//   GET  /song.wav          what it dances to
//   GET  /skeleton          the body that dances
//   GET  /dance?seed=1      events: dance, frames, key, warning, moved, over, failed; with Last-Event-ID those after it
//   POST /dance/ID/keys     {"id": "wave", "time": 4.5, "rotations": {"left_shoulder": [0, 0, 1]}}
import { randomUUID } from 'node:crypto';
import { EventEmitter, once } from 'node:events';
import { readFile } from 'node:fs/promises';
import { createServer } from 'node:http';
import { extname } from 'node:path';
import { pose } from 'choreo-client';
import { live, pcm, sampleRate, song, wav } from './music.js';
import { positive, run, whole } from './program.js';

const flags = {
  port: { type: 'string', default: '8080' },
  seconds: { type: 'string', default: '60' },
  speed: { type: 'string', default: '1' },
};
const types = { '.html': 'text/html; charset=utf-8', '.js': 'text/javascript; charset=utf-8' };
const lookAhead = 0.5; // seconds: what is nearer than this is settled, and on its way to the page
const mostBytes = 65536; // of what a page may send
const mostAway = 5; // seconds that a dance goes on without its page, whose connection may be lost
const untilBack = 0.5; // seconds after which a browser asks for the rest

/** What a page asked for that makes no sense; the page is told why. */
class Refusal extends Error {
  constructor(status, message) {
    super(message);
    this.status = status;
  }
}

/**
 * The key that a page asks for, as a request; it sets the joints alone that it names. Whatever is wrong with it the page hears as an event, because
 * of reject_invalid_keys, but for rotations that make no pose: of those pose() tells.
 */
function keyRequest({ id, time, rotations }, { skeleton }) {
  const turns = rotations ?? {};
  const joints = skeleton.joint_names.flatMap((name, joint) => (Object.hasOwn(turns, name) ? joint : []));
  return { keyframe: { id, time, pose: pose(skeleton, turns), mask: { joints } } }; // wherever the dancer is then
}

async function contentOf(file) {
  try {
    return await readFile(file);
  } catch (error) {
    throw error.code === 'ENOENT' ? new Refusal(404, `there is no ${file.pathname}`) : error;
  }
}

class Backend {
  #client;
  #options;
  #fileAt;
  #song;
  #dances = new Map(); // id -> what is known of it

  constructor(client, options, fileAt) {
    this.#client = client;
    this.#fileAt = fileAt;
    this.#options = { seconds: positive(options, 'seconds'), speed: positive(options, 'speed') };
    this.#song = song(this.#options.seconds);
  }

  async answer(request, response) {
    const url = URL.canParse(request.url, 'http://localhost') && new URL(request.url, 'http://localhost');
    if (!url) throw new Refusal(400, `${request.url} is no address`);
    const asked = `${request.method} ${url.pathname}`;
    const dance = /^POST \/dance\/([^/]+)\/keys$/.exec(asked)?.[1];
    const file = request.method === 'GET' && this.#fileAt(url.pathname);
    if (file) {
      response.setHeader('Content-Type', types[extname(file.pathname)] ?? 'application/octet-stream');
      response.end(await contentOf(file));
    } else if (asked === 'GET /song.wav') {
      response.setHeader('Content-Type', 'audio/wav');
      response.end(wav(this.#song));
    } else if (asked === 'GET /skeleton') {
      response.setHeader('Content-Type', 'application/json');
      response.end(JSON.stringify((await this.#client.info()).models[0].skeleton));
    } else if (asked === 'GET /dance') {
      await this.#watch(url.searchParams.get('seed') ?? '1', request.headers['last-event-id'], response);
    } else if (dance) {
      await this.#addKey(dance, request);
      response.writeHead(202).end();
    } else {
      throw new Refusal(404, `nothing is at ${asked}`);
    }
  }

  async #addKey(id, request) {
    const dance = this.#dances.get(id);
    if (!dance || dance.over) throw new Refusal(404, `nobody dances ${id}`);
    let text = '';
    for await (const piece of request.setEncoding('utf8')) {
      text += piece;
      if (text.length > mostBytes) throw new Refusal(413, `more than ${mostBytes} characters`);
    }
    try {
      dance.requests.push(keyRequest(Object(JSON.parse(text)), dance.model));
    } catch (error) {
      throw new Refusal(400, error.message);
    }
  }

  /**
   * Tells a page of a dance: a new one or, where its connection was lost, the one of which it heard up to the event `heard`. A browser asks for
   * that by itself.
   */
  async #watch(seed, heard, response) {
    const [id, last] = heard?.split('/') ?? [];
    if (heard && !this.#dances.has(id)) return response.writeHead(204).end(); // nothing is left to tell: the browser asks no more
    if (heard && !(Number(last) < this.#dances.get(id).told.length && /^\d+$/.test(last))) throw new Refusal(400, `${heard} is no event`);
    if (!/^\d{1,20}$/.test(seed) || BigInt(seed) >= 2n ** 64n) throw new Refusal(400, `seed: ${seed} is no whole number below 2^64`);
    const dance = heard ? this.#dances.get(id) : this.#begin(seed);
    const gone = new AbortController();
    response.once('close', () => gone.abort());
    response.writeHead(200, { 'Content-Type': 'text/event-stream', 'Cache-Control': 'no-store' });
    response.write(`retry: ${1000 * untilBack}\n\n`);
    clearTimeout(dance.forget);
    ++dance.watchers;
    try {
      for (let at = heard ? Number(last) + 1 : 0; at < dance.told.length || !dance.over; ) {
        if (at >= dance.told.length) await once(dance.news, 'told', { signal: gone.signal });
        else if (!response.write(dance.told[at++])) await once(response, 'drain', { signal: gone.signal });
      }
    } catch (error) {
      if (!gone.signal.aborted) throw error;
    } finally {
      if (--dance.watchers === 0) dance.forget = setTimeout(() => this.#end(dance), 1000 * mostAway).unref();
      response.end();
    }
  }

  #begin(seed) {
    // Of its keys the requests that are still to be said. All that is told is kept, for pages that come back.
    const dance = { id: randomUUID(), requests: [], told: [], news: new EventEmitter(), watchers: 0, over: false };
    dance.stop = new AbortController();
    this.#dances.set(dance.id, dance);
    this.#dance(dance, seed);
    return dance;
  }

  #end(dance) {
    dance.stop.abort();
    this.#dances.delete(dance.id);
  }

  /** Dances, and tells of it as events. */
  async #dance(dance, seed) {
    const { signal } = dance.stop;
    const tell = (event, data) => {
      dance.told.push(`id: ${dance.id}/${dance.told.length}\nevent: ${event}\ndata: ${JSON.stringify(data)}\n\n`);
      dance.news.emit('told');
    };
    const onRejected = ({ id, field, reason }) => tell('key', { id, refused: field ? `${field}: ${reason}` : reason });
    const onResume = ({ address, frame }) => tell('moved', { address, frame });
    try {
      dance.model = (await this.#client.info({ signal })).models[0];
      dance.frames = Math.round(this.#options.seconds * dance.model.model_frame_rate);
      for await (const answer of this.#client.streamDance(this.#requests(dance, seed), { signal, onResume, onRejected })) {
        const { header, frames: block, event, summary } = answer;
        if (header) tell('dance', { id: dance.id, frame_rate: header.frame_rate, skeleton: header.skeleton });
        if (block) tell('frames', { first: Number(block.first_frame), places: short(block.root_positions), turns: short(block.rotations) });
        if (event?.keyframe_reached) tell('key', { id: event.keyframe_reached.id, time: event.time });
        if (event?.warning) tell('warning', { id: event.warning.keyframe_id, message: event.warning.message });
        if (summary) tell('over', { frames: Number(summary.report.frames) });
      }
    } catch (error) {
      tell('failed', { code: error.code, message: error.message, retry_after: error.retryAfter });
    } finally {
      dance.over = true;
      dance.news.emit('told');
    }
  }

  /** A dance to music that is being played, with the keys that come from its page. */
  async *#requests(dance, seed) {
    // Without generate_until here each key would settle the frames up to itself.
    yield { config: { seed, frames: dance.frames, audio_format: pcm, encoding: 'ROTATION_ENCODING_QUATERNION', generate_until: 0, reject_invalid_keys: true } };
    for await (const piece of live(this.#song, this.#options.speed)) {
      const played = (piece.audio.first_sample + piece.audio.data.length / 2) / sampleRate;
      yield* dance.requests.splice(0);
      yield { generate_until: { frame: Math.round((played + lookAhead) * dance.model.model_frame_rate) } };
      yield piece;
    }
    yield { end_of_audio: {} };
    yield { keyframes_complete: {} };
  }
}

/** Numbers to a tenth of a millimetre: a third of the text. */
const short = (numbers) => numbers.map((number) => Math.round(1e4 * number) / 1e4);


/** Serves dances, and the files of a page: `fileAt(path)` is a file's URL, or undefined. */
export const serve = (fileAt) =>
  run(flags, async (client, options, signal) => {
    const backend = new Backend(client, options, fileAt);
    const server = createServer((request, response) =>
      backend.answer(request, response).catch((error) => {
        if (response.headersSent) return response.destroy();
        response.writeHead(error.status ?? 500, { 'Content-Type': 'text/plain; charset=utf-8' }).end(`${error.message}\n`);
      }),
    );
    server.listen(Number(whole(options, 'port', 0n, 65535n)), '127.0.0.1');
    await once(server, 'listening');
    console.log(`http://127.0.0.1:${server.address().port}`);
    if (!signal.aborted) await once(signal, 'abort');
    server.close();
    server.closeAllConnections();
  });
