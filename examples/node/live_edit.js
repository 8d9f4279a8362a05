// Edits a dance while its music plays: each pose is asked for 1.5 s ahead and changed 0.8 s ahead, and half way limbs get livelier.
//   node live_edit.js [--server HOST:PORT]... [--seconds 8] [--seed 1] [--speed 1]
import { pose } from 'choreo-client';
import { clicks, live, pcm, sampleRate } from './music.js';
import { onResume, positive, run, whole } from './program.js';

const flags = {
  seconds: { type: 'string', default: '8' },
  seed: { type: 'string', default: '1' },
  speed: { type: 'string', default: '1' },
};
const lookAhead = 0.3; // seconds

/** [{at: second at which it is said, request}], in order. */
function edits(seconds, { skeleton, controls }) {
  const said = [];
  const arms = { left_shoulder: [0, 0, 1], right_shoulder: [0, 0, -1] };
  for (let second = 2; second < seconds; second += 2) {
    for (const { ahead, rotations } of [
      { ahead: 1.5, rotations: { left_shoulder: arms.left_shoulder } },
      { ahead: 0.8, rotations: arms },
    ]) {
      const wanted = pose(skeleton, rotations); // wherever the dancer is then
      said.push({ at: second - ahead, request: { keyframe: { id: `second ${second}`, time: second, pose: wanted } } });
    }
  }
  if (controls.includes('CONTROL_VELOCITY_FACTORS')) {
    said.push({ at: seconds / 2, request: { controls: { velocity_factors: { factors: [1.5] } } } });
  }
  return said.sort((a, b) => a.at - b.at);
}

async function* requests(options, model) {
  const seconds = positive(options, 'seconds');
  const frameAt = (second) => Math.round(second * model.model_frame_rate);
  // Without generate_until here each key would settle the frames up to itself.
  yield { config: { seed: whole(options, 'seed'), frames: frameAt(seconds), audio_format: pcm, generate_until: 0, reject_invalid_keys: true } };
  const waiting = edits(seconds, model);
  for await (const piece of live(clicks(seconds), positive(options, 'speed'))) {
    const played = (piece.audio.first_sample + piece.audio.data.length / 2) / sampleRate;
    while (waiting.length > 0 && waiting[0].at <= played) yield waiting.shift().request;
    // What is nearer than this is settled; what is after may still change.
    yield { generate_until: { frame: frameAt(played + lookAhead) } };
    yield piece;
  }
  yield { end_of_audio: {} };
  yield { keyframes_complete: {} };
}

const onRejected = ({ id, reason }) => console.log(`${id}: ${reason}`);

await run(flags, async (client, options, signal) => {
  const model = (await client.info()).models[0];
  let frames = 0;
  for await (const { frames: block, event } of client.streamDance(requests(options, model), { signal, onResume, onRejected })) {
    frames += block?.count ?? 0;
    if (event?.keyframe_reached) console.log(`${event.keyframe_reached.id}: reached`);
  }
  console.log(`${frames} frames`);
});
