import type { GenerateTransitionRequest, GenerateTransitionResponse, GetServerInfoResponse as ServerInfo } from '../types/messages.js';
import type { Keyframe, KeyframeRejected, Pose, Skeleton, StreamDanceRequest, StreamDanceResponse } from '../types/messages.js';

// Messages are plain objects, named as in choreo/v1/choreography.proto, which the package brings along. What is sent may leave out fields;
// what comes has all of them, yet of alternatives one: after `if (answer.response === 'frames')`, or `if (answer.frames)`, the compiler knows
// it. Numbers of 64 bits come as text.
export * from '../types/messages.js';
export type { GetServerInfoResponse as ServerInfo } from '../types/messages.js';

type Plain = string | number | bigint | boolean | symbol | null | undefined | ArrayBuffer | ArrayBufferView | readonly unknown[] | { low: number; high: number };
type Known<S> = S extends unknown ? keyof S : never;
type Used<T> = { [K in keyof T]-?: [NonNullable<T[K]>] extends [never] ? never : K }[keyof T];
/** Those of the alternatives `S` that have all that is used of `T`. */
type Fitting<T, S> = S extends unknown ? (Used<T> extends Used<S> ? S : never) : never;
type Of<S, K extends PropertyKey> = S extends unknown ? (K extends keyof S ? NonNullable<S[K]> : never) : never;
/** `K`, where one of the alternatives lacks it. */
type Lacking<S, K> = S extends unknown ? (K extends Used<S> ? never : K) : never;
/** What to say of a field that does not fit. */
type Misfit<S, K> = K extends Known<S> ? ([Lacking<S, K>] extends [never] ? unknown : 'another field of this message excludes this one') : `there is no field ${K & string}`;
/**
 * A message of type `S` with the fields of `T`; those that `S` does not know, or that exclude one another, are of a type that says so: the compiler
 * looks for them in literals alone, and not in what a generator yields.
 */
export type Exactly<T, S> = T extends Plain
  ? T
  : [Fitting<T, S>] extends [never]
    ? { [K in keyof T]: Misfit<S, K> }
    : { [K in keyof T]: Exactly<T[K], Of<Fitting<T, S>, K>> };

/** What a StreamDanceRequest may hold: one of these. */
export interface OneRequest extends Fields<StreamDanceRequest> {}
type Fields<S> = { [K in Known<S>]?: Of<S, K> | null };
/** Nothing where the compiler has given up on `T`: what is wrong with OneRequest is told. */
type Only<T> = OneRequest extends T ? unknown : Exactly<T, StreamDanceRequest>;

/** How to reach the servers, and how patiently. */
export interface ClientOptions {
  tls?: boolean;
  /** PEM file, or its text, of the authority to trust, with `tls`; default: those that Node.js trusts. */
  caCertificate?: string;
  /** PEM files, or their texts, of a certificate and its key, with `tls`, where the server wants to see one. */
  clientCertificate?: string;
  clientKey?: string;
  /** Whose certificate the server must have, with `tls`; default: the one of its address. */
  serverName?: string;
  /** The token that the server wants, sent with each call. Needs `tls`, unless all addresses are of this machine. */
  token?: string;
  /** The file of it instead, read again for each call, so that it can be renewed. */
  tokenFile?: string;
  /** Seconds for one attempt at one address; default 5. */
  connectTimeout?: number;
  /** A server of which nothing is heard for so many seconds, not even the answer to a ping, is lost; at least 2, or 0: never. Default 5. */
  silence?: number;
  /**
   * Seconds to try again and again since a call last made progress; default 10. A server that asks to wait longer than is left is not waited
   * for: the error has its `retryAfter`. 0: not at all, so nothing goes on elsewhere.
   */
  retry?: number;
  /** Seconds between tries, doubled with each, up to 2; default 0.1. */
  firstBackoff?: number;
}

export interface CallOptions {
  /** Ends the call, here and on the server, with CANCELLED, whose `cause` is the signal's reason. */
  signal?: AbortSignal;
  /** When the call must be over, all its attempts together: a date, or milliseconds since 1970. */
  deadline?: Date | number;
}

/** A dance went on at another server. */
export interface Resumed {
  address: string;
  /** The next frame to come, at the output rate. */
  frame: number;
  /**
   * False: of another fingerprint, which config.allow_inexact_resume let through; the dance goes on, yet not as it would have: smoothly, or,
   * before the first continuation, with the frames that the other server has for it.
   */
  exact: boolean;
  /** Why the other server was left. */
  because: ChoreoError;
}

/**
 * A failed call, or an option that cannot be used. The message is the server's, and names field, value and limit: of one of several requests as
 * `requests[3].keyframe.time`.
 */
