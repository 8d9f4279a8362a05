// Checks a client's options, and converts them for gRPC.
import { createPrivateKey, X509Certificate } from 'node:crypto';
import { readFileSync } from 'node:fs';
import { isIPv4 } from 'node:net';
import { createSecureContext } from 'node:tls';
import grpc from '@grpc/grpc-js';
import { invalid } from './error.js';
import { hint, quoted } from './words.js';

/** Defaults of the options, which index.d.ts documents. */
const defaults = {
  tls: false,
  caCertificate: '',
  clientCertificate: '',
  clientKey: '',
  serverName: '',
  token: '',
  tokenFile: '',
  connectTimeout: 5,
  silence: 5,
  retry: 10,
  firstBackoff: 0.1,
};
/** Whether an error is about a client's addresses or options, such as its token. */
export const isOfOptions = ({ violations: [first] = [] }) => first?.field === 'addresses' || Object.hasOwn(defaults, first?.field ?? '');

const leastSilence = 2; // seconds
const mostPort = 65535;
const mostTokenBytes = 4096; // gRPC's headers have 8 KiB in all

/** Returns the options with their defaults. Throws ChoreoError, naming the option, for unusable ones. */
export function checkOptions(addresses, given) {
  for (const name of Object.keys(given)) if (!Object.hasOwn(defaults, name)) throw invalid(name, `no option; ${hint(name, Object.keys(defaults))}`);
  const options = { ...defaults, ...Object.fromEntries(Object.entries(given).filter(([, value]) => value !== undefined)) };
  for (const [name, value] of Object.entries(options)) {
    const wanted = typeof defaults[name];
    // Does not show the value of a text option, which may be a secret.
    const shown = wanted === 'string' ? (value?.constructor.name ?? value) : quoted(value);
    if (typeof value !== wanted) throw invalid(name, `${shown} is not a ${wanted}`);
    if (typeof value === 'number' && !(value >= 0 && Number.isFinite(value))) throw invalid(name, `${value} is not a finite number >= 0`);
  }
  if (options.connectTimeout === 0) throw invalid('connectTimeout', '0 s leave no time to connect');
  if (options.silence > 0 && options.silence < leastSilence) {
    throw invalid('silence', `${options.silence} s is neither 0 nor at least ${leastSilence} s`);
  }
  if (addresses.length === 0) throw invalid('addresses', 'none is given');
  for (const address of addresses) checkAddress(address);
  if (given.token !== undefined) requireToken('token', 'it', given.token); // an empty one, too
  checkToken(addresses, options);
  return options;
}

// Refuses addresses that gRPC would misread as a host name, or with another port.
function checkAddress(address) {
  if (typeof address !== 'string' || address === '') throw invalid('addresses', `${quoted(address)} is not a HOST:PORT`);
  if (/^https?:/i.test(address)) throw invalid('addresses', `${address} is a URL; use HOST:PORT, and the option tls for TLS`);
  if (/^(unix|unix-abstract|xds):/.test(address)) return;
  const port = /:(\d+)$/.exec(address)?.[1];
  if (port === undefined) throw invalid('addresses', `${address} has no port; use HOST:PORT`);
  if (Number(port) < 1 || Number(port) > mostPort) throw invalid('addresses', `${address}: port ${port} is not in [1, ${mostPort}]`);
}

/** Whether traffic to this address stays on this machine. A host name that merely begins like an IP address is a name. */
function isOfThisMachine(address) {
  if (address.startsWith('unix:')) return true;
  const hosts = address.replace(/^ipv[46]:/, '').split(',');
  return hosts.every((host) => {
    const name = host.replace(/:\d+$/, '');
    return (isIPv4(name) && name.startsWith('127.')) || name === 'localhost' || name === '[::1]';
  });
}

