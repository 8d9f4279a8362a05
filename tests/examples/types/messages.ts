// @ts-expect-error: no such field
requests.push({ keyframe: { id: 'b', frames: 40, pose: { rotations: [] } } });
for await (const answer of client.streamDance(requests)) {
  // @ts-expect-error: 64 bits are text
  frames = answer.frames!.first_frame;
}
// @ts-expect-error: text is no time
requests.push({ keyframe: { id: 'b', time: '6', pose: { rotations: [] } } });
// @ts-expect-error: it is tokenFile
new ChoreoClient([], { token_file: 'x' });
// @ts-expect-error: text is no music
requests.push({ audio: { data: 'song.mp3' } });
requests.push({ audio: { data: new Float32Array(9) } }, { audio: { data: new ArrayBuffer(9) } }, { config: { seed: 1n } });
import type { Continuation, DanceConfig, Event, Frames, Header, Keyframe, RotationEncoding, StreamDanceResponse } from 'choreo-client';
const encoding: RotationEncoding = 'ROTATION_ENCODING_QUATERNION';
const config: DanceConfig = { encoding };
const key: Keyframe = { id: 'a', time: 2, pose: { rotations: [] } };
requests.push({ config }, { keyframe: key });
function hear({ header, frames, event, continuation }: StreamDanceResponse): [Header?, Frames?, Event?, Continuation?] {
  return [header ?? undefined, frames ?? undefined, event ?? undefined, continuation ?? undefined];
}
const counted: number | undefined = hear((await client.streamDance(requests).next()).value!)[1]?.count;
