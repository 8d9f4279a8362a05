// Refusals of a page's requests, as HTTP statuses.
import { isOfOptions } from '../src/options.js';

export class Refusal extends Error {
  constructor(status, message, code, retryAfter) {
    super(message);
    this.status = status;
    this.code = code; // gRPC's, if any
    this.retryAfter = retryAfter; // seconds, if known
  }
}

/** The field of a server's error that names servers, which pages need not know. */
const ofServers = 'config.continuation.fingerprint';

/**
 * Converts an error for a page. An error that names a field of the dance or of the page's request keeps its code and words. All others, such as a
 * token that the server refuses, are the back end's: INTERNAL, without details. Errors with a `status` are the back end's own words for pages.
 */
export function refusalOf(error) {
  const { status, code, message, retryAfter, violations } = Object(error); // anything may be thrown
  if (Number.isInteger(status) && status >= 400 && status < 600) return error;
  if (error instanceof URIError) return new Refusal(400, message);
  if (code === 'RESOURCE_EXHAUSTED' || code === 'UNAVAILABLE') return new Refusal(503, 'no server is free now; try again', code, retryAfter);
  const [fault] = violations ?? [];
  // Without the number of the back end's request.
  if (fault && fault.field !== ofServers && !isOfOptions(error)) return new Refusal(400, `${fault.field}: ${fault.description}`, code);
  return new Refusal(500, 'this went wrong here', 'INTERNAL');
}
