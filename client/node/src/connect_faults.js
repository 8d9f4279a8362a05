// Explains failed connections in terms of the client's options; gRPC reports OpenSSL's messages. Failures that only the caller can fix are not
// retried.
import { lookup } from 'node:dns/promises';
import { connect } from 'node:tls';
import { unavailable } from './error.js';
import { nameOf } from './options.js';

const probeTime = 1000; // milliseconds for a handshake

/** Extracts the reason from gRPC's message. */
function reasonOf(details) {
  const reason = details.split('Last error: ').pop().replace(/\.? Resolution note: .*$/s, '');
  return reason.replace(/^Error(?: \[\w+\])?: /, '').replace(/\s+/g, ' ').trim();
}

/** Returns which option is wrong, and how; undefined if the server is merely unreachable. */
function faultOf(reason, { tls, caCertificate }) {
  if (!tls) return undefined;
  if (/wrong version number|packet length too long|record layer failure/.test(reason)) return 'the server there speaks no TLS: leave out tls';
  const [, asked, names] = /altnames: (?:Host|IP): (.*?)\.? is not in the cert's (?:altnames: (.*)|list:.*)$/.exec(reason) ?? [];
  if (asked) return `the server's certificate is of ${names?.replaceAll('DNS:', '') ?? 'other names'}, not of ${asked}: say of which as serverName`;
  if (/certificate has expired|not yet valid/.test(reason)) return `the server's ${reason.replace(/^the /, '')}`;
  if (/self.signed|unable to (?:verify|get)|certificate (?:signature|chain)/.test(reason)) {
    const given = caCertificate ? `${nameOf(caCertificate)} is not that of its authority` : 'name the PEM file of its authority';
    return `the server's certificate is not trusted (${reason}): ${given} (caCertificate)`;
  }
  return undefined;
}

/** Splits an address into host and port. */
function partsOf(address) {
  const [, host, port] = /^(?:dns:(?:\/\/[^/]*\/)?|ipv[46]:)?\[?([^,/]+?)\]?:(\d+)(?:,|$)/.exec(address) ?? [];
  return { host, port: Number(port) };
}

/** Whether the host name does not exist; false if no DNS server answers. */
const isUnknown = ({ host }) => lookup(host).then(() => false, ({ code }) => code === 'ENOTFOUND');

/** Whether a server at this address speaks TLS. */
function speaksTls(at) {
  return new Promise((resolve) => {
    // Accepts any certificate, because nothing is sent.
    const socket = connect({ ...at, ALPNProtocols: ['h2'], rejectUnauthorized: false, timeout: probeTime });
    const end = (answer) => {
      socket.destroy();
      resolve(answer);
    };
    socket.once('secureConnect', () => end(true)).on('error', () => end(false)).once('timeout', () => end(false));
  });
}

/** Matches gRPC's messages for a server that is not reached. */
const away = /No connection established|Name resolution failed/;

/** Rewrites `error` for people. Sets `isAway` if no server was reached, and suggests a fix if the server never was. */
export async function explained(error, { address, wasThere }, options) {
  if (error.isAway || error.code !== 'UNAVAILABLE' || !away.test(error.message)) return error;
  const reason = reasonOf(error.message);
  // If the server was reached before, its name and certificate may work again, too.
  if (wasThere) return noAnswer(reason);
  const wasClosed = /^Failed to connect/.test(reason);
  const at = partsOf(address);
  let fault = faultOf(reason, options);
  if (at.host && /^Name resolution failed/.test(reason) && (await isUnknown(at))) fault = 'no host of that name is known (addresses)';
  if (at.host && wasClosed && !options.tls && (await speaksTls(at))) fault = 'the server there wants TLS: set tls';
  if (fault) return Object.assign(unavailable(fault), { isOfTheCaller: true });
  const closed = options.tls && !options.clientCertificate ? 'the connection was closed; does the server want a clientCertificate?' : 'the connection was closed';
  return noAnswer(wasClosed ? closed : reason);
}

const plain = { ECONNREFUSED: 'connection refused', ETIMEDOUT: 'nobody answers', EHOSTUNREACH: 'no way to its host', ENETUNREACH: 'no way to its network' };

/** Makes the error for an unreachable server. Callers add its address. */
export function noAnswer(reason) {
  const [, name] = /^connect (\w+) /.exec(reason) ?? [];
  return Object.assign(unavailable(`no server can be reached: ${plain[name] ?? reason}`), { isAway: true });
}
