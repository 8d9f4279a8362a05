// Checks the options of one call: gRPC would throw for unusable ones from a timer, where no caller can catch the error.
import { invalid } from './error.js';
import { hint, quoted } from './words.js';

const mostAhead = 1e8 * 3600e3; // milliseconds: gRPC writes deadlines in hours of at most 8 digits
const firstOfOurs = Date.UTC(2000); // an earlier number was probably meant as milliseconds from now

function aFunction(name) {
  return (value) => {
    if (typeof value !== 'function') throw invalid(name, `${quoted(value)} is not a function`);
  };
}

const checks = {
  signal: (value) => {
    if (typeof value.addEventListener !== 'function' || typeof value.aborted !== 'boolean') throw invalid('signal', `${quoted(value)} is not an AbortSignal`);
  },
  deadline: (value) => {
    const time = value instanceof Date ? value.getTime() : value;
    if (typeof time !== 'number' || Number.isNaN(time)) throw invalid('deadline', `${quoted(value)} is not a date`);
    if (time === Infinity) return;
    if (time - Date.now() >= mostAhead) throw invalid('deadline', `${quoted(value)} is not a date within 10 000 years`);
    if (typeof value === 'number' && time < firstOfOurs) {
      throw invalid('deadline', `${value} is not a date of today; numbers are milliseconds since 1970, as Date.now() + 500`);
    }
  },
  cards: (value) => {
    if (typeof value !== 'boolean') throw invalid('cards', `${quoted(value)} is neither true nor false`);
  },
  onResume: aFunction('onResume'),
  onRejected: aFunction('onRejected'),
};

/** Returns the options in `given` that are set. Throws ChoreoError, naming the option, for options not in `names` and for unusable ones. */
export function checkCall(given = {}, names = ['signal', 'deadline']) {
  if (typeof given !== 'object' || given === null) throw invalid('options', `${quoted(given)} is not an object {${names.join(', ')}}`);
  const options = {};
  for (const [name, value] of Object.entries(given)) {
    if (!names.includes(name)) throw invalid(name, `no option of this call; ${hint(name, names)}`);
    if (value === undefined || value === null) continue;
    checks[name](value);
    options[name] = value;
  }
  return options;
}
