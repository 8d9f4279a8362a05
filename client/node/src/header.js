// What the header of an answer means to who goes on elsewhere.
import grpc from '@grpc/grpc-js';
import { ChoreoError } from './error.js';

/** Where the first output frame stands that is not before the first frame. */
export function firstOutputFrame({ first_frame, frame_rate, model_frame_rate }) {
  return Math.ceil((Number(first_frame) * frame_rate) / model_frame_rate - 1e-9);
}

/**
 * A server of another fingerprint makes other frames; another one may do better. The field is the one that servers name. `remedy`: what would
 * let it be.
 */
export function requireSameFingerprint(begun, header, address, remedy = '') {
  if (header.fingerprint === begun) return;
  const field = 'config.continuation.fingerprint';
  const description = `begun by "${begun}"; ${address} has "${header.fingerprint}"${remedy}`;
  throw new ChoreoError({ code: grpc.status.FAILED_PRECONDITION, details: `${field}: ${description}` }, [{ field, description }]);
}
