// gRPC-Web in front of a choreod, for pages, where there is no Envoy.
import { createServer, type Server } from 'node:http';
import { createClient } from '@connectrpc/connect';
import { connectNodeAdapter, createGrpcTransport } from '@connectrpc/connect-node';
import { Choreography } from './gen/choreo/v1/choreography_pb.js';

export function proxy(baseUrl: string): Server {
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
  return createServer(adapter);
}
