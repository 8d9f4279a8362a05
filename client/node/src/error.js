// What may go wrong, and when it is worth while to try again.
import grpc from '@grpc/grpc-js';
import { asSent } from './as_sent.js';
import { rpc } from './protos.js';

/** A failed call: `code` as in 'INVALID_ARGUMENT', the server's words, and what it names. */
export class ChoreoError extends Error {
  /** `failure`: of gRPC, or made here: {code, details}. */
  constructor(failure, violations = []) {
    super(failure.details || failure.message || 'the server failed without saying why');
    this.name = 'ChoreoError';
    this.code = grpc.status[failure.code] ?? 'UNKNOWN';
    /** [{field: 'keyframe.pose.rotations', description: '69 numbers are 23 joints; ...', keyframeId: 'arms up'}] */
    this.violations = violations;
    /** Try again after so many seconds, where that may help. */
    this.retryAfter = undefined;
    for (const bytes of failure.metadata?.get('grpc-status-details-bin') ?? []) this.#read(bytes);
  }

  /**
   * Names what callers have sent. `find(violation)`: {message, request}, the message and, of several, its number, where that is known.
   * `name(field, message)`: what to call a field.
   */
  locate(find, name = asSent) {
    for (const violation of this.violations) {
      const { message, request } = find(violation);
      Object.assign(violation, name(violation.field, message), request !== undefined && { request });
      const place = request === undefined || violation.field.startsWith('requests[') ? '' : `requests[${request}].`;
      // The server's words name its own list of keys.
      if (this.message.endsWith(`: ${violation.description}`)) this.message = `${place}${violation.field}: ${violation.description}`;
    }
    return this;
  }

  #read(bytes) {
    let key;
    for (const { type_url, value } of rpc.lookupType('google.rpc.Status').decode(bytes).details) {
      const type = type_url.split('/').pop();
      if (type === 'google.rpc.ErrorInfo') {
        const { keyframe_id: keyframeId } = rpc.lookupType(type).decode(value).metadata;
        key = keyframeId && { keyframeId };
      } else if (type === 'google.rpc.BadRequest') {
        const { fieldViolations } = rpc.lookupType(type).decode(value);
        this.violations.push(...fieldViolations.map(({ field, description }) => ({ field, description, ...key })));
      } else if (type === 'google.rpc.RetryInfo') {
        const { seconds, nanos } = rpc.lookupType(type).decode(value).retryDelay;
        this.retryAfter = Number(seconds) + 1e-9 * nanos;
      }
    }
  }
}

export function unavailable(details) {
  return new ChoreoError({ code: grpc.status.UNAVAILABLE, details });
}

export function cancelled(details = 'the call was cancelled') {
  return new ChoreoError({ code: grpc.status.CANCELLED, details });
}

/** Of an option of ours; named as the server names its fields. */
export function invalid(field, what) {
  return new ChoreoError({ code: grpc.status.INVALID_ARGUMENT, details: `${field}: ${what}` }, [{ field, description: what }]);
}

/** What another replica may have been started with. */
const ofTheReplica = ['config.model', 'config.continuation.fingerprint', 'config.continuation.skeleton'];

/**
 * How a call that failed may be tried again: `here`, at the same server; `elsewhere`, at another one; after `wait` seconds at least. A server
 * that is away or full may be asked again. One that broke, is of another fingerprint or lacks the model would fail again, but another one
 * may do better. Anything else fails everywhere.
 */
export function adviceFor(error) {
  const here = error.retryAfter !== undefined || (error.code === 'UNAVAILABLE' && !error.isOfTheCaller);
  const broken = error.code === 'INTERNAL' || error.code === 'UNKNOWN';
  return { here, elsewhere: here || broken || error.isOfTheCaller || ofTheReplica.includes(error.violations[0]?.field), wait: error.retryAfter ?? 0 };
}
