// The library: poses that have names. Key files name them.
import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { invalid } from './error.js';
import { hint, quoted } from './words.js';

const packed = new URL('../poses/', import.meta.url);
// A checkout has no copy: there the repository's are read.
const folder = existsSync(packed) ? packed : new URL('../../poses/', import.meta.url);

let library;

/** The poses that key files may name, by name. */
export function poses() {
  library ??= readdirSync(folder).sort().map((name) => {
    const { description, tags, keyframes: [{ id, root_position: position, rotations }] } = JSON.parse(readFileSync(new URL(name, folder)));
    return { id, description, tags, root_position: position, rotations };
  });
  return library;
}

/** The pose of this name. */
export function find(name, field) {
  const found = poses().find(({ id }) => id === name);
  if (!found) throw invalid(field, `${quoted(name)} is no pose of the library; ${hint(String(name), poses().map(({ id }) => id))}`);
  return found;
}
