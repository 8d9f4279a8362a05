// Checks what serveDance() is given. For the options see index.d.ts.
import { isolated } from '../page/isolated.js';
import { invalid } from '../src/error.js';
import { hint, quoted } from '../src/words.js';

const mostAway = (2 ** 31 - 1) / 1000; // seconds: a timer of Node.js takes no more

const onFailed = (error) => console.error('serveDance:', error);
const defaults = { path: '/dance', origins: [], away: 5, keep: 8 << 20, behind: 10, onContinuation: undefined, onResume: undefined, onFailed };

function numberTo(most, name, value) {
  if (!(typeof value === 'number' && value >= 0 && value <= most)) throw invalid(name, `${quoted(value)} is not a number from 0 to ${most}`);
}

function aFunction(name, value) {
  if (typeof value !== 'function') throw invalid(name, `${quoted(value)} is not a function`);
}

const checks = {
  path: (name, value) => {
    if (typeof value !== 'string' || !/^(\/[^/?#]+)+$/.test(value)) throw invalid(name, `${quoted(value)} is not a path such as '/dance', without a / at its end`);
  },
  origins: (name, value) => {
    // A scheme of an app's own, such as capacitor://localhost, has an origin that URL does not know.
    const isPlain = (one) => typeof one === 'string' && /^[a-z][a-z0-9+.-]*:\/\/[^/?#\s]+$/.test(one) && URL.canParse(one);
    const isOrigin = (one) => one === '*' || (isPlain(one) && [one, 'null'].includes(new URL(one).origin));
    if (!Array.isArray(value)) throw invalid(name, `${quoted(value)} is not a list of origins, such as ['https://my.page']`);
    for (const one of value) if (!isOrigin(one)) throw invalid(name, `${quoted(one)} is not an origin such as 'https://my.page', without a path, nor '*'`);
  },
  away: (...given) => numberTo(mostAway, ...given),
  keep: (...given) => numberTo(Infinity, ...given),
  behind: (...given) => numberTo(Infinity, ...given),
  onContinuation: aFunction,
  onResume: aFunction,
  onFailed: aFunction,
};

/** Returns the options, with their defaults. Throws ChoreoError, which names what is unusable. */
export function checkServe(client, begin, given) {
  if (typeof client?.streamDance !== 'function' || typeof client.info !== 'function') throw invalid('client', `${quoted(client)} is not a ChoreoClient`);
  if (typeof begin !== 'function') throw invalid('begin', `${quoted(begin)} is not a function that says what to dance`);
  const options = { ...defaults };
  for (const [name, value] of Object.entries(given)) {
    if (!Object.hasOwn(defaults, name)) throw invalid(name, `no option; ${hint(name, Object.keys(defaults))}`);
    if (value === undefined || value === null) continue;
    checks[name](name, value);
    options[name] = value;
  }
  for (const name of ['onContinuation', 'onResume', 'onFailed']) options[name] = isolated(options[name]);
  return options;
}
