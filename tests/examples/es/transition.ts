// What a page in the browser does: asks for ways to a pose by gRPC-Web, with messages of protoc-gen-es.
//   npm install @bufbuild/protobuf @connectrpc/connect @connectrpc/connect-web
import type { MessageInitShape } from '@bufbuild/protobuf';
import { ConnectError, createClient } from '@connectrpc/connect';
import { createGrpcWebTransport } from '@connectrpc/connect-web';
import { Choreography, type GenerateTransitionRequestSchema, type ModelInfo } from './gen/choreo/v1/choreography_pb.js';
import { BadRequestSchema } from './gen/google/rpc/error_details_pb.js';

export type Request = MessageInitShape<typeof GenerateTransitionRequestSchema>;

function clientOf(baseUrl: string) {
  return createClient(Choreography, createGrpcWebTransport({ baseUrl }));
}

export async function firstModel(baseUrl: string): Promise<ModelInfo> {
  const { models } = await clientOf(baseUrl).getServerInfo({});
  return models[0]!;
}

/** The rotations of each candidate, and which is the best. */
export async function ways(baseUrl: string, request: Request): Promise<{ rotations: number[][]; best?: number }> {
  const rotations: number[][] = [];
  let best: number | undefined;
  for await (const { response } of clientOf(baseUrl).generateTransition(request)) {
    switch (response.case) {
      case 'frames':
        (rotations[response.value.candidate] ??= []).push(...response.value.rotations);
        break;
      case 'summary':
        best = response.value.candidates[0]?.candidate;
        break;
    }
  }
  return { rotations, best };
}

/** The fields that an error names. */
export function fieldsOf(error: unknown): string[] {
  return ConnectError.from(error).findDetails(BadRequestSchema).flatMap(({ fieldViolations }) => fieldViolations.map(({ field }) => field));
}
