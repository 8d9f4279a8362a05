// Writes the mannequin, which its package holds as text.
//   node unpack.mjs FILE.glb
import { writeFileSync } from 'node:fs';
import { url } from '@pmndrs/viverse/dist/assets/mannequin.js';

writeFileSync(process.argv[2], Buffer.from(url.split('base64,')[1], 'base64'));
