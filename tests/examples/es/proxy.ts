// gRPC-Web in front of a choreod, for pages, where there is no Envoy:
//   npm install typescript @types/node @bufbuild/protobuf @connectrpc/connect @connectrpc/connect-node
//
// Beside it go the messages, gen/, which docs/programs.md generates, and a package.json with "type": "module":
//   npx tsc --module nodenext --target es2022 --skipLibCheck proxy.ts
//   node -e "import('./proxy.js').then(({ proxy }) => proxy('http://127.0.0.1:50051').listen(8081))"
import { createServer, type Server } from 'node:http';
import { cors, createClient } from '@connectrpc/connect';
import { connectNodeAdapter, createGrpcTransport } from '@connectrpc/connect-node';
import { Choreography } from './gen/choreo/v1/choreography_pb.js';

/** Pages of `origin` may ask; of any, if it is left out. */
export function proxy(baseUrl: string, origin = '*'): Server {
  const choreod = createClient(Choreography, createGrpcTransport({ baseUrl }));
  const adapter = connectNodeAdapter({
    connect: false,
    grpc: false,
    routes: (router) =>
      router.service(Choreography, {
        getServerInfo: (request, { signal }) => choreod.getServerInfo(request, { signal }),
        generateTransition: (request, { signal }) => choreod.generateTransition(request, { signal }),
      }),
  });
  return createServer((request, response) => {
    response.setHeader('Access-Control-Allow-Origin', origin);
    response.setHeader('Access-Control-Expose-Headers', cors.exposedHeaders.join());
    if (request.method !== 'OPTIONS') return adapter(request, response);
    // Before it calls, the browser asks whether the page may.
    response.setHeader('Access-Control-Allow-Methods', cors.allowedMethods.join());
    response.setHeader('Access-Control-Allow-Headers', cors.allowedHeaders.join());
    response.writeHead(204).end();
  });
}
