// Why no connection comes about, in the words of the options: gRPC tells it in OpenSSL's. What only the caller can mend is not tried again.
import { lookup } from 'node:dns/promises';
import { connect } from 'node:tls';
import { unavailable } from './error.js';
import { nameOf } from './options.js';

const probeTime = 1000; // milliseconds for a handshake

/** The part of gRPC's words that says why. */
function reasonOf(details) {
  const reason = details.split('Last error: ').pop().replace(/\.? Resolution note: .*$/s, '');
  return reason.replace(/^Error(?: \[\w+\])?: /, '').replace(/\s+/g, ' ').trim();
}

/** What is wrong with which option; nothing where a server is only away. */
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

/** Host and port of an address. */
function partsOf(address) {
  const [, host, port] = /^(?:dns:(?:\/\/[^/]*\/)?|ipv[46]:)?\[?([^,/]+?)\]?:(\d+)(?:,|$)/.exec(address) ?? [];
  return { host, port: Number(port) };
}

/** Whether nobody knows its host; false where nobody could be asked. */
const isUnknown = ({ host }) => lookup(host).then(() => false, ({ code }) => code === 'ENOTFOUND');

/** Whether a server speaks TLS there. */
function speaksTls(at) {
  return new Promise((resolve) => {
    // Nothing is sent, so it does not matter whose certificate it is.
    const socket = connect({ ...at, ALPNProtocols: ['h2'], rejectUnauthorized: false, timeout: probeTime });
    const end = (answer) => {
      socket.destroy();
      resolve(answer);
    };
    socket.once('secureConnect', () => end(true)).on('error', () => end(false)).once('timeout', () => end(false));
  });
}

/** gRPC's words for a server that is not reached. */
const away = /No connection established|Name resolution failed/;

/** `error` in words of people: of a server that is not reached, `isAway`; of one that never was, what to mend. */
export async function explained(error, { address, wasThere }, options) {
  if (error.isAway || error.code !== 'UNAVAILABLE' || !away.test(error.message)) return error;
  const reason = reasonOf(error.message);
  // Of one that was there before, names and certificates may come back, too.
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

/** Whose `reason` it is, is for others to say. */
export function noAnswer(reason) {
  const [, name] = /^connect (\w+) /.exec(reason) ?? [];
  return Object.assign(unavailable(`no server is reached: ${plain[name] ?? reason}`), { isAway: true });
}
