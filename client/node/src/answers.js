// Calls of gRPC's as what is awaited. Whoever stops reading, or aborts the signal, ends them on the server too.
import { ChoreoError } from './error.js';

/** Has `signal` cancel a call. What this returns takes that back. */
function cancelOn(signal, call) {
  const cancel = () => call.cancel();
  signal.addEventListener('abort', cancel);
  if (signal.aborted) cancel();
  return () => signal.removeEventListener('abort', cancel);
}

/** The one answer of a call that `begin(callback)` begins. */
export async function answerOf(begin, signal) {
  let leave;
  try {
    return await new Promise((resolve, reject) => {
      leave = cancelOn(signal, begin((failure, answer) => (failure ? reject(new ChoreoError(failure)) : resolve(answer))));
    });
  } finally {
    leave?.();
  }
}

/** Yields the answers of a call. `find(violation)`: what was sent that an error is about, as ChoreoError.locate wants it. */
export async function* answersOf(call, signal, find) {
  const leave = cancelOn(signal, call);
  try {
    yield* call;
  } catch (failure) {
    throw new ChoreoError(failure).locate(find);
  } finally {
    leave();
    call.cancel();
  }
}
