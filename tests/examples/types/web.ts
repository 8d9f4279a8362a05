import { ChoreoClient } from 'choreo-client';
import { connectDance } from 'choreo-client/page';
import { serveDance } from 'choreo-client/serve';
const client = new ChoreoClient('one:1');
serveDance(client, async (url, request) => ({ seconds: 9, music: new Uint8Array(9), config: { seed: url.searchParams.get('seed') ?? '1' } }));
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
