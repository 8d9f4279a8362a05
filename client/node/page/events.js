// Reads a back end's events and reconnects when a connection is lost. (EventSource sends no headers and does not notice a vanished machine.)

import { DanceError } from './dance_error.js';

const untilBack = 500; // milliseconds until it reconnects
const silence = 15000; // milliseconds without a sign of life; a back end sends one every five seconds

/**
 * Yields [event, data] of a URL's server-sent events. When a connection is lost it calls `onLost(error)` and requests the rest with Last-Event-ID.
 * Ends at the answer 204: nothing is left. Throws a back end's refusal, or the last error after `patience` seconds without a connection.
 */
export async function* eventsOf(url, { headers, signal, patience, onLost, fetch = globalThis.fetch }) {
  let last;
  let since; // when the connection was lost
  for (;;) {
    const cut = new AbortController();
    const abort = () => cut.abort(signal.reason);
    signal.addEventListener('abort', abort);
    let timer;
    const wait = () => {
      clearTimeout(timer);
      timer = setTimeout(() => cut.abort(new Error('the back end is silent')), silence);
    };
    try {
      signal.throwIfAborted();
      wait();
      const again = last === undefined ? {} : { 'Last-Event-ID': last };
      const response = await fetch(url, { headers: { ...headers, ...again }, signal: cut.signal, cache: 'no-store' });
      if (response.status === 204) return;
      if (!response.ok) throw await DanceError.by(response);
      for await (const [id, event, data] of linesOf(response.body, wait)) {
        since = undefined;
        last = id;
        yield [event, data];
      }
      throw new Error('the back end has hung up');
    } catch (error) {
      signal.throwIfAborted();
      // A dance that has not begun is not requested twice.
      if (error.status || last === undefined) throw error;
      if (since === undefined) onLost(DanceError.of(error));
      since ??= Date.now();
      if (Date.now() - since > 1000 * patience) throw error;
    } finally {
      clearTimeout(timer);
      signal.removeEventListener('abort', abort);
      cut.abort();
    }
    await new Promise((resolve) => setTimeout(resolve, untilBack));
  }
}

/** [id, event, data] of the events in a body. */
async function* linesOf(body, heard) {
  const reader = body.pipeThrough(new TextDecoderStream()).getReader();
  let text = '';
  for (;;) {
    const { done, value } = await reader.read();
    if (done) return;
    heard();
    text += value;
    const whole = text.split('\n\n');
    text = whole.pop();
    for (const one of whole) {
      const [, id, event, data] = /^id: (.*)\nevent: (.*)\ndata: (.*)$/.exec(one) ?? [];
      if (event) yield [id, event, JSON.parse(data)];
    }
  }
}
