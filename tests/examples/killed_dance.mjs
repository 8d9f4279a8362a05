// Dances whose server is killed in the middle, to compare with undisturbed ones. $CHOREO_SERVER names a choreod, $CHOREOD the program of it.
import { ChoreoClient } from '../../client/node/src/index.js';
import { withServer } from './servers.mjs';

const other = process.env.CHOREO_SERVER;

export async function withClient(addresses, options, use) {
  const client = new ChoreoClient(addresses, options);
  try {
    return await use(client);
  } finally {
    client.close();
  }
}

export async function collect(answers, each = () => {}) {
  const all = [];
  for await (const answer of answers) {
    all.push(answer);
    each(answer, all);
  }
  return all;
}

const numbers = (answers) =>
  ['root_positions', 'rotations', 'contacts'].map((field) => answers.flatMap(({ frames }) => frames?.[field] ?? []));
/** All that a caller hears, but for how frames are packed and how quick they were. */
export const told = (answers) => ({
  numbers: numbers(answers),
  // A rejection comes at once, before or after the frames that are being made.
  events: answers.flatMap(({ event }) => (event ? JSON.stringify(event) : [])).sort(),
  continuations: answers.flatMap(({ continuation }) => continuation ?? []),
  headers: answers.flatMap(({ header }) => header ?? []),
  reached: answers.at(-1).summary.report.keyframes.map(({ id, frame, errors }) => ({ id, frame, errors })),
  frames: answers.at(-1).summary.report.frames,
});

/** Dances, and kills the server once `isTime(answers)`, in the middle of the dance. Returns what came, and what was told of the resume. */
export async function danceAndKill(source, isTime, heir = other, options = {}) {
  let goOn;
  const resumes = [];
  return withServer([], (one) =>
    withClient([one.address, heir], options, async (client) => {
      const { skeleton } = (await client.info()).models[0];
      const requests = source(skeleton, { goOn: new Promise((resolve) => (goOn = resolve)) });
      const answers = await collect(client.streamDance(requests, { onResume: (resume) => resumes.push(resume) }), (_, all) => {
        if (!goOn || !isTime(all)) return;
        one.kill();
        goOn();
        goOn = undefined;
      });
      return { answers, resumes };
    }),
  );
}

export const undisturbed = (source, more) =>
  withClient(other, {}, async (client) => collect(client.streamDance(source((await client.info()).models[0].skeleton, more))));
