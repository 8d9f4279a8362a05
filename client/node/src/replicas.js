// The servers that may be asked, one at a time, and how long to go on asking.
import { setMaxListeners } from 'node:events';
import { setTimeout as sleep } from 'node:timers/promises';
import grpc from '@grpc/grpc-js';
import { explained, noAnswer } from './connect_faults.js';
import { adviceFor, cancelled, ChoreoError } from './error.js';
import { channelOptions, checkOptions, credentialsFor, metadataFor } from './options.js';
import { Choreography } from './protos.js';

const longestBackoff = 2; // seconds

export class Replicas {
  #servers;
  #current = 0;
  #closing = new AbortController();

  /** Throws ChoreoError for options that cannot be used. */
  constructor(addresses, options) {
    this.options = checkOptions(addresses, options);
    const credentials = credentialsFor(this.options);
    this.#servers = addresses.map((address) => ({
      address,
      stub: new Choreography(address, credentials, channelOptions(this.options)),
    }));
  }

  /** Ends all calls. */
  close() {
    this.#closing.abort();
    for (const { stub } of this.#servers) stub.close();
  }

  metadata() {
    return metadataFor(this.options);
  }

  /**
   * The answers of `attempt(server, patience, signal)`, an async generator, which is asked for again, of one server after another, until it
   * ends or trying again would not help. The signal is aborted where the caller's is, or the client is closed.
   */
  async *persist(attempt, { signal, deadline } = {}) {
    const { end, leave } = joined([signal, this.#closing.signal]);
    try {
      yield* this.#persist(attempt, end, deadline);
    } catch (error) {
      if (this.#closing.signal.aborted) throw cancelled('the client is closed');
      if (signal?.aborted && error.code === 'CANCELLED') error.cause = signal.reason;
      throw error;
    } finally {
      leave();
    }
  }

  async *#persist(attempt, signal, deadline) {
    const patience = new Patience(this.options, deadline, this.#servers.length);
    for (;;) {
      const server = this.#servers[this.#current];
      try {
        if (signal.aborted) throw cancelled();
        await connected(server, this.options.connectTimeout, deadline, signal);
        if (signal.aborted) throw cancelled();
        server.wasThere ||= server.stub.getChannel().getConnectivityState(false) === grpc.connectivityState.READY;
        yield* attempt(server, patience, signal);
        return;
      } catch (failure) {
        if (!(failure instanceof ChoreoError) || signal.aborted) throw failure;
        const error = await explained(failure, server, this.options);
        const wait = patience.next(error, this.#leave(server), server.address);
        if (wait === undefined) throw named(patience.verdict, patience.verdict.isAway ? patience.away : [patience.verdictOf]);
        await sleep(1000 * wait, undefined, { signal }).catch(() => {
          throw cancelled();
        });
      }
    }
  }

  /** This one failed: go on to the next, unless another call went on already. False where there is no other. */
  #leave(failed) {
    if (this.#servers[this.#current] === failed) this.#current = (this.#current + 1) % this.#servers.length;
    return this.#servers.length > 1;
  }
}

/** A signal that is aborted as soon as one of `signals` is, and what forgets them. (AbortSignal.any wants Node.js 20.) */
function joined(signals) {
  const joint = new AbortController();
  const abort = () => joint.abort();
  const given = signals.filter(Boolean);
  for (const signal of given) {
    // As many calls as there are may wait for it: Node.js would warn of eleven.
    if (signal instanceof EventTarget) setMaxListeners(0, signal);
    signal.addEventListener('abort', abort);
  }
  if (given.some(({ aborted }) => aborted)) abort();
  return { end: joint.signal, leave: () => given.forEach((signal) => signal.removeEventListener('abort', abort)) };
}

/** Waits until the server is there, or will not be: the call then says why. Or until nobody wants it any more. */
function connected({ address, stub }, seconds, deadline = Infinity, signal) {
  const { READY, TRANSIENT_FAILURE, SHUTDOWN } = grpc.connectivityState;
  const channel = stub.getChannel();
  const end = Math.min(Date.now() + 1000 * seconds, Number(deadline));
  let leave;
  const there = new Promise((resolve, reject) => {
    signal.addEventListener('abort', resolve);
    leave = () => signal.removeEventListener('abort', resolve);
    const look = (late) => {
      const state = channel.getConnectivityState(true);
      if ([READY, TRANSIENT_FAILURE, SHUTDOWN].includes(state) || Date.now() >= Number(deadline)) resolve();
      else if (late) reject(noAnswer(`nobody answers within ${seconds} s`));
      else channel.watchConnectivityState(state, end, look);
    };
    look();
  });
  return there.finally(leave);
}

/** Whoever is away is named. */
function named(error, addresses) {
  if (error.code === 'UNAVAILABLE') error.message = `${[...addresses].join(', ')}: ${error.message}`;
  return error;
}

/** How long to wait before the next attempt of a call, if there is to be one. */
class Patience {
  #options;
  #deadline;
  #servers;
  #failures = 0; // since the last progress
  #refusals = 0; // of servers that would refuse again, one after another
  #since = 0;
  /** The addresses at which no server was reached since then. */
  away = new Set();
  /** What to tell the caller. Why a server that is there would not serve says more than that another one is away. */
  verdict;
  /** At which address. */
  verdictOf;

  constructor(options, deadline, servers) {
    this.#options = options;
    this.#deadline = deadline === undefined ? Infinity : Number(deadline);
    this.#servers = servers;
  }

  /** There was progress: count from the beginning. */
  reset() {
    this.#failures = 0;
    this.#refusals = 0;
    this.away.clear();
    this.verdict = undefined;
  }

  /** Seconds, or undefined where trying again would not help, or is no longer allowed. */
  next(failed, elsewhere, address) {
    if (failed.isAway) this.away.add(address);
    const advice = adviceFor(failed);
    const now = Date.now();
    if (this.#failures === 0) this.#since = now;
    if (!advice.here || !this.verdict || adviceFor(this.verdict).here) [this.verdict, this.verdictOf] = [failed, address];
    // Once all have refused there is no other one left to do better.
    this.#refusals = advice.here ? 0 : this.#refusals + 1;
    const useful = advice.here || (advice.elsewhere && this.#refusals < this.#servers);
    const left = this.#options.retry - (now - this.#since) / 1000;
    const asked = elsewhere ? 0 : advice.wait; // what a server asks for concerns itself
    if (!useful || left <= 0 || asked > left) return undefined;
    const doubled = Math.min(longestBackoff, this.#options.firstBackoff * 2 ** this.#failures++);
    // Clients that lost the same server should not all come back at once.
    const wait = Math.max(asked, Math.min(left, doubled * (0.5 + 0.5 * Math.random())));
    return now + 1000 * wait < this.#deadline ? wait : undefined;
  }
}
