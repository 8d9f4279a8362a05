// Checks and reads numbers and members of callers' arguments.
import { invalid } from './error.js';
import { hasHalf, quoted } from './words.js';

export const isObject = (value) => typeof value === 'object' && value !== null && !Array.isArray(value);

/** Throws unless the argument is a model's skeleton. */
export function requireSkeleton(skeleton) {
  if (!skeleton?.joint_names) throw invalid('skeleton', `${quoted(skeleton)} is none, as in (await client.info()).models[0].skeleton`);
}

/** Throws for a text that no message can hold. */
export function requireWellFormed(text, field) {
  if (hasHalf(text)) throw invalid(field, `${quoted(text)} has half a character, a surrogate without its pair`);
}

export function number(value, field) {
  if (Number.isFinite(value)) return value;
  throw invalid(field, `${quoted(value)} is not a number${/c$/.test(value) ? "; counts need a song's beats: say seconds" : ''}`);
}

export function vector(value, size, field) {
  if (!Array.isArray(value) || value.length !== size) throw invalid(field, `${quoted(value)} is not a list of ${size} numbers`);
  return value.map((one, at) => number(one, `${field}[${at}]`));
}

/** Reads a place, [x, z]. */
export function place(value, field) {
  const isPlace = Array.isArray(value) && value.length === 2;
  if (!isPlace) throw invalid(field, `${quoted(value)} is not a list of 2 numbers, [x, z] in metres; leave it out, and the pose is taken wherever the dancer is`);
  return vector(value, 2, field);
}

/** Throws for a `where` that has other members than `members`. `form`: its form in the message, such as '{ place: [x, z] }'. */
export function requireWhere(where, form, members) {
  if (!isObject(where)) throw invalid('where', `${quoted(where)} is not ${form}`);
  const unknown = Object.keys(where).find((member) => !members.includes(member));
  if (unknown !== undefined) throw invalid(`where.${unknown}`, `is not known; it is ${form}`);
}
