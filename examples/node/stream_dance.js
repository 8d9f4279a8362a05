// Dances through two key poses to music that is still being played, or to a song:
//   node stream_dance.js [--server HOST:PORT]... [--song FILE] [--seconds 6] [--seed 1] [--speed 1] [--out dance.json]
import { writeFile } from 'node:fs/promises';
import { pose } from 'choreo-client';
import { clicks, file, live, pcm } from './music.js';
import { jsonFile, onResume, positive, run, whole } from './program.js';

const flags = {
  song: { type: 'string' },
  seconds: { type: 'string', default: '6' },
  seed: { type: 'string', default: '1' },
  speed: { type: 'string', default: '1' },
  out: { type: 'string' },
};

async function* requests(options, { skeleton, model_frame_rate }) {
  const seconds = positive(options, 'seconds');
  yield {
    config: {
      seed: whole(options, 'seed'),
      frames: Math.round(seconds * model_frame_rate),
      audio_format: options.song ? { encoding: 'AUDIO_ENCODING_FILE' } : pcm,
    },
  };
  const armsUp = pose(skeleton, { left_shoulder: [0, 0, 1], right_shoulder: [0, 0, -1] }, { place: [0, 0.3] });
  yield { keyframe: { id: 'arms up', time: seconds * 0.4, pose: armsUp } };
  yield { keyframe: { id: 'rest', time: seconds * 0.8, pose: pose(skeleton) } };
  yield { keyframes_complete: {} };
  yield* options.song ? file(options.song) : live(clicks(seconds), positive(options, 'speed'));
  yield { end_of_audio: {} };
}

await run(flags, async (client, options, signal) => {
  const out = jsonFile(options, 'out');
  const model = (await client.info()).models[0];
  const dance = { frame_rate: 0, root_positions: [], rotations: [] };
  let frames = 0;
  for await (const answer of client.streamDance(requests(options, model), { signal, onResume })) {
    switch (answer.response) {
      case 'header':
        dance.frame_rate = answer.header.frame_rate;
        console.log(`${answer.header.model} dances with seed ${answer.header.seed}`);
        break;
      case 'frames': // a back end would send these on to the browser
        frames += answer.frames.count;
        dance.root_positions.push(...answer.frames.root_positions);
        dance.rotations.push(...answer.frames.rotations);
        process.stderr.write(`\r${(frames / dance.frame_rate).toFixed(1)} s of ${options.seconds} s`);
        break;
      case 'event': {
        const { keyframe_reached: reached, warning } = answer.event;
        if (warning) console.error(`\nwarning: ${warning.message}`);
        if (reached) console.log(`\n${reached.id}: reached to ${(1e3 * reached.errors.final_error_m).toFixed(3)} mm`);
        break;
      }
      case 'summary':
        console.log(`\n${frames} frames, ${answer.summary.timing.real_time_factor.toFixed(1)} times as fast as danced`);
        break;
    }
  }
  if (out) await writeFile(out, JSON.stringify(dance));
});
