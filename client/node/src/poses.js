// The library of named poses, which key files may name.
import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { invalid } from './error.js';
import { hint, quoted } from './words.js';

const packed = new URL('../poses/', import.meta.url);
// A checkout has no copy of the poses: uses the repository's folder.
const folder = existsSync(packed) ? packed : new URL('../../poses/', import.meta.url);

let library;

/** The library's poses, sorted by name. */
export function poses() {
  library ??= readdirSync(folder).sort().map((name) => {
    const { description, tags, keyframes: [{ id, root_position: position, rotations }] } = JSON.parse(readFileSync(new URL(name, folder)));
    return { id, description, tags, root_position: position, rotations };
  });
  return library;
}

/** Finds the pose of this name. Throws ChoreoError, naming `field`, if there is none. */
export function find(name, field) {
  const found = poses().find(({ id }) => id === name);
  if (!found) throw invalid(field, `${quoted(name)} is not a pose of the library; ${hint(String(name), poses().map(({ id }) => id))}`);
  return found;
}
