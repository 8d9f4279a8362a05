// Makes several ways from rest to a pose, best first, and says what they are ranked by:
//   node transition.js [--server HOST:PORT]... [--frames 45] [--candidates 3] [--seed 1]
import { pose } from 'choreo-client';
import { clicks, pcm } from './music.js';
import { run, whole } from './program.js';

const flags = {
  frames: { type: 'string', default: '45' },
  candidates: { type: 'string', default: '3' },
  seed: { type: 'string', default: '1' },
};

await run(flags, async (client, options, signal) => {
  const { skeleton, model_frame_rate } = (await client.info()).models[0];
  const count = (name) => Number(whole(options, name, 1n, 1_000_000n));
  const frames = count('frames');
  const request = {
    config: { seed: whole(options, 'seed'), audio_format: pcm },
    frames,
    candidates: count('candidates'),
    target: pose(skeleton, { left_shoulder: [0, 0, 1], right_shoulder: [0, 0, -1] }),
    audio: { data: clicks(frames / model_frame_rate) },
  };
  const came = new Map(); // candidate -> how many have come
  for await (const answer of client.generateTransition(request, { signal })) {
    if (answer.response === 'frames') {
      const { candidate, count } = answer.frames;
      came.set(candidate, (came.get(candidate) ?? 0) + count);
      process.stderr.write(`\r${[...came.values()].join(' + ')} frames`);
    } else if (answer.response === 'summary') {
      console.log();
      for (const { candidate, report } of answer.summary.candidates) {
        // What they are ranked by, in this order.
        const steered = (100 * report.keyframes[0].errors.correction_m).toFixed(1);
        const unsupported = report.support === undefined ? '?' : (100 * (1 - report.support)).toFixed(0);
        const skating = (100 * report.skate_ratio).toFixed(1);
        console.log(`candidate ${candidate}: ${came.get(candidate)} frames, steered ${steered} cm, without support ${unsupported} %, skating ${skating} %`);
      }
    }
  }
});
