import { ChoreoClient, libraryPose, pose, readKeys, type StreamDanceRequest } from 'choreo-client';
const client = new ChoreoClient([process.argv[2]!]);
const model = (await client.info()).models[0]!;
const requests: StreamDanceRequest[] = [
  { config: { seed: '1', frames: 60 } },
  { keyframe: { id: 'a', frame: 40, pose: pose(model.skeleton, { head: [0, 0.5, 0] }) } },
  ...readKeys({ keyframes: [{ id: 'b', frame: 50, pose: 'dab' }] }, model.skeleton),
  { keyframe: { id: 'c', frame: 55, pose: { rotations: new Float32Array(libraryPose('dab', model.skeleton).rotations) } } },
];
let frames: number = 0;
for await (const answer of client.streamDance(requests)) {
  frames += answer.frames?.count ?? 0;
  if (answer.event?.keyframe_reached) console.log(answer.event.keyframe_reached.id);
}
console.log(frames);
await client.streamDance([{ remove_keyframe: { id: '' } }]).next().catch((error) => console.log(error.code, error.violations[0]?.field));
client.close();
