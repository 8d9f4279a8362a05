// The servers of a client, of which one is in use, and the retries of calls.
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

  /** Throws ChoreoError for unusable options. */
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
   * Yields the answers of `attempt(server, patience, signal)`, an async generator. Calls it again, on one server after another, until it ends or
   * a retry is useless. Its signal is aborted when the caller's is, or when the client is closed.
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

  /** Switches from a failed server to the next, unless another call already has. Returns false if there is no other. */
  #leave(failed) {
    if (this.#servers[this.#current] === failed) this.#current = (this.#current + 1) % this.#servers.length;
    return this.#servers.length > 1;
  }
}

/** Returns a signal that is aborted as soon as one of `signals` is, and a function to detach it. (AbortSignal.any requires Node.js 20.) */
function joined(signals) {
  const joint = new AbortController();
  const abort = () => joint.abort();
  const given = signals.filter(Boolean);
  for (const signal of given) {
    // Any number of calls may listen to the signal; Node.js would warn at eleven.
    if (signal instanceof EventTarget) setMaxListeners(0, signal);
    signal.addEventListener('abort', abort);
  }
  if (given.some(({ aborted }) => aborted)) abort();
  return { end: joint.signal, leave: () => given.forEach((signal) => signal.removeEventListener('abort', abort)) };
}

/** Waits until the server is connected, or connecting fails (the call then gives the reason), or the signal is aborted. */
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

/** Adds the addresses to the error of an unreachable server. */
function named(error, addresses) {
  if (error.code === 'UNAVAILABLE') error.message = `${[...addresses].join(', ')}: ${error.message}`;
  return error;
}

/** Decides whether to retry a call, and how long to wait before. */
export class Patience {
  #options;
  #deadline;
  #servers;
  #failures = 0; // since the last progress
  #refusals = 0; // consecutive refusals by servers that would refuse again
  #since = 0;
  /** The addresses at which no server was reached since the last progress. */
  away = new Set();
  /** The error to report to the caller. A refusal by a reachable server takes precedence over another server being unreachable. */
  verdict;
  /** The address of the server with that error. */
  verdictOf;

  constructor(options, deadline, servers) {
    this.#options = options;
    this.#deadline = deadline === undefined ? Infinity : Number(deadline);
    this.#servers = servers;
  }

  /** Restarts the time for retries, because the call made progress. */
  reset() {
    this.#failures = 0;
    this.#refusals = 0;
    this.away.clear();
    this.verdict = undefined;
  }

  /** Returns the seconds to wait before a retry; undefined if it would be useless or is no longer allowed. */
  next(failed, elsewhere, address) {
    if (failed.isAway) this.away.add(address);
    const advice = adviceFor(failed);
    const now = Date.now();
    if (this.#failures === 0) this.#since = now;
    // A lone server that was stopping has stopped.
    const stopped = this.#servers === 1 && failed.isAway && this.verdict?.reason === 'DRAINING';
    if (!stopped && (!advice.here || !this.verdict || adviceFor(this.verdict).here)) [this.verdict, this.verdictOf] = [failed, address];
    // Counts refusals until all servers have refused.
    this.#refusals = advice.here ? 0 : this.#refusals + 1;
    const useful = advice.here || (advice.elsewhere && this.#refusals < this.#servers);
    const left = this.#options.retry - (now - this.#since) / 1000;
    const asked = elsewhere ? 0 : advice.wait; // a server's retry delay applies only to that server
    if (!useful || left <= 0 || asked > left) return undefined;
    // A server that stops leaves its dances to the others: each of them is asked once without a wait.
    if (elsewhere && failed.reason === 'DRAINING' && this.#failures + 1 < this.#servers) {
      ++this.#failures;
      return 0;
    }
    const doubled = Math.min(longestBackoff, this.#options.firstBackoff * 2 ** this.#failures++);
    // Clients that lost the same server should not all come back at once.
    const wait = Math.max(asked, Math.min(left, doubled * (0.5 + 0.5 * Math.random())));
    return now + 1000 * wait < this.#deadline ? wait : undefined;
  }
}
