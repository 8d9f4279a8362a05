import type { Exactly, Known, Of, Used } from '../page/exactly.js';
import type { GenerateTransitionRequest, GenerateTransitionResponse, GetServerInfoResponse as ServerInfo } from '../types/messages.js';
import type { Keyframe, KeyframeRejected, Pose, Skeleton, StreamDanceRequest, StreamDanceResponse } from '../types/messages.js';

// Messages are plain objects, named as in choreo/v1/choreography.proto, which the package contains. A message that you send may omit fields. A
// received message has all of them, except that of alternatives (a oneof) it has one: the compiler knows which after
// `if (answer.response === 'frames')` or `if (answer.frames)`. Integers of 64 bits are received as strings.
export * from '../types/messages.js';
export type { Exactly } from '../page/exactly.js';
export type { GetServerInfoResponse as ServerInfo } from '../types/messages.js';

/** The fields of a StreamDanceRequest, of which it has exactly one. */
export interface OneRequest extends Fields<StreamDanceRequest> {}
type Fields<S> = { [K in Known<S>]?: Of<S, K> | null };
/** No constraint if the compiler could not infer `T`: it then reports the mismatch with OneRequest. */
type Only<T> = [Empty<T>] extends [never] ? (OneRequest extends T ? unknown : Exactly<T, StreamDanceRequest>) : 'a request has one field';
type Empty<T> = T extends unknown ? ([Used<T>] extends [never] ? T : never) : never;

/** Credentials, timeouts and retries of a client. */
export interface ClientOptions {
  tls?: boolean;
  /** The certificate of the authority to trust, with `tls`: a PEM file or its text. Default: the authorities that Node.js trusts. */
  caCertificate?: string;
  /** The client's certificate and its key, with `tls`, if the server requires one: PEM files or their texts. */
  clientCertificate?: string;
  clientKey?: string;
  /** The name in the server's certificate, with `tls`. Default: the host name in its address. */
  serverName?: string;
  /** The token that the server requires, sent with each call. Requires `tls`, unless all addresses are on this machine. */
  token?: string;
  /** A file with the token, instead of `token`. It is read again for each call, so that the token can be renewed. */
  tokenFile?: string;
  /** The time limit for one attempt to connect to one address, seconds, above 0. Default 5. */
  connectTimeout?: number;
  /** Seconds after which a server that sends nothing, not even answers to pings, counts as lost. At least 2; 0: never. Default 5. */
  silence?: number;
  /**
   * Seconds for which to keep retrying since a call last made progress. Default 10. If a server asks for a longer wait than is left, the call
   * fails at once with an error that has the server's `retryAfter`. 0: no retries, so no resumption on another server either.
   */
  retry?: number;
  /** Seconds between the first attempts, doubled each time, up to 2. Default 0.1. */
  firstBackoff?: number;
}

export interface CallOptions {
  /** Ends the call, here and on the server, with a CANCELLED error whose `cause` is the signal's reason. */
  signal?: AbortSignal;
  /** The time by which the call, with all its attempts, must end: a date, or milliseconds since 1970. */
  deadline?: Date | number;
}

/** Reports that a dance has resumed on another server. */
export interface Resumed {
  address: string;
  /** The next frame to come, at the output rate. */
  frame: number;
  /**
   * False if the new server has another fingerprint, which config.allow_inexact_resume permitted. The dance then continues differently: smoothly
   * or, before the first continuation, with the new server's own frames.
   */
  exact: boolean;
  /** The failure of the previous server. */
  because: ChoreoError;
}

/**
 * A failed call, or an unusable option. The message is the server's, and names the field, the value and the limit. The field of one of several
 * requests is written like `requests[3].keyframe.time`.
 */
export class ChoreoError extends Error {
  private constructor();
  /** The name of a gRPC status code, such as 'INVALID_ARGUMENT'. */
  readonly code: string;
  /**
   * The invalid fields. `field` is a path in the message that you sent, such as 'keyframe.pose.rotations[48]'; for a rotation it names the first
   * number, and `joint` is the rotation's joint. `keyframeId` is the id of the affected key. `request` is the index of the affected request, from
   * 0, if it is known.
   */
  readonly violations: { field: string; description: string; keyframeId?: string; joint?: number; request?: number }[];
  /** Seconds after which a retry may succeed; absent if none would, or it is unknown. */
  readonly retryAfter?: number;
  /** The reason, for programs, such as 'DRAINING', 'SERVER_FULL' or, of this package's own refusals too, 'INVALID_VALUE'; absent if none is known. */
  readonly reason?: string;
}

