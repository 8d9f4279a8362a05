import { answerOf } from './answers.js';
import { checkCall } from './call_options.js';
import { dance } from './dance.js';
import { Replicas } from './replicas.js';
import { transition } from './transition.js';

/** A client of one server or of several replicas. index.d.ts documents each method. */
export class ChoreoClient {
  #replicas;

  constructor(addresses, options = {}) {
    this.#replicas = new Replicas([addresses].flat(), options);
  }

  close() {
    this.#replicas.close();
  }

  async info(given) {
    const replicas = this.#replicas;
    const options = checkCall(given, ['signal', 'deadline', 'cards']);
    const { deadline, cards = false } = options;
    const request = { without_cards: !cards };
    async function* attempt({ stub }, patience, signal) {
      yield await answerOf((callback) => stub.GetServerInfo(request, replicas.metadata(), { deadline }, callback), signal);
    }
    for await (const answer of replicas.persist(attempt, options)) return answer;
  }

  streamDance(requests, options) {
    return dance(this.#replicas, requests, options);
  }

  generateTransition(request, options) {
    return transition(this.#replicas, request, options);
  }
}
