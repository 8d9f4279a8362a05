// What the types of the messages let through, and what they do not.
import type { Request } from './transition.js';

// @ts-expect-error: seeds have 64 bits
export const numberSeed: Request = { config: { seed: 1 } };
// @ts-expect-error: no such field
export const unknownField: Request = { frames: 30, candidate: 2 };
export const good: Request = { config: { seed: 1n }, frames: 30, candidates: 2 };
