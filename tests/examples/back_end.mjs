// A back end of a test's own, which serves dances of a choreod.
import { once } from 'node:events';
import { createServer } from 'node:http';
import { serveDance } from '../../client/node/serve/index.js';
import { ChoreoClient } from '../../client/node/src/index.js';

/** A back end until `use({url, http, dance, client})` is done. `through(client)`: what it serves instead of the client. */
export async function withBackEnd(begin, use, { servers = [process.env.CHOREO_SERVER], clientOptions, through = (client) => client, ...options } = {}) {
  const client = new ChoreoClient(servers, clientOptions);
  const dance = serveDance(through(client), begin, options);
  const http = createServer(async (request, response) => (await dance(request, response)) || response.writeHead(404).end());
  http.listen(0, '127.0.0.1');
  await once(http, 'listening');
  try {
    await use({ url: `http://127.0.0.1:${http.address().port}/dance`, http, dance, client });
  } finally {
    dance.close();
    client.close();
    http.close();
    http.closeAllConnections();
  }
}
