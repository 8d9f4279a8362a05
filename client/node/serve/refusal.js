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

/**
 * Converts an error for a page: errors in its request in full, errors of the back end, such as a token that the server refuses, without details.
 * Errors with a `status` are the back end's own words for pages.
 */
export function refusalOf(error) {
  if (error.status >= 400 && error.status < 600) return error;
  const { code, message, retryAfter } = error;
  if (error instanceof URIError) return new Refusal(400, message);
  if (code === 'INVALID_ARGUMENT' && !isOfOptions(error)) return new Refusal(400, message, code);
  if (code === 'RESOURCE_EXHAUSTED' || code === 'UNAVAILABLE') return new Refusal(503, 'no server is free now; try again', code, retryAfter);
  return new Refusal(500, 'this went wrong here', 'INTERNAL');
}
