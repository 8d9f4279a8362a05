// The API: its service, and the messages of its errors.
import { existsSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import grpc from '@grpc/grpc-js';
import protoLoader from '@grpc/proto-loader';
import protobuf from 'protobufjs';

const packed = fileURLToPath(new URL('../proto', import.meta.url));
// A checkout has no copy of the protos: uses the repository's folder.
const folder = existsSync(packed) ? packed : fileURLToPath(new URL('../../../proto', import.meta.url));

/** Options for converting messages to plain objects; the package's types are generated with the same ones. */
export const literal = {
  keepCase: true, // errors name fields as the proto does
  longs: String, // a seed has 64 bits, a number only 53
  enums: String,
  defaults: true,
  oneofs: true, // answer.response names the present field
};

/** gRPC's stub for choreo.v1.Choreography. */
export const Choreography = grpc.loadPackageDefinition(
  protoLoader.loadSync('choreo/v1/choreography.proto', { includeDirs: [folder], ...literal }),
).choreo.v1.Choreography;

function load(files, options) {
  const root = new protobuf.Root();
  root.resolvePath = (_, file) => join(folder, file);
  return root.loadSync(files, options).resolveAll();
}

/** The descriptors of the API's messages. */
export const api = load(['choreo/v1/choreography.proto'], { keepCase: literal.keepCase });

/** google.rpc: Status and the details of errors. */
export const rpc = load(['google/rpc/status.proto', 'google/rpc/error_details.proto']);
