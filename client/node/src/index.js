// Talks to a choreod. index.d.ts says how.
export { ChoreoClient } from './client.js';
export { ChoreoError } from './error.js';
export { libraryPose, readKeys } from './keys.js';
export { pose } from './pose.js';
export { poses } from './poses.js';
