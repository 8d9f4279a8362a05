// Errors, and when to retry.
import grpc from '@grpc/grpc-js';
import { asSent } from './as_sent.js';
import { rpc } from './protos.js';

/** What went wrong, in words. gRPC's own of a deadline say how it spent the time, for those who know its parts. */
function wordsOf({ details, message }) {
  if (/^Deadline exceeded/.test(details)) return 'the deadline passed before the end of the call';
  return details || message || 'the server failed without saying why';
}

/** A failed call: a `code` such as 'INVALID_ARGUMENT', the server's message, and the fields that it names. */
export class ChoreoError extends Error {
  /** `failure`: {code, details}, from gRPC or this package. */
  constructor(failure, violations = []) {
    super(wordsOf(failure));
    this.name = 'ChoreoError';
    this.code = grpc.status[failure.code] ?? 'UNKNOWN';
    /** [{field: 'keyframe.pose.rotations', description: '69 numbers are 23 joints; ...', keyframeId: 'arms up'}] */
    this.violations = violations;
    /** Seconds after which a retry may succeed; undefined if none would, or it is unknown. */
    this.retryAfter = undefined;
    /** Why, in a word for programs: 'DRAINING', 'SERVER_FULL', ...; of this package's own refusals 'INVALID_VALUE'; undefined where nobody said it. */
    this.reason = undefined;
    for (const bytes of failure.metadata?.get('grpc-status-details-bin') ?? []) this.#read(bytes);
  }

  /**
   * Translates fields to those that the caller sent. `find(violation)` returns {message, request}: the sent message and, if it is one of several
   * and known, its index. `name(field, message)` returns {field, joint}.
   */
  locate(find, name = asSent) {
    for (const violation of this.violations) {
      const { message, request } = find(violation);
      Object.assign(violation, name(violation.field, message), request !== undefined && { request });
      const place = request === undefined || violation.field.startsWith('requests[') ? '' : `requests[${request}].`;
      // The server's message names fields in its own numbering.
      if (this.message.endsWith(`: ${violation.description}`)) this.message = `${place}${violation.field}: ${violation.description}`;
    }
    return this;
  }

  #read(bytes) {
    let key;
    for (const { type_url, value } of rpc.lookupType('google.rpc.Status').decode(bytes).details) {
      const type = type_url.split('/').pop();
      if (type === 'google.rpc.ErrorInfo') {
        const { reason, metadata } = rpc.lookupType(type).decode(value);
        this.reason = reason;
        key = metadata.keyframe_id && { keyframeId: metadata.keyframe_id };
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

/** Makes the error for an invalid option or field, in the form of the server's errors. */
export function invalid(field, what) {
  const error = new ChoreoError({ code: grpc.status.INVALID_ARGUMENT, details: `${field}: ${what}` }, [{ field, description: what }]);
  return Object.assign(error, { reason: 'INVALID_VALUE' }); // as servers say
}

/** Fields that another replica may accept, because it was started with other models. */
const ofTheReplica = ['config.model', 'config.continuation.fingerprint', 'config.continuation.skeleton'];

/**
 * Returns how to retry a failed call: `here`, on the same server; `elsewhere`, on another one; after at least `wait` seconds. An unreachable or
 * full server may be tried again. A server that broke, has another fingerprint or lacks the model would fail again, but another one may
 * succeed. Any other failure would recur everywhere.
 */
export function adviceFor(error) {
  const here = error.retryAfter !== undefined || (error.code === 'UNAVAILABLE' && !error.isOfTheCaller);
  const broken = error.code === 'INTERNAL' || error.code === 'UNKNOWN';
  return { here, elsewhere: here || broken || error.isOfTheCaller || ofTheReplica.includes(error.violations[0]?.field), wait: error.retryAfter ?? 0 };
}
