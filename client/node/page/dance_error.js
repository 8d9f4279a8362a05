// What goes wrong on a page.

/** See index.d.ts. Names a refusal's HTTP `status`, or gRPC's `code`, or both. */
export class DanceError extends Error {
  name = 'DanceError';

  constructor(message, { cause, ...named } = {}) {
    super(message, { cause });
    Object.assign(this, named);
  }

  /** A back end's refusal. */
  static async by(response) {
    const [code, wait] = ['choreo-code', 'retry-after'].map((name) => response.headers.get(name) ?? undefined);
    const message = (await response.text()).trim() || `status ${response.status}`;
    return new DanceError(message, { status: response.status, code, retryAfter: wait && Number(wait) });
  }

  /** An error as this one: a lost connection, unless it is one already. */
  static of(error) {
    return error instanceof DanceError ? error : new DanceError(`${error?.message ?? error}`, { code: 'UNAVAILABLE', cause: error });
  }
}
