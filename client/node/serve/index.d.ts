// For back ends: dances for web pages, over HTTP, as server-sent events. `connectDance` of choreo-client/page reads them.
import type { IncomingMessage, ServerResponse } from 'node:http';
import type { Http2ServerRequest, Http2ServerResponse } from 'node:http2';
import type { ChoreoClient, ChoreoError, Continuation, DanceConfig, Resumed, StreamDanceRequest } from '../src/index.js';

/** What to dance. */
export interface DanceOrder {
  /** Where it ends, at most an hour: how long it lasts, unless `config` begins it later, with a continuation or history.first_frame. */
  seconds: number;
  /**
   * The bytes of a WAV, FLAC, Ogg or MP3 file; or pieces of music while it sounds, `{ audio: { data } }`, of config.audio_format, as requests, among
   * which others may be. A piece should last a tenth of a second or less: what it waits for, she dances later. Frames are settled and keys answered
   * beside it, whether it comes or not. After `seconds` the dance is over and the music is closed, by its return(). Without music the dance is silent.
   */
  music?: Uint8Array | ArrayBuffer | Iterable<StreamDanceRequest> | AsyncIterable<StreamDanceRequest>;
  /** Seed, model, style and the like. frames, encoding, generate_until and reject_invalid_keys are refused: serveDance() sets them. */
  config?: DanceConfig & { frames?: undefined; encoding?: undefined; generate_until?: undefined; reject_invalid_keys?: undefined };
  /** Said before the dance begins: the keys of readKeys(), controls. */
  keys?: StreamDanceRequest[];
  /** Times as fast as time, until the page tells where it plays, which follow() does; default 1. */
  speed?: number;
}

/** What the callbacks throw the console hears of; the dance goes on. */
export interface ServeOptions {
  /** Where pages find it; default '/dance'. */
  path?: string;
  /** Other origins whose pages may ask, such as 'https://my.page', or '*'; default none. Their browsers' OPTIONS are answered. */
  origins?: string[];
  /** Seconds that a dance goes on without its page, whose connection may be lost; default 5. */
  away?: number;
  /** Bytes of each dance's latest events to keep for a page that comes back; default 8 MiB, some minutes. */
  keep?: number;
  /**
   * Seconds that a page may be behind before the dance waits for it; default 10. What the systems on the way have taken counts as read, 4 MB and more,
   * minutes of a dance: so this bounds what Node.js keeps. A page that follow()s tells when it pauses because frames are late.
   */
  behind?: number;
  /** Where the dance `id` may go on later, as config.continuation of another order: also kept as JSON. The newest replaces earlier ones. */
  onContinuation?: (continuation: Continuation, id: string) => void;
  /** A dance went on at another server. Pages hear no addresses. */
  onResume?: (resumed: Resumed) => void;
  /** A dance failed or, by a wrong order, did not begin; its page has been told. By default console.error says so. */
  onFailed?(error: Error & Partial<Pick<ChoreoError, 'code' | 'violations' | 'retryAfter'>>): void;
}

export interface DanceHandler {
  /**
   * Answers requests below `path`, with 404 and 405 for what is not there; false, with the response untouched, for all others. It never rejects: what it refuses has a status, its words as
   * text, and the header Choreo-Code where gRPC has a code for it. A page hears gRPC's code and the words where they name a field of the dance or of
   * its request, UNAVAILABLE or RESOURCE_EXHAUSTED where no server is free, and INTERNAL for all else, which onFailed hears in full. A body that a
   * framework has parsed is taken from request.body. Who may ask is for you to say, before this is called.
   *
   * - `GET /dance`: a new dance, as events; with the header Last-Event-ID the rest of that one, or 204 where that is gone or all was heard.
   *   `dance` {id, frame_rate, first_frame, skeleton}; `frames` {first, places: 3 numbers a frame, turns: 4 a joint}; `key` {id, time} or {id, refused, asked: its time, or null for a removal};
   *   `warning` {id, message}; `moved` {frame}: another server goes on; last `over` {frames} or `failed` {code, message, retry_after}.
   * - `POST /dance/ID/keys`: a key, as in a key file (docs/poses.md), {id, time, pose: 'kick'}, whose place may be 'here'; or {id, time, rotations: {head: [0, 0.4, 0]}}, which
   *   sets these joints alone. 202 with {id}, which a key without an id gets; a key that comes too late, or near another one, is refused by an event. The same id again moves a key.
   *   A key with a `hold` is one key in all of this; to the dance it is 5 a second, which are sent as they come near. A dance has 1000 keys,
   *   steps of holds included.
   * - `DELETE /dance/ID/keys/KEY`: takes it back, and its hold; once it is reached, the rest of its hold.
   * - `POST /dance/ID/clock`: {time, paused}, where the page plays. 202. Frames up to a second later are settled. A page that never tells it plays
   *   from its first frame on.
   * - `GET /dance/skeleton`: the body that dances.
   */
  (request: (IncomingMessage | Http2ServerRequest) & { body?: unknown }, response: ServerResponse | Http2ServerResponse): Promise<boolean>;
  /** Ends all its dances. */
  close(): void;
}

/**
 * Serves the dances of `client` to pages. `begin` says what to dance for a page that asks; an error of its own with a `status`, 401 say, is answered
 * with that. A dance whose server is lost goes on at another one of the client's, and its page misses no frame. Frames settle a second before
 * the page shows them, so that keys may come until shortly before. A page that is closed ends its dance.
 */
export function serveDance(
  client: ChoreoClient,
  begin: (url: URL, request: IncomingMessage | Http2ServerRequest) => DanceOrder | Promise<DanceOrder>,
  options?: ServeOptions,
): DanceHandler;
