import { ChoreoClient, libraryPose, pose, readKeys, type Continuation, type Keyframe, type StreamDanceRequest, type StreamDanceResponse } from 'choreo-client';
const client = new ChoreoClient('one:1');
const model = (await client.info()).models[0]!;
const armsUp = pose(model.skeleton, { head: [0, 0, 0] });
const time: number = 2;
async function* right(kept?: Continuation) {
  yield { config: { seed: 1n, frames: 60, continuation: kept } };
  yield { audio: { data: new Float32Array(9), first_sample: 0 } };
  yield { keyframe: { id: 'a', time, pose: armsUp } };
  yield { keyframe: { id: 'a', frame: '40', pose: armsUp, mask: { joints: [1, 2] }, hit: 1 } };
  yield { remove_keyframe: { id: 'a' } };
  yield { generate_until: { frame: 40 } };
  yield { end_of_audio: {} };
  yield { keyframes_complete: {} };
}
let kept: Continuation | undefined;
for await (const answer of client.streamDance(right(kept))) if (answer.response === 'continuation') kept = answer.continuation;
const list: StreamDanceRequest[] = [{ config: {} }, ...readKeys({}, model.skeleton), { keyframe: { id: 'b', interval_after_previous: 9, pose: libraryPose('dab', model.skeleton) } }];
client.streamDance(list);
client.streamDance([{ config: { seed: '1' } }, ...readKeys({}, model.skeleton)]);
client.streamDance([{ config: kept ? { continuation: kept } : {} }]);
declare const queue: AsyncIterable<StreamDanceRequest>;
client.streamDance(queue, { onResume: ({ frame }) => frame });
client.generateTransition({ config: {}, frames: 30, target: armsUp });
declare const event: StreamDanceResponse;
if (event.header) client.streamDance([{ config: { seed: event.header.seed } }]);
async function* forwarded(inner: AsyncIterable<StreamDanceRequest>) { yield { config: {} }; yield* inner; }
client.streamDance(forwarded(queue));

async function* misspelt() { yield { config: { sead: 1 } }; }
async function* misspelt2() { yield { config: {} }; yield { keyframe: { id: 'a', time: 2, pose: armsUp, mask: { joint: [1] } } }; }
async function* text() { yield { keyframe: { id: 'a', time: '2', pose: armsUp } }; }
async function* poseless() { yield { keyframe: { id: 'a', time: 2 } }; }
async function* timeless() { yield { keyframe: { id: 'a', pose: armsUp } }; }
async function* both() { yield { keyframe: { id: 'a', time: 2, frame: 60, pose: armsUp } }; }
async function* unknown() { yield { config: {} }; yield { keyFrame: { id: 'a', time: 2, pose: armsUp } }; }
// @ts-expect-error: no such field
client.streamDance(misspelt());
// @ts-expect-error: nor in a mask
client.streamDance(misspelt2());
// @ts-expect-error: text is no time
client.streamDance(text());
// @ts-expect-error: a key has a pose
client.streamDance(poseless());
// @ts-expect-error: and a time
client.streamDance(timeless());
// @ts-expect-error: one
client.streamDance(both());
// @ts-expect-error: no such request
client.streamDance(unknown());
// @ts-expect-error: as above
list.push({ keyframe: { id: 'a', time: 2 } });
// @ts-expect-error: as above
list.push({ config: {}, end_of_audio: {} });
// @ts-expect-error: nothing
list.push({});
// @ts-expect-error: as above
client.streamDance([{}]);
async function* nothing() { yield { config: {} }; yield {}; }
// @ts-expect-error: as above
client.streamDance(nothing());
// @ts-expect-error: how high, and where to?
client.streamDance([{ keyframe: { id: 'a', time: 2, pose: { root_position: { x: 1 }, rotations: [] } } }]);
// @ts-expect-error: as above
list.push({ remove_keyframe: {} });
// @ts-expect-error: as above
list.push({ config: { allow_inexact_resume: 'no' } });
const misnamed = { config: {}, frames: 30, tarjet: armsUp };
// @ts-expect-error: as above
client.generateTransition(misnamed);
// @ts-expect-error: as above
client.generateTransition({ config: {} });
// @ts-expect-error: as above
const posed: Keyframe = { id: 'a', time: 2 };
