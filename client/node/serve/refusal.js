// What a page asked for that it does not get, and why, as HTTP has it.

export class Refusal extends Error {
  constructor(status, message, code) {
    super(message);
    this.status = status;
    this.code = code; // of gRPC, where there is one
  }
}

const statuses = { INVALID_ARGUMENT: 400, RESOURCE_EXHAUSTED: 503, UNAVAILABLE: 503 };

/** What to tell strangers of an error: of what is theirs all, of what is ours little. */
export function refusalOf(error) {
  if (error.status >= 400 && error.status < 600) return error;
  const status = statuses[error.code];
  if (status === 400 || error instanceof URIError) return new Refusal(400, error.message, status && error.code);
  return new Refusal(status ?? 500, status ? 'no server is free now; try again' : 'this went wrong here', status && error.code);
}
