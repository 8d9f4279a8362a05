// A page's key, as it is sent to its back end.
import { DanceError } from './dance_error.js';

const refused = (message) => new DanceError(message, { status: 400, code: 'INVALID_ARGUMENT' });

/** JSON would make null of NaN, and fails for a bigint. */
const shown = (_, value) => (typeof value === 'bigint' || (typeof value === 'number' && !Number.isFinite(value)) ? String(value) : value);

/** The members of a key that are given: undefined is none. */
export function givenOf(key) {
  if (typeof key !== 'object' || key === null || Array.isArray(key)) throw refused(`key: ${key === null ? 'null' : typeof key} is neither {pose} nor {rotations}`);
  return Object.fromEntries(Object.entries(key).filter(([, value]) => value !== undefined));
}

export function textOf(key) {
  try {
    return JSON.stringify(key, shown);
  } catch (error) {
    throw refused(`key: ${error.message}`); // it contains itself
  }
}

/** The address of a key. Throws for an id that no key has. */
export function addressOf(id) {
  if (typeof id !== 'string') throw refused(`id: ${id === null ? 'null' : typeof id} is not a text`);
  if (id === '') throw refused('id: is empty');
  if (id === '.' || id === '..') throw refused(`id: "${id}" means a folder in an address: no key has it`);
  if (/\p{Surrogate}/u.test(id)) throw refused('id: has half a character, a surrogate without its pair');
  return `/keys/${encodeURIComponent(id)}`;
}
