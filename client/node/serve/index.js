// The routes with which pages watch and change dances. For their answers see index.d.ts.
import { allow } from './cors.js';
import { editsOf } from './edits.js';
import { requireOrder } from './order.js';
import { Refusal, refusalOf } from './refusal.js';
import { checkServe } from './serve_options.js';
import { ServedDance } from './served_dance.js';

const mostBytes = 65536; // in a page's request
const mostRead = 16 << 20; // of a longer one, so that the connection serves the next
const untilBack = 0.5; // seconds until a browser reconnects
const silence = 5; // seconds between signs of life, by which both sides notice a lost connection

/** The method of each place below the path. */
const served = { '': 'GET', skeleton: 'GET', ':id/keys': 'POST', ':id/clock': 'POST', ':id/keys/:key': 'DELETE' };

/** See index.d.ts. */
export function serveDance(client, begin, given = {}) {
  const server = new DanceServer(client, begin, checkServe(client, begin, given));
  return Object.assign((request, response) => server.answer(request, response), { close: () => server.close() });
}

class DanceServer {
  #client;
  #begin;
  #options;
  #dances = new Map(); // by id

  constructor(client, begin, options) {
    this.#client = client;
    this.#begin = begin;
    this.#options = options;
  }

  close() {
    for (const dance of this.#dances.values()) this.#end(dance);
  }

  /** Returns whether the request was for this server. */
  async answer(request, response) {
    if (!URL.canParse(request.url, 'http://localhost')) return false;
    const url = new URL(request.url, 'http://localhost');
    const { path, origins } = this.#options;
    if (url.pathname !== path && !url.pathname.startsWith(`${path}/`)) return false;
    if (allow(origins, request, response)) return true;
    try {
      await this.#route(url, request, response);
    } catch (error) {
      const { status, message, code, retryAfter } = this.#told(error, (refusal) => refusal.status >= 500);
      if (response.headersSent) response.destroy();
      else {
        const named = { ...(/^[A-Z_]+$/.test(code) && { 'Choreo-Code': code }), ...(retryAfter > 0 && { 'Retry-After': Math.ceil(retryAfter) }) };
        response.writeHead(status, { 'Content-Type': 'text/plain; charset=utf-8', ...named }).end(`${message}\n`);
      }
    }
    return true;
  }

  async #route(url, request, response) {
    const [id, keys, key, ...more] = url.pathname.slice(this.#options.path.length + 1).split('/').map(decodeURIComponent);
    const place = [id && (id === 'skeleton' ? id : ':id'), keys, key && ':key', ...more].filter(Boolean).join('/');
    if (!Object.hasOwn(served, place)) throw new Refusal(404, `nothing is at ${url.pathname}`);
    if (request.method !== served[place]) {
      response.setHeader('Allow', served[place]);
      throw new Refusal(405, `${url.pathname} takes ${served[place]}, not ${request.method}`);
    }
    if (place === '') await this.#watch(url, request, response);
    else if (place === 'skeleton') await this.#tellSkeleton(response);
    else if (place === ':id/keys') await this.#sayKey(id, request, response);
    else if (place === ':id/clock') await this.#hearClock(id, request, response);
    else this.#removeKey(id, response, key);
  }

  async #tellSkeleton(response) {
    const { skeleton } = (await this.#client.info()).models[0];
    response.writeHead(200, { 'Content-Type': 'application/json' }).end(JSON.stringify(skeleton));
  }

  #find(id) {
    const dance = this.#dances.get(id);
    if (!dance?.model || dance.over) throw new Refusal(404, `nobody dances ${id}`);
    return dance;
  }

  async #sayKey(id, request, response) {
    const body = await bodyOf(request);
    const dance = this.#find(id);
    const warnings = []; // sent once the key is accepted
    const { id: key, requests } = editsOf(body, dance.model.skeleton, dance.dancer, (...warning) => warnings.push(warning));
    this.#find(id).setKey(requests);
    response.writeHead(202, { 'Content-Type': 'application/json' }).end(JSON.stringify({ id: key }));
    for (const warning of warnings) dance.warn(...warning);
  }

  async #hearClock(id, request, response) {
    const body = await bodyOf(request);
    this.#find(id).hearClock(body);
    response.writeHead(202).end();
  }

  #removeKey(id, response, key) {
    this.#find(id).removeKey(key);
    response.writeHead(202).end();
  }

  async #watch(url, request, response) {
    const heard = request.headers['last-event-id'];
    const gone = new AbortController();
    response.once('close', () => gone.abort());
    const dance = heard === undefined ? await this.#start(url, request) : this.#dances.get(heard.split('/')[0]);
    const next = heard === undefined ? 0 : dance?.after(heard);
    if (next === undefined) return response.writeHead(204).end(); // nothing is left; 204 stops a browser's reconnects
    // Keeps proxies from buffering or compressing the events.
    const headers = { 'Content-Type': 'text/event-stream', 'Cache-Control': 'no-store, no-transform', 'X-Accel-Buffering': 'no' };
    response.writeHead(200, headers).write(`retry: ${1000 * untilBack}\n\n`);
    clearTimeout(dance.forget);
    const pulse = setInterval(() => response.writableNeedDrain || response.write(': still here\n\n'), 1000 * silence);
    try {
      await dance.tell(next, response, gone.signal);
    } finally {
      clearInterval(pulse);
      if (dance.watchers === 0) dance.forget = setTimeout(() => this.#end(dance), 1000 * this.#options.away).unref();
      response.end();
    }
  }

  async #start(url, request) {
    try {
      const order = await this.#begin(url, request);
      requireOrder(order); // refuses what is known to be wrong before the dance begins
      const dance = new ServedDance(this.#client, order, this.#options);
      this.#dances.set(dance.id, dance);
      return dance;
    } catch (error) {
      throw this.#told(error, () => true);
    }
  }

  /** Converts an error for a page. Also calls onFailed, unless the error is a Refusal already or `concerns` rejects it. */
  #told(error, concerns) {
    const refusal = refusalOf(error);
    if (refusal !== error && concerns(refusal)) this.#options.onFailed(error);
    return refusal;
  }

  #end(dance) {
    clearTimeout(dance.forget);
    dance.stop();
    this.#dances.delete(dance.id);
  }
}

/** The page's JSON, or the body that a framework has parsed. */
async function bodyOf(request) {
  if (request.body !== undefined) return request.body;
  let [text, length] = ['', 0];
  try {
    for await (const piece of request.setEncoding('utf8')) {
      length += piece.length;
      if (length <= mostBytes) text += piece;
      if (length > mostRead) break; // this closes the connection
    }
  } catch (error) {
    throw new Refusal(400, error.message); // the page is gone: nobody hears it
  }
  if (length > mostBytes) throw new Refusal(413, `more than ${mostBytes} characters`);
  try {
    return JSON.parse(text);
  } catch (error) {
    throw new Refusal(400, error.message);
  }
}
