// A back end that streams dances to web pages as server-sent events. Whoever watches adds key poses meanwhile:
//   node web.js [--server HOST:PORT]... [--port 8080] [--seconds 60] [--speed 1]
//
//   GET  /                  web.html
//   GET  /dance?seed=1      events: dance, frames, key, moved, over, failed
//   POST /dance/ID/keys     {"id": "wave", "time": 4.5, "rotations": {"left_shoulder": [0, 0, 1]}}
import { randomUUID } from 'node:crypto';
import { once } from 'node:events';
import { readFile } from 'node:fs/promises';
import { createServer } from 'node:http';
import { pose } from 'choreo-client';
import { clicks, live, pcm, sampleRate } from './music.js';
import { positive, run, whole } from './program.js';

const flags = {
  port: { type: 'string', default: '8080' },
  seconds: { type: 'string', default: '60' },
  speed: { type: 'string', default: '1' },
};
const lookAhead = 0.5; // seconds: what is nearer than this is settled, and on its way to the page
const mostBytes = 65536; // of what a page may send

/** What a page asked for that makes no sense; the page is told why. */
class Refusal extends Error {
  constructor(status, message) {
    super(message);
    this.status = status;
  }
}

/**
 * The key that a page asks for, as a request. It asks for the joints alone that it names. Whatever the server would refuse is refused here: there
 * it would end the dance.
 */
function keyRequest({ id, time, rotations }, { model, frames, granted, places }) {
  const { skeleton, model_frame_rate: rate } = model;
  if (typeof id !== 'string' || !/^.{1,64}$/.test(id)) throw new Refusal(400, `id: ${id} is no text of 1 to 64 characters`);
  const frame = Math.round(time * rate);
  if (!Number.isFinite(time) || frame >= frames) throw new Refusal(400, `time: ${time} is not before the end, ${frames / rate} s`);
  if (Math.min(frame, places.get(id) ?? frame) < granted) throw new Refusal(409, `time: all before ${granted / rate} s is settled`);
  for (const [other, place] of places) {
    if (other !== id && Math.abs(place - frame) < 2) throw new Refusal(409, `time: ${time} is where ${other} is`);
  }
  const turned = Object.entries(rotations ?? {});
  if (turned.length === 0) throw new Refusal(400, 'rotations: they turn no joint');
  for (const [joint, turn] of turned) {
    if (!skeleton.joint_names.includes(joint)) throw new Refusal(400, `rotations: there is no joint ${joint}`);
    const fine = Array.isArray(turn) && turn.length === 3 && turn.every(Number.isFinite) && Math.hypot(...turn) <= 2 * Math.PI;
    if (!fine) throw new Refusal(400, `rotations.${joint}: ${turn} is no axis times an angle up to 2 pi`);
  }
  places.set(id, frame);
  const joints = turned.map(([joint]) => skeleton.joint_names.indexOf(joint)).sort((a, b) => a - b);
  // Without a root position the key stands wherever the dancer is then.
  return { keyframe: { id, frame, pose: { rotations: pose(skeleton, rotations).rotations }, mask: { joints } } };
}

class Backend {
  #client;
  #options;
  #dances = new Map(); // id -> what is known of it

  constructor(client, options) {
    this.#client = client;
    this.#options = { seconds: positive(options, 'seconds'), speed: positive(options, 'speed') };
  }

  async answer(request, response) {
    const url = new URL(request.url, 'http://localhost');
    const asked = `${request.method} ${url.pathname}`;
    const dance = /^POST \/dance\/([^/]+)\/keys$/.exec(asked)?.[1];
    if (asked === 'GET /') {
      response.setHeader('Content-Type', 'text/html; charset=utf-8');
      response.end(await readFile(new URL('web.html', import.meta.url)));
    } else if (asked === 'GET /dance') {
      await this.#watch(url.searchParams.get('seed') ?? '1', response);
    } else if (dance) {
      await this.#addKey(dance, request);
      response.writeHead(202).end();
    } else {
      throw new Refusal(404, `nothing is at ${asked}`);
    }
  }

