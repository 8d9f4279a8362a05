// What callers give, in plain JavaScript, which no compiler has seen.

/** Throws for options of other names. */
export function requireOptions(given, names) {
  if (typeof given !== 'object' || given === null) throw new TypeError(`options: ${given} is not an object {${names.join(', ')}}`);
  for (const name of Object.keys(given)) if (!names.includes(name)) throw new TypeError(`options.${name}: is none of ${names.join(', ')}`);
}

/** Throws for what has no fields. `wanted`: what it is in a program. */
export function requireObject(name, value, wanted) {
  if (typeof value !== 'object' || value === null) throw new TypeError(`${name}: ${value} is not ${wanted}`);
}

/** A number that counts. Throws for others. */
export function positive(name, value) {
  if (!(Number.isFinite(value) && value > 0)) throw new TypeError(`${name}: ${value} is not a finite number above 0`);
  return value;
}
