// What a web app's back end needs to talk to a choreod: its two streaming calls as async generators, which can be cancelled, and errors
// that name the field. Messages are plain objects, named as in proto/choreo/v1/choreography.proto.
import { join } from 'node:path';
import { Readable } from 'node:stream';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';
import grpc from '@grpc/grpc-js';
import protoLoader from '@grpc/proto-loader';
import protobuf from 'protobufjs';

const protoFolder = fileURLToPath(new URL('../../proto', import.meta.url));

const { choreo } = grpc.loadPackageDefinition(
  protoLoader.loadSync('choreo/v1/choreography.proto', {
    includeDirs: [protoFolder],
    keepCase: true, // errors name fields as the proto does
    longs: String, // a seed has 64 bits, a number only 53
    enums: String,
    defaults: true,
    oneofs: true, // answer.response names what an answer holds
  }),
);

const rpc = new protobuf.Root();
rpc.resolvePath = (_, file) => join(protoFolder, file);
rpc.loadSync(['google/rpc/status.proto', 'google/rpc/error_details.proto']);

/** A failed call: `code` as in 'INVALID_ARGUMENT', the server's words, and what it names. */
export class ChoreoError extends Error {
  constructor(failure) {
    super(failure.details || failure.message);
    this.code = grpc.status[failure.code] ?? 'UNKNOWN';
    /** [{field: 'keyframes[0].rotations', description: 'keyframes[0].rotations: 69 numbers, ...'}] */
    this.violations = [];
    /** Try again after so many seconds, where that may help. */
    this.retryAfter = undefined;
    for (const bytes of failure.metadata?.get('grpc-status-details-bin') ?? []) this.#read(bytes);
  }

  #read(bytes) {
    for (const { type_url, value } of rpc.lookupType('google.rpc.Status').decode(bytes).details) {
      const type = type_url.split('/').pop();
      if (type === 'google.rpc.BadRequest') {
        this.violations.push(...rpc.lookupType(type).decode(value).fieldViolations);
      } else if (type === 'google.rpc.RetryInfo') {
        this.retryAfter = Number(rpc.lookupType(type).decode(value).retryDelay.seconds);
      }
    }
  }
}

/** Yields the answers of a call. Whoever stops reading, or aborts the signal, ends it on the server too. */
async function* answersOf(call, signal) {
  const cancel = () => call.cancel();
  signal?.addEventListener('abort', cancel);
  if (signal?.aborted) cancel();
  try {
    yield* call;
  } catch (failure) {
    throw new ChoreoError(failure);
  } finally {
    signal?.removeEventListener('abort', cancel);
    cancel();
  }
}

export class ChoreoClient {
  #stub;

  constructor(address, credentials = grpc.credentials.createInsecure()) {
    this.#stub = new choreo.v1.Choreography(address, credentials);
  }

  close() {
    this.#stub.close();
  }

  /** Models, limits, devices. */
  info() {
    return new Promise((resolve, reject) => {
      this.#stub.GetServerInfo({}, (failure, answer) => (failure ? reject(new ChoreoError(failure)) : resolve(answer)));
    });
  }

  /**
   * Dances. Sends the `requests`, an iterable that may be asynchronous (music that is being played, say), as fast as the server takes them,
   * and yields the answers meanwhile. `deadline` is a Date.
   */
  async *streamDance(requests, { signal, deadline } = {}) {
    const call = this.#stub.StreamDance(new grpc.Metadata(), { deadline });
    const source = Readable.from(requests);
    let failure;
    source.on('error', (error) => {
      failure = error;
      call.cancel();
    });
    source.pipe(call);
    try {
      yield* answersOf(call, signal);
    } catch (error) {
      throw failure ?? error;
    } finally {
      source.destroy();
    }
  }

  /** One transition, in one or several candidates. */
  async *generateTransition(request, { signal, deadline } = {}) {
    yield* answersOf(this.#stub.GenerateTransition(request, new grpc.Metadata(), { deadline }), signal);
  }
}

/** The body of `skeleton` standing at rest, where and however `rotations` ({joint name: [x, y, z] in radians}) turn it. */
export function pose(skeleton, rotations = {}, { x = 0, z = 0 } = {}) {
  return {
    root_position: { x, y: skeleton.pelvis_height, z },
    rotations: skeleton.joint_names.flatMap((joint) => rotations[joint] ?? [0, 0, 0]),
  };
}

/** A number above 0 out of a program's options. */
export function positive(options, name) {
  const number = Number(options[name]);
  if (number > 0 && Number.isFinite(number)) return number;
  throw Object.assign(new Error(`${options[name]} is not a number above 0`), { code: `--${name}` });
}

/** A whole number from `least` to `most` out of a program's options, as text: a seed has 64 bits. */
export function whole(options, name, least = 0n, most = 2n ** 64n - 1n) {
  const text = options[name];
  if (/^\d{1,20}$/.test(text) && BigInt(text) >= least && BigInt(text) <= most) return text;
  throw Object.assign(new Error(`${text} is not a whole number from ${least} to ${most}`), { code: `--${name}` });
}

/** Runs a program with options as node:util's parseArgs has them: Ctrl-C cancels, errors are shown with the fields that they name. */
export async function run(options, main) {
  const stop = new AbortController();
  process.once('SIGINT', () => stop.abort());
  try {
    await main(parseArgs({ options }).values, stop.signal);
  } catch (error) {
    if (error.path) console.error(error.message); // of a file, with its code
    else console.error(error.code ? `${error.code}: ${error.message}` : error);
    for (const { field } of error.violations ?? []) console.error(`  field: ${field}`);
    if (error.retryAfter) console.error(`  try again in ${error.retryAfter} s`);
    process.exitCode = 1;
  }
}
