// What the programs of this folder have in common: options that are numbers, Ctrl-C, and errors for people.
import { parseArgs } from 'node:util';
import { ChoreoClient } from 'choreo-client';

/** The options by which each program finds its server. CHOREO_SERVER, CHOREO_CA and CHOREO_TOKEN_FILE stand for them. */
const connection = {
  server: { type: 'string', multiple: true, default: [process.env.CHOREO_SERVER ?? '127.0.0.1:50051'] },
  ca: { type: 'string', default: process.env.CHOREO_CA },
  'token-file': { type: 'string', default: process.env.CHOREO_TOKEN_FILE },
};

/** A number above 0 out of a program's options. */
export function positive(options, name) {
  const number = Number(options[name]);
  if (number > 0 && Number.isFinite(number)) return number;
  throw Object.assign(new Error(`${options[name]} is not a number above 0`), { code: `--${name}` });
}

/** A JSON file's path out of a program's options, or undefined. */
export function jsonFile(options, name) {
  if (options[name] === undefined || options[name].endsWith('.json')) return options[name];
  throw Object.assign(new Error(`${options[name]} does not end with .json`), { code: `--${name}` });
}

/** A whole number from `least` to `most` out of a program's options, as text: a seed has 64 bits. */
export function whole(options, name, least = 0n, most = 2n ** 64n - 1n) {
  const text = options[name];
  if (/^\d{1,20}$/.test(text) && BigInt(text) >= least && BigInt(text) <= most) return text;
  throw Object.assign(new Error(`${text} is not a whole number from ${least} to ${most}`), { code: `--${name}` });
}

/**
 * Runs `main(client, options, signal)` with options as node:util's parseArgs has them: Ctrl-C cancels, errors are shown with the fields that
 * they name.
 */
export async function run(options, main) {
  const stop = new AbortController();
  process.once('SIGINT', () => stop.abort());
  let client;
  try {
    const { values } = parseArgs({ options: { ...connection, ...options } });
    client = new ChoreoClient(values.server, { tls: values.ca !== undefined, caCertificate: values.ca, tokenFile: values['token-file'] });
    await main(client, values, stop.signal);
  } catch (error) {
    if (error.path) console.error(error.message); // of a file, with its code
    else console.error(error.code ? `${error.code}: ${error.message}` : error);
    for (const { field } of error.violations ?? []) console.error(`  field: ${field}`);
    if (error.retryAfter) console.error(`  try again in ${error.retryAfter} s`);
    process.exitCode = 1;
  } finally {
    client?.close();
  }
}

/** For streamDance: tells that the dance goes on at another server. */
export function onResume({ address, frame }) {
  console.log(`\ngoes on at ${address} from frame ${frame}`);
}