export class ChoreoError extends Error {
  private constructor();
  /** As in 'INVALID_ARGUMENT'. */
  readonly code: string;
  /**
   * What is wrong: the field's path in the message that was sent, as in 'keyframe.pose.rotations[48]'; of a rotation its first number, and its
   * `joint`; the key that it is of; and, where it is known, which of the `requests` it is in, from 0.
   */
  readonly violations: { field: string; description: string; keyframeId?: string; joint?: number; request?: number }[];
  /** Try again after so many seconds, where that may help. */
  readonly retryAfter?: number;
}

/**
 * A client of one server or of several replicas. Connections are made when needed. A call whose server is lost, is full or refuses a model or
 * fingerprint is tried at the next address.
 */
export class ChoreoClient {
  /**
   * `addresses`: HOST:PORT, unix:PATH or several of them, which are replicas: when one fails the next is asked. Calls take turns at the
   * addresses of one name (dns:///NAME:PORT), or of one list (ipv4:A:PORT,B:PORT). Throws ChoreoError for options that cannot be used.
   */
  constructor(addresses: string | string[], options?: ClientOptions);
  /** Ends its calls with CANCELLED, and refuses others. */
  close(): void;

  /** Models, limits, devices. `cards`: with the models' cards, JSON of some 30 KB each. */
  info(options?: CallOptions & { cards?: boolean }): Promise<ServerInfo>;

  /**
   * Dances. Sends the `requests`, an iterable that may be asynchronous (music that is being played, say), as fast as the server takes them,
   * and yields the answers meanwhile. Whoever stops reading ends the dance. When its server is lost, the dance goes on at the next one from
   * the last continuation: answers are those of an undisturbed dance, bit for bit, which `onResume` alone hears of. Requests must not be
   * changed once they are said: they may be said again. One that the API does not know ends the dance, naming the field's path; of a
   * key or its removal, with config.reject_invalid_keys, it is a keyframe_rejected, and the dance goes on. (The summary's shares are those
   * of the frames since the last resume.)
   *
   * A key that comes too late, after later ones have settled its frames, is not danced. `onRejected` hears of it, beside the event; without it
   * the process is warned, by a KeyRejectedWarning.
   */
  streamDance<T extends OneRequest>(
    requests: Iterable<T & Only<T>> | AsyncIterable<T & Only<T>>,
    options?: CallOptions & { onResume?: (resumed: Resumed) => void; onRejected?: (rejected: KeyframeRejected) => void },
  ): AsyncGenerator<StreamDanceResponse, void, undefined>;

  /** One transition, in one or several candidates. When its server is lost, another one makes it again; nothing is told twice. */
  generateTransition<T extends GenerateTransitionRequest>(
    request: T & Exactly<T, GenerateTransitionRequest>,
    options?: CallOptions,
  ): AsyncGenerator<GenerateTransitionResponse, void, undefined>;
}

/**
 * The body of `skeleton` at rest, but for `rotations`, {joint name: [x, y, z] in radians}: wherever the dancer is, or, with `place`, at [x, z] in
 * metres. Throws ChoreoError for joints that it lacks, and what is no rotation.
 */
export function pose(
  skeleton: Pick<Skeleton, 'pelvis_height' | 'joint_names'>,
  rotations?: Record<string, [number, number, number]>,
  where?: { place?: [number, number] },
): Pose & { rotations: number[] };

/** A pose that has a name, of smpl24. */
export interface LibraryPose {
  id: string;
  description: string;
  /** 'standing', 'travelling', 'jump' or 'floor'. */
  tags: string[];
  root_position: [number, number, number];
  /** An axis-angle vector of each joint. */
  rotations: [number, number, number][];
}

/** The poses that key files may name, by name. */
export function poses(): LibraryPose[];

/**
 * The library's pose of this name, for a Keyframe: wherever the dancer is, or, with `place`, at [x, z] in metres; turned by `facing` degrees.
 * `skeleton`: the model's, smpl24. Throws ChoreoError. A jump without a place stands: the console is told.
 */
export function libraryPose(name: string, skeleton: Skeleton, where?: { place?: [number, number]; facing?: number }): Pose & { rotations: number[] };

/**
 * The keys of a key file, its text or what JSON.parse has made of it, as requests of streamDance. A key that is held becomes several. They come
 * in order, unless some say their time and others their frame. Times are seconds: counts of a song ("9c") need its beats, which `choreo` finds. Poses in numbers are
 * `rotations`. Throws ChoreoError. Of a jump without a place, which stands, the console is told.
 */
export function readKeys(file: string | Uint8Array | object, skeleton: Skeleton): { keyframe: Keyframe }[];
