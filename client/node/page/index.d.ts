// For pages: a dance of serveDance() in choreo-client/serve, while it is made. Without any dependency; it works in Node.js, too.
import type { Character, Hands, Shown, Smpl } from '../character/index.js';
import type { Exactly } from './exactly.js';

/** Describes the dance when it begins. */
export interface DanceHeader {
  id: string;
  frame_rate: number;
  /** The first frame to come: not 0 where the dance goes on from a continuation, or from later poses. */
  first_frame: number;
  skeleton: Smpl;
}

/** Where, how long and how hard a pose is taken, and what the hands do from then on. */
interface Taken {
  place?: [number, number] | 'here';
  facing?: number;
  hold?: number;
  hit?: number;
  hands?: Hands;
}

/** Degrees by joint, as in key files (docs/poses.md): the bend of a knee or elbow, or turns about x, y and z. */
type Degrees = Record<string, number | [number, number, number]>;

/**
 * A library pose by name, of which `joints` names those to set or turns some; the degrees of some joints; or rotation vectors of some, [x, y, z] in
 * radians. Without a `place` it is taken wherever the dancer is, a jump standing; 'here' is where she is when the key arrives. A pose that is held for `hold` seconds, within the dance, is one key until its end; a key
 * within a hold ends it half a second before itself, and onWarning says so.
 */
export type KeyPose =
  | ({ pose: string; joints?: string[] | Degrees; rotations?: undefined } & Taken)
  | ({ joints: Degrees; pose?: undefined; rotations?: undefined } & Taken)
  | { rotations: Record<string, [number, number, number]>; pose?: undefined };

/** A key was reached at `time`, or what was asked for is not done for the reason `refused`: a key that was to move stands where it was. */
export interface KeyNews {
  id: string;
  time?: number;
  refused?: string;
}

/** A key, and when it is to be reached. */
export type KeyRequest = KeyPose & { id?: string; time?: number };

/**
 * What goes wrong, with the HTTP `status` of a back end that refuses (such as 401), or a `code` of gRPC: UNAVAILABLE where no connection is had,
 * NOT_FOUND for a dance that the back end has forgotten, FAILED_PRECONDITION for a key after the end, CANCELLED after close().
 */
export class DanceError extends Error {
  private constructor();
  readonly status?: number;
  readonly code?: string;
  /** Try again after so many seconds, where that may help. */
  readonly retryAfter?: number;
}

export interface ConnectOptions {
  /** Sent with each request: of a login, say. */
  headers?: Record<string, string>;
  /** Seconds to ask for the rest of a dance whose connection is lost; default 10. */
  patience?: number;
  /** Instead of the page's own. */
  fetch?: typeof fetch;
  // What these throw the page's console hears of; the dance goes on.
  onKey?: (news: KeyNews) => void;
  /** A key is not danced as it looks: a jump without a `place`, say, stands on the floor. */
  onWarning?: (warning: { id?: string; message: string }) => void;
  /** The back end's server was lost; another one goes on from this frame, and none is missing. */
  onMoved?: (moved: { frame: number }) => void;
  /** The connection is lost; the rest is asked for. */
  onLost?: (error: DanceError) => void;
  /** All has come, or nothing more will, because of `error`. */
  onEnd?: (error?: DanceError) => void;
}

export interface PageDance {
  /** Rejects with a DanceError where the dance does not begin. */
  readonly begun: Promise<DanceHeader>;
  /** No more frames will come. */
  readonly over: boolean;
  /**
   * From now on `at` gives poses of this character, made with the header's skeleton; without one, or without this call, those of SMPL's own joints.
   * It may change while the dance goes on. Throws before the dance has begun.
   */
  wear(character?: Character): void;
  /** What to show at a time of the dance: character.show(dance.at(seconds).pose, objects). */
  at(seconds: number): Shown;
  /**
   * The same at an <audio> element's time, or by a clock of its own: it starts when some poses are there, and waits where they are late. Call it for
   * each picture. It tells the back end where the page plays, so a dance waits while you pause the element. It plays only what it has paused itself:
   * an element that you pause stays paused until you play it. An element before the dance's first frame is set to it. Begin in a click: browsers
   * play no sound before one.
   */
  follow(audio?: { currentTime: number; readonly paused: boolean; readonly ended: boolean; play(): unknown; pause(): void }): Shown;
  /** The earliest time for a new key: not settled, and a second from this page's keys that are still to come. */
  soon(): number;
  /**
   * Requests a key, at `soon()` if it has no time, and resolves to the request. The same id again moves the key, with its hold. Rejects with a
   * DanceError for what is no key, or is after the dance's end. A key that comes too late reaches onKey as refused. undefined is as good as left out.
   */
  setKey<K extends KeyRequest>(key: K & Exactly<K, KeyRequest>): Promise<K & { id: string; time: number }>;
  /** Takes a key back, with its hold; once it is reached, the rest of its hold. */
  removeKey(id: string): Promise<void>;
  /** Leaves the dance, which ends on its servers, too. */
  close(): void;
}

/** Begins a dance at the path of a serveDance(), with whatever query that understands. */
export function connectDance(url: string | URL, options?: ConnectOptions): PageDance;
