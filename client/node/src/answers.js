// Wraps gRPC calls as promises and async generators. Stopping to read, or aborting the signal, also ends the call on the server.
import { ChoreoError } from './error.js';

/** Makes `signal` cancel a call. Returns a function that undoes this. */
function cancelOn(signal, call) {
  const cancel = () => call.cancel();
  signal.addEventListener('abort', cancel);
  if (signal.aborted) cancel();
  return () => signal.removeEventListener('abort', cancel);
}

/** Returns the only answer of the call that `begin(callback)` starts. */
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

/** Yields the answers of a call. `find(violation)`: finds the sent message that an error is about, for ChoreoError.locate. */
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
