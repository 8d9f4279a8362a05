// A back end that streams dances to web pages. Whoever watches adds key poses meanwhile; serveDance() does the work, below /dance:
//
//   GET /song.wav       what it dances to
//   GET /dance?seed=1   a new dance
import { once } from 'node:events';
import { readFile } from 'node:fs/promises';
import { createServer } from 'node:http';
import { extname } from 'node:path';
import { serveDance } from 'choreo-client/serve';
import { song, wav } from './music.js';
import { positive, run, whole } from './program.js';

const flags = {
  port: { type: 'string', default: '8080' },
  seconds: { type: 'string', default: '60' },
  speed: { type: 'string', default: '1' },
};
const types = { '.html': 'text/html; charset=utf-8', '.js': 'text/javascript; charset=utf-8', '.wav': 'audio/wav' };

/** Serves dances, and the files of a page: `fileAt(path)` is a file's URL, or undefined. */
export const serve = (fileAt) =>
  run(flags, async (client, options, signal) => {
    const order = { seconds: positive(options, 'seconds'), speed: positive(options, 'speed'), music: wav(song(Number(options.seconds))) };
    const dance = serveDance(client, (url) => ({ ...order, config: { seed: url.searchParams.get('seed') ?? '1' } }));
    const server = createServer(async (request, response) => {
      if (await dance(request, response)) return;
      const [path] = request.url.split('?');
      const file = request.method === 'GET' && fileAt(path);
      const content = path === '/song.wav' ? order.music : file && (await readFile(file).catch(() => undefined));
      response.writeHead(content ? 200 : 404, { 'Content-Type': types[extname(file?.pathname ?? path)] ?? 'text/plain' });
      response.end(content || `nothing is at ${request.method} ${path}\n`);
    });
    server.listen(Number(whole(options, 'port', 0n, 65535n)), '127.0.0.1');
    await once(server, 'listening');
    console.log(`http://127.0.0.1:${server.address().port}`);
    if (!signal.aborted) await once(signal, 'abort');
    dance.close();
    server.close();
    server.closeAllConnections();
  });
