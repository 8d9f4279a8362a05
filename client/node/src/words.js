// Formats values for errors, and suggests names for misspelt ones.
import { inspect } from 'node:util';

/** Formats a value briefly. */
export const quoted = (value) => inspect(value, { depth: 0, breakLength: Infinity, maxArrayLength: 3, maxStringLength: 40 });

/** Whether a text has half a character, a surrogate without its pair, which UTF-8 and so no message can hold. */
export const hasHalf = (text) => /\p{Surrogate}/u.test(text);

/** A text with U+FFFD, as browsers write it, in place of half characters. */
export const wellFormed = (text) => text.replace(/\p{Surrogate}/gu, '\ufffd');

const plain = (name) => name.toLowerCase().replace(/[^a-z0-9]/g, '');

const sorted = (name) => [...name].sort().join('');

/** The number of letters to change, add or remove to turn `a` into `b`. */
function distance(a, b) {
  let row = Array.from({ length: b.length + 1 }, (_, at) => at);
  for (let i = 1; i <= a.length; ++i) {
    const next = [i];
    for (let j = 1; j <= b.length; ++j) {
      next[j] = Math.min(row[j] + 1, next[j - 1] + 1, row[j - 1] + (a[i - 1] === b[j - 1] ? 0 : 1));
    }
    row = next;
  }
  return row[b.length];
}

/** Returns `did you mean ...?` or, if no name is near, a list of `names`. */
export function hint(name, names) {
  const asked = plain(name);
  const found =
    names.find((one) => plain(one) === asked) ??
    names.find((one) => asked.length > 2 && plain(one).endsWith(asked)) ??
    names.find((one) => sorted(plain(one)) === sorted(asked)) ?? // swapped letters
    names.find((one) => distance(plain(one), asked) <= Math.max(1, Math.floor(asked.length / 4)));
  return found ? `did you mean ${found}?` : `there are ${names.join(', ')}`;
}