function checkToken(addresses, { token, tokenFile, tls }) {
  if (!token && !tokenFile) return;
  const name = token ? 'token' : 'tokenFile';
  if (token && tokenFile) throw invalid('token', 'given beside tokenFile; one of them is sent');
  const far = addresses.find((address) => !isOfThisMachine(address));
  if (!tls && far) throw invalid(name, `a token is sent to ${far} only over TLS`);
}

// Checks a token. Errors never quote it.
function requireToken(field, what, token) {
  if (token.length > mostTokenBytes) throw invalid(field, `${what} has ${token.length} bytes, of at most ${mostTokenBytes}`);
  if (token !== token.trim()) throw invalid(field, `${what} begins or ends with spaces or a newline; trim it`);
  if (!/^[!-~]+$/.test(token)) throw invalid(field, `${what} is not one line of visible ASCII characters`);
}

function read(field, path) {
  try {
    return readFileSync(path);
  } catch (error) {
    throw invalid(field, error.code === 'ENOENT' ? `no file ${path}` : `cannot read ${path}: ${error.message}`);
  }
}

const isPem = (text) => text.includes('-----BEGIN');
/** The name, in messages, of a PEM file or text; a text may be a secret. */
export const nameOf = (pem) => (isPem(pem) ? 'the text' : pem);

/** Returns the text that `pem` is, or whose path it is. Throws if `check` does. */
function readPem(field, pem, what, check) {
  const text = isPem(pem) ? Buffer.from(pem) : read(field, pem);
  try {
    check(text);
  } catch (error) {
    throw invalid(field, `${nameOf(pem)} ${what}: ${error.message}`);
  }
  return text;
}

/** Makes gRPC's credentials for `options`. */
export function credentialsFor(options) {
  const { tls, caCertificate, clientCertificate, clientKey } = options;
  if (!clientCertificate !== !clientKey) {
    throw invalid(clientKey ? 'clientCertificate' : 'clientKey', 'missing; a certificate and its key go together');
  }
  if (!tls) {
    for (const name of ['caCertificate', 'clientCertificate', 'serverName']) {
      if (options[name]) throw invalid(name, `"${nameOf(options[name])}" needs TLS, which is off`);
    }
    return grpc.credentials.createInsecure();
  }
  const certificate = (field, pem) => readPem(field, pem, 'holds no certificate in PEM', (text) => new X509Certificate(text));
  const roots = caCertificate ? certificate('caCertificate', caCertificate) : null;
  if (!clientKey) return grpc.credentials.createSsl(roots);
  const cert = certificate('clientCertificate', clientCertificate);
  const key = readPem('clientKey', clientKey, 'holds no private key in PEM without a passphrase', createPrivateKey);
  readPem('clientKey', clientKey, `is not the key of ${nameOf(clientCertificate)}`, () => createSecureContext({ cert, key }));
  return grpc.credentials.createSsl(roots, key, cert);
}

/** The metadata of each call: the token, which is read again each time, so that its file can be renewed. */
export function metadataFor({ token, tokenFile }) {
  const metadata = new grpc.Metadata();
  let sent = token;
  if (tokenFile) {
    sent = read('tokenFile', tokenFile).toString('latin1').trimEnd();
    requireToken('tokenFile', tokenFile, sent);
  }
  if (sent) metadata.set('authorization', `Bearer ${sent}`);
  return metadata;
}

/** Options for gRPC's channels. Distributes calls in turn over all addresses of a name. */
export function channelOptions({ serverName, silence }) {
  const named = serverName && { 'grpc.ssl_target_name_override': serverName, 'grpc.default_authority': serverName };
  // Half of the time passes before a ping, the other half is for its answer.
  const pings = silence && { 'grpc.keepalive_time_ms': 500 * silence, 'grpc.keepalive_timeout_ms': 500 * silence };
  return {
    'grpc.service_config': JSON.stringify({ loadBalancingConfig: [{ round_robin: {} }] }),
    'grpc.max_receive_message_length': -1,
    'grpc.initial_reconnect_backoff_ms': 100,
    'grpc.max_reconnect_backoff_ms': 1000,
    ...named,
    ...pings,
  };
}