  async #addKey(id, request) {
    const dance = this.#dances.get(id);
    if (!dance) throw new Refusal(404, `nobody dances ${id}`);
    let text = '';
    for await (const piece of request.setEncoding('utf8')) {
      text += piece;
      if (text.length > mostBytes) throw new Refusal(413, `more than ${mostBytes} characters`);
    }
    let key;
    try {
      key = Object(JSON.parse(text));
    } catch {
      throw new Refusal(400, 'this is no JSON');
    }
    dance.requests.push(keyRequest(key, dance));
  }

  /** Sends a dance as events, until it is over or the page is closed. */
  async #watch(seed, response) {
    if (!/^\d{1,19}$/.test(seed)) throw new Refusal(400, `seed: ${seed} is no whole number of 1 to 19 digits`);
    const stop = new AbortController();
    response.once('close', () => stop.abort());
    response.writeHead(200, { 'Content-Type': 'text/event-stream', 'Cache-Control': 'no-store' });
    const send = async (event, data) => {
      // A page that reads slowly slows its dance down.
      if (!response.write(`event: ${event}\ndata: ${JSON.stringify(data)}\n\n`)) await once(response, 'drain', { signal: stop.signal });
    };
    const id = randomUUID();
    const onResume = ({ address, frame }) => send('moved', { address, frame }).catch(() => {});
    try {
      const model = (await this.#client.info({ signal: stop.signal })).models[0];
      const frames = Math.round(this.#options.seconds * model.model_frame_rate);
      // Of its keys the requests that are still to be said, and their frames; frames before `granted` are settled.
      this.#dances.set(id, { model, frames, granted: 0, requests: [], places: new Map() });
      for await (const answer of this.#client.streamDance(this.#requests(id, seed), { signal: stop.signal, onResume })) {
        const { header, frames: block, event, summary } = answer;
        if (header) await send('dance', { id, frame_rate: header.frame_rate, skeleton: header.skeleton });
        if (block) await send('frames', { first: Number(block.first_frame), places: short(block.root_positions), turns: short(block.rotations) });
        if (event?.keyframe_reached) await send('key', { id: event.keyframe_reached.id, time: event.time });
        if (event?.keyframe_rejected) await send('key', { id: event.keyframe_rejected.id, refused: event.keyframe_rejected.reason });
        if (summary) await send('over', { frames: Number(summary.report.frames) });
      }
    } catch (error) {
      if (!stop.signal.aborted) await send('failed', { code: error.code, message: error.message, retry_after: error.retryAfter });
    } finally {
      this.#dances.delete(id);
      response.end();
    }
  }

  /** A dance to music that is being played, with the keys that come from its page. */
  async *#requests(id, seed) {
    const { seconds, speed } = this.#options;
    const dance = this.#dances.get(id);
    // Without generate_until here each key would settle the frames up to itself.
    yield { config: { seed, frames: dance.frames, audio_format: pcm, encoding: 'ROTATION_ENCODING_QUATERNION', generate_until: 0 } };
    for await (const piece of live(clicks(seconds), speed)) {
      const played = (piece.audio.first_sample + piece.audio.data.length / 2) / sampleRate;
      const before = dance.requests.splice(0); // of the keys, those that were asked for before this is settled
      dance.granted = Math.round((played + lookAhead) * dance.model.model_frame_rate);
      yield* before;
      yield { generate_until: { frame: dance.granted } };
      yield piece;
    }
    yield { end_of_audio: {} };
    yield { keyframes_complete: {} };
  }
}

/** Numbers to a tenth of a millimetre: a third of the text. */
const short = (numbers) => numbers.map((number) => Math.round(1e4 * number) / 1e4);

await run(flags, async (client, options, signal) => {
  const backend = new Backend(client, options);
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
