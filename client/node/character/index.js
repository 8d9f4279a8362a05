export { Character, smplPoses } from './character.js';
export { Player } from './player.js';
export { bonesOf, gltfBones } from './rig.js';