/**
 * A client of one server or of several replicas. It connects when needed. If a server is lost, is full, or refuses a model or fingerprint, the
 * call is retried at the next address.
 */
export class ChoreoClient {
  /**
   * `addresses`: HOST:PORT or unix:PATH. Several addresses are replicas: if one fails, the next is tried. Calls are distributed in turn over the
   * addresses of one name (dns:///NAME:PORT) or one list (ipv4:A:PORT,B:PORT). Throws ChoreoError for unusable options.
   */
  constructor(addresses: string | string[], options?: ClientOptions);
  /** Ends all calls in progress with CANCELLED, and refuses further calls. */
  close(): void;

  /** Gets the server's models, limits and devices. `cards`: includes the models' cards, JSON of about 30 KB each. */
  info(options?: CallOptions & { cards?: boolean }): Promise<ServerInfo>;

  /**
   * Runs a dance. Sends the `requests` as fast as the server accepts them, and yields the answers meanwhile. `requests` may be an asynchronous
   * iterable, such as music that is being played. The dance ends if you stop reading.
   *
   * If its server is lost, the dance resumes on the next one from the last continuation, with exactly the answers of an uninterrupted dance; only
   * `onResume` reports it. The summary's shares then cover only the frames since the last resumption. Do not change requests after yielding
   * them, because they may be sent again.
   *
   * A request that is not valid in the API ends the dance with an error that names the field's path. With config.reject_invalid_keys, an invalid
   * key or removal of a key is answered by a keyframe_rejected instead, and the dance continues.
   *
   * A key that is too late, because later keys have made its frames final, is not danced. In addition to the event, `onRejected` is called;
   * without it, the process emits a KeyRejectedWarning.
   */
  streamDance<T extends OneRequest>(
    requests: Iterable<T & Only<T>> | AsyncIterable<T & Only<T>>,
    options?: CallOptions & { onResume?: (resumed: Resumed) => void; onRejected?: (rejected: KeyframeRejected) => void },
  ): AsyncGenerator<StreamDanceResponse, void, undefined>;

  /** Generates one transition, as one or several candidates. If its server is lost, another one repeats it; no answer is yielded twice. */
  generateTransition<T extends GenerateTransitionRequest>(
    request: T & Exactly<T, GenerateTransitionRequest>,
    options?: CallOptions,
  ): AsyncGenerator<GenerateTransitionResponse, void, undefined>;
}

/**
 * Makes a pose: the rest pose of `skeleton` with these `rotations`, {joint name: [x, y, z] in radians}. It is at `place`, [x, z] in metres, or,
 * without one, wherever the dancer is. Throws ChoreoError for joints that the skeleton lacks, and for invalid rotations.
 */
export function pose(
  skeleton: Pick<Skeleton, 'pelvis_height' | 'joint_names'>,
  rotations?: Record<string, [number, number, number]>,
  where?: { place?: [number, number] },
): Pose & { rotations: number[] };

/** A named pose of the skeleton smpl24. */
export interface LibraryPose {
  id: string;
  description: string;
  /** 'standing', 'travelling', 'jump' or 'floor'. */
  tags: string[];
  root_position: [number, number, number];
  /** An axis-angle vector for each joint, radians. */
  rotations: [number, number, number][];
}

/** The library's poses, sorted by name, which key files may name. */
export function poses(): LibraryPose[];

/**
 * Returns the library's pose of this name, for a Keyframe, turned by `facing` degrees. It is at `place`, [x, z] in metres, or, without one, wherever
 * the dancer is. `skeleton`: the model's, which must be smpl24. Throws ChoreoError. Warns on the console about a jump without a place, which is
 * danced standing on the floor.
 */
export function libraryPose(name: string, skeleton: Skeleton, where?: { place?: [number, number]; facing?: number }): Pose & { rotations: number[] };

/**
 * Reads the keys of a key file, given as its text or as the result of JSON.parse, as requests for streamDance. A held key becomes several keys. A
 * key without an id is called by its place in the file, from 1: "key2". The keys are in order of time, unless some have a time and others a frame.
 * Times must be in seconds: counts of a song ("9c") require its beats, which only the `choreo` program finds. Poses in numbers must be `rotations`.
 * Throws ChoreoError. Warns on the console about a jump without a place, which is danced standing on the floor, and about a hold that a key within
 * it ends half a second before itself.
 */
export function readKeys(file: string | Uint8Array | object, skeleton: Skeleton): { keyframe: Keyframe }[];
