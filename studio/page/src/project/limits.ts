// The program's limits and constants, from its first message.
import type { Limits } from '../generated/studio/studio_pb';

export let limits: Limits;
export const setLimits = (received: Limits) => (limits = received);
