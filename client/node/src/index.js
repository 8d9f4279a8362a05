// The public API; index.d.ts documents it.
export { ChoreoClient } from './client.js';
export { ChoreoError } from './error.js';
export { libraryPose, readKeys } from './keys.js';
export { pose } from './pose.js';
export { poses } from './poses.js';
