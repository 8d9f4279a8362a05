// Interprets an answer's header for a call that is resumed on another server.
import grpc from '@grpc/grpc-js';
import { ChoreoError } from './error.js';

/** The first output frame at or after the first frame. */
export function firstOutputFrame({ first_frame, frame_rate, model_frame_rate }) {
  return Math.max(0, Math.ceil((Number(first_frame) * frame_rate) / model_frame_rate - 1e-9)); // and no -0
}

/**
 * Throws for a server of another fingerprint, which would generate other frames; another server may have the right one. The error's field is the
 * one that servers name. `remedy`: how to permit it, for the message.
 */
export function requireSameFingerprint(begun, header, address, remedy = '') {
  if (header.fingerprint === begun) return;
  const field = 'config.continuation.fingerprint';
  const description = `begun by "${begun}"; ${address} has "${header.fingerprint}"${remedy}`;
  throw new ChoreoError({ code: grpc.status.FAILED_PRECONDITION, details: `${field}: ${description}` }, [{ field, description }]);
}
