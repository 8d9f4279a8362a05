// Refusals of a page's requests, as HTTP statuses.

export class Refusal extends Error {
  constructor(status, message, code) {
    super(message);
    this.status = status;
    this.code = code; // gRPC's, if any
  }
}

const statuses = { INVALID_ARGUMENT: 400, RESOURCE_EXHAUSTED: 503, UNAVAILABLE: 503 };

/** Converts an error for a page: errors in its request in full, errors of the back end without details. */
export function refusalOf(error) {
  if (error.status >= 400 && error.status < 600) return error;
  const status = statuses[error.code];
  if (status === 400 || error instanceof URIError) return new Refusal(400, error.message, status && error.code);
  return new Refusal(status ?? 500, status ? 'no server is free now; try again' : 'this went wrong here', status && error.code);
}
