// What errors say of what they were given, and what somebody who misspelt a name may have meant.
import { inspect } from 'node:util';

/** A value, in short. */
export const quoted = (value) => inspect(value, { depth: 0, breakLength: Infinity, maxArrayLength: 3, maxStringLength: 40 });

const plain = (name) => name.toLowerCase().replace(/[^a-z0-9]/g, '');

/** How many letters have to be changed, added or left out. */
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

/** `did you mean ...?`, or else what `names` there are. */
export function hint(name, names) {
  const asked = plain(name);
  const found =
    names.find((one) => plain(one) === asked) ??
    names.find((one) => asked.length > 2 && plain(one).endsWith(asked)) ??
    names.find((one) => distance(plain(one), asked) <= Math.max(1, Math.floor(asked.length / 4)));
  return found ? `did you mean ${found}?` : `there are ${names.join(', ')}`;
}
