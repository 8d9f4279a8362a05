// Generates a transition. If its server is lost, another one repeats it, and answers that were delivered already are left out.
import { answersOf } from './answers.js';
import { checkCall } from './call_options.js';
import { checked, requireSendable } from './check.js';
import { unavailable } from './error.js';
import { requireSameFingerprint } from './header.js';
import { DeliveryFilter } from './delivery_filter.js';

/** Yields the answers of GenerateTransition to the request `asked`. */
export async function* transition(replicas, asked, given) {
  const request = checked('GenerateTransitionRequest', asked, 'request', asked?.config?.audio_format?.encoding);
  requireSendable(request.audio, 'send the music of its frames alone, or a compressed file');
  const options = checkCall(given);
  const { deadline } = options;
  let begun; // the first server's header
  let filter;
  yield* replicas.persist(attempt, options);

  async function* attempt(server, patience, signal) {
    const config = begun ? { ...request.config, seed: begun.seed, model: begun.model } : request.config;
    const call = server.stub.GenerateTransition({ ...request, config }, replicas.metadata(), { deadline });
    let complete = false;
    for await (const answer of answersOf(call, signal, () => ({ message: request }))) {
      if (answer.header && begun) {
        requireSameFingerprint(begun.fingerprint, answer.header, server.address);
      } else if (answer.header) {
        begun = answer.header;
        filter = new DeliveryFilter(begun);
        yield answer;
      } else if (answer.frames) {
        const frames = filter.frames(answer.frames);
        if (!frames) continue;
        patience.reset();
        yield { ...answer, frames };
      } else if (!answer.event || filter.event(answer.event)) {
        complete ||= answer.response === 'summary';
        yield answer;
      }
    }
    if (!complete) throw unavailable('the server ended the transition before its summary');
  }
}
