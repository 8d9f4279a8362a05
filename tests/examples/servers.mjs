// choreods of a test's own, with certificates of its own.
import { execFileSync, spawn } from 'node:child_process';
import { createInterface } from 'node:readline';
import { join } from 'node:path';

/** A choreod of $CHOREOD, which ends with `use`, if not before. `more`: of its environment. */
export async function withServer(flags, use, more = {}) {
  const env = { ...process.env, ...more };
  const server = spawn(process.env.CHOREOD, ['--listen', '127.0.0.1:0', ...flags], { env, stdio: ['ignore', 'pipe', 'pipe'] });
  let log = '';
  server.stderr.on('data', (text) => (log += text));
  const over = new Promise((resolve) => server.once('exit', resolve));
  try {
    for await (const line of createInterface({ input: server.stdout })) {
      const address = /listens on (\S+)$/.exec(line)?.[1];
      if (!address) continue;
      server.stdout.resume();
      return await use({ address, kill: () => server.kill('SIGKILL'), drain: () => server.kill('SIGTERM'), log: () => log });
    }
    throw new Error(`choreod ended before it served: ${log}`);
  } finally {
    server.kill('SIGKILL');
    await over;
  }
}

/** Makes an authority in a folder; what it returns issues certificates, {cert, key}, for the names that it is given. */
export function authority(folder) {
  const make = (name, ...more) => {
    const [cert, key] = [join(folder, `${name}.pem`), join(folder, `${name}.key`)];
    const fresh = ['-newkey', 'ec', '-pkeyopt', 'ec_paramgen_curve:P-256', '-noenc', '-days', '1', '-keyout', key, '-out', cert];
    execFileSync('openssl', ['req', '-x509', '-subj', `/CN=${name}`, ...fresh, ...more], { stdio: 'pipe' });
    return { cert, key };
  };
  const ca = make('authority');
  const issue = (name, names) =>
    make(name, '-CA', ca.cert, '-CAkey', ca.key, '-addext', `subjectAltName=${names}`, '-addext', 'basicConstraints=CA:FALSE');
  return { ca, issue };
}
