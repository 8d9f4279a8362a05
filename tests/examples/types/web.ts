import { ChoreoClient } from 'choreo-client';
import { connectDance } from 'choreo-client/page';
import { serveDance } from 'choreo-client/serve';
import { createServer as createHttp1, type IncomingMessage } from 'node:http';
import { createServer as createHttp2, type Http2ServerRequest } from 'node:http2';
const client = new ChoreoClient('one:1');
const handler = serveDance(client, async (url, request) => ({ seconds: 9, music: new Uint8Array(9), config: { seed: url.searchParams.get('seed') ?? '1' } }));
// @ts-expect-error: how long?
serveDance(client, () => ({ music: new Uint8Array(9) }));
const dance = connectDance('/dance', { onKey: ({ id, refused }) => console.log(id, refused) });
const told: Promise<{ id: string; time: number }> = dance.setKey({ pose: 'kick' });
// @ts-expect-error: `seconds` says it
serveDance(client, () => ({ seconds: 9, config: { frames: 3 } }));
// @ts-expect-error: one
dance.setKey({ pose: 'kick', rotations: { head: [0, 0, 0] } });
// @ts-expect-error: no pose
dance.setKey({ id: 'a', time: 2 });
const one: Promise<{ id: string }> = dance.setKey({ pose: 'kick', id: undefined as string | undefined, hold: 2 });
// @ts-expect-error: a slip of the pen
dance.setKey({ pose: 'kick', plac: [0, 0] });
// @ts-expect-error: joints are taken wherever she is
dance.setKey({ rotations: { head: [0, 0, 0] }, place: [0, 0] });
// @ts-expect-error: nor are they held
dance.setKey({ rotations: { head: [0, 0, 0] }, hold: 2 });
dance.setKey({ rotations: { head: [0, 0, 0], neck: [0, 0.1, 0] }, time: 3 });
dance.setKey({ pose: 'kick', joints: ['legs', 'head'], hands: 'fist' });
dance.setKey({ joints: { left_knee: 40, head: [0, 20, 0] }, hold: 2, time: 3 });
// @ts-expect-error: no such hands
dance.setKey({ pose: 'kick', hands: 'fists' });
// @ts-expect-error: which pose?
dance.setKey({ joints: ['legs'] });
serveDance(client, (url, request: IncomingMessage | Http2ServerRequest) => ({ seconds: request.headers.authorization ? 9 : 1 }));
createHttp1((request, response) => void handler(request, response));
createHttp2(async (request, response) => void (await handler(request, response)));
