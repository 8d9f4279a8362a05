// A dance that survives the loss of its server: it resumes on another one from the last continuation, and the caller reads the same answers.
import grpc from '@grpc/grpc-js';
import { answersOf } from './answers.js';
import { asSent } from './as_sent.js';
import { checkCall } from './call_options.js';
import { cancelled, ChoreoError, unavailable } from './error.js';
import { requireSameFingerprint } from './header.js';
import { Journal } from './journal.js';
import { DeliveryFilter } from './delivery_filter.js';

/** Yields the answers of StreamDance to `requests`. */
export async function* dance(replicas, requests, given) {
  const options = checkCall(given, ['signal', 'deadline', 'onResume', 'onRejected']);
  const { deadline, onResume, onRejected = warn } = options;
  const journal = new Journal(requests);
  const progress = new Progress(journal, onResume, onRejected);
  try {
    // Checks requests that are already known before calling a server.
    if (Array.isArray(requests)) for (let at = 0; at < requests.length; ++at) await journal.at(at);
    yield* replicas.persist(attempt, options);
  } finally {
    journal.close();
  }

  async function* attempt(server, patience, signal) {
    progress.restart();
    await firstRequest(journal, signal, Number(deadline ?? Infinity));
    const metadata = replicas.metadata();
    if (progress.streamId) metadata.set('choreo-resumed-from', progress.streamId);
    const call = server.stub.StreamDance(metadata, { deadline });
    call.once('metadata', (told) => (progress.streamId ??= told.get('choreo-stream-id')[0]));
    const sent = { count: 0 };
    say(call, journal, progress, sent);
    try {
      for await (const answer of answersOf(call, signal, (violation) => journal.find(violation))) {
        const news = progress.take(answer, server.address, sent.count);
        if (!news) continue;
        if (news.frames) patience.reset();
        yield news;
      }
    } catch (error) {
      if (journal.failure) throw journal.failure;
      // The dance is complete, so the call's status no longer matters.
      if (!progress.complete) throw error instanceof ChoreoError ? because(progress, error) : error;
    }
    if (!progress.complete) throw because(progress, unavailable('the server ended the dance before its summary'));
  }
}

/** Waits for the first request of a call. Throws if it is invalid, or if the signal or the deadline ends the wait. */
async function firstRequest(journal, signal, deadline) {
  let leave, late = false; // a timer may end a millisecond early by the clock
  const end = new Promise((resolve) => {
    const timer = setTimeout(() => resolve((late = true)), Math.min(deadline - Date.now(), 2 ** 31 - 1));
    signal.addEventListener('abort', resolve);
    leave = () => (clearTimeout(timer), signal.removeEventListener('abort', resolve));
    if (signal.aborted) resolve();
  });
  await Promise.race([journal.at(0).catch(() => {}), end]);
  leave();
  if (journal.failure) throw journal.failure;
  if (signal.aborted) throw cancelled();
  if (!late) return;
  throw new ChoreoError({ code: grpc.status.DEADLINE_EXCEEDED, details: 'the deadline passed before the first request' });
}

function because(progress, error) {
  progress.lostBecause = error;
  return error;
}

/** Sends the journal's requests, as fast as the server accepts them, until the call is over. */
async function say(call, journal, progress, sent) {
  let over = false;
  const end = new Promise((resolve) => call.once('status', resolve)).then(() => (over = true));
  try {
    for (let at = 0; ; ++at) {
      const request = await journal.at(at);
      if (over) return;
      if (request === undefined) return call.end();
      sent.count = at + 1;
      if (request === null) continue;
      const again = at === 0 ? progress.first(request) : request;
      if (!call.write(again)) await Promise.race([end, new Promise((resolve) => call.once('drain', resolve))]);
    }
  } catch {
    call.cancel(); // the journal knows what went wrong
  }
}

/** Warns callers without `onRejected` of keys that are not danced, except invalid keys, whose rejection they requested. */
function warn({ id, reason, code }) {
  if (code === 'REJECTION_CODE_INVALID') return;
  process.emitWarning(`key "${id}" is not danced as it was sent: ${reason}`, { type: 'KeyRejectedWarning', code });
}

/** The received part of a dance, and how another server continues it. */
class Progress {
  complete = false;
  /** The name of the first call in its server's log. */
  streamId;
  /** The failure of the previous server. */
  lostBecause;
  #journal;
  #onResume;
  #onRejected;
  #header;
  #continuation;
  #fingerprint; // of the last server that generated frames
  #mayDiffer = false;
  #filter;

  constructor(journal, onResume, onRejected) {
    this.#journal = journal;
    this.#onResume = onResume;
    this.#onRejected = onRejected;
  }

  /** Returns the first request of an attempt. */
  first(request) {
    this.#mayDiffer = request.config?.allow_inexact_resume ?? false;
    if (!this.#header || !request.config) return request;
    // Another server must generate the same dance with the same model.
    const config = { ...request.config, seed: this.#header.seed, model: this.#header.model };
    if (this.#continuation) {
      delete config.history;
      delete config.start;
      config.continuation = this.#continuation;
    }
    if (this.#journal.bytesPerSample() > 0) {
      config.audio_format = { ...config.audio_format, first_sample: this.#journal.firstSample() };
    }
    return { config };
  }

  /** Prepares for another server. */
  restart() {
    this.#journal.refusedKeys.restart();
    this.#filter?.restart();
  }

  /** Returns the part of an answer for the caller, if any. `sent`: the number of requests sent to the server. */
  take(answer, address, sent) {
    switch (answer.response) {
      case 'header':
        return this.#takeHeader(answer, address);
      case 'frames': {
        const frames = this.#filter.frames(answer.frames);
        return frames && { ...answer, frames };
      }
      case 'event': {
        const event = this.#journal.refusedKeys.event(this.#asSent(answer.event));
        if (!this.#filter.event(event)) return undefined;
        if (event.keyframe_rejected) this.#onRejected(event.keyframe_rejected);
        return { ...answer, event };
      }
      case 'continuation':
        this.#continuation = answer.continuation;
        this.#journal.forgetMusicBefore(Number(answer.continuation.audio_from_sample), sent);
        return answer;
      case 'summary':
        return this.#takeSummary(answer);
    }
    return undefined; // from a newer version of the protocol
  }

  /** Translates the fields of a rejected key to those that the caller sent. */
  #asSent(event) {
    const rejected = event.keyframe_rejected;
    if (!rejected?.field) return event;
    const { field } = asSent(rejected.field, this.#journal.find({ field: rejected.field, keyframeId: rejected.id }).message);
    return { ...event, keyframe_rejected: { ...rejected, field } };
  }

  #takeHeader(answer, address) {
    const { header } = answer;
    if (!this.#header) {
      this.#header = header;
      this.#fingerprint = header.fingerprint;
      this.#filter = new DeliveryFilter(header);
      return answer;
    }
    const { frame_rate, skeleton } = this.#header;
    if (header.frame_rate !== frame_rate || header.skeleton.joint_names.length !== skeleton.joint_names.length) {
      const details = 'the server that should resume the dance has another frame rate or body';
      throw new ChoreoError({ code: grpc.status.DATA_LOSS, details });
    }
    // Servers compare fingerprints only if there is a continuation.
    const remedy = ', which config.allow_inexact_resume would let go on';
    if (!this.#continuation && !this.#mayDiffer) requireSameFingerprint(this.#fingerprint, header, address, remedy);
    const exact = this.#continuation ? header.exact_resume : header.fingerprint === this.#fingerprint;
    this.#fingerprint = header.fingerprint;
    this.#onResume?.({ address, frame: this.#filter.nextFrame(), exact, because: this.lostBecause });
    return undefined;
  }

  #takeSummary(answer) {
    this.complete = true;
    // The server counts only the frames that it generated itself: adds those of earlier servers.
    const { report } = answer.summary;
    const made = Number(report.frames) + Number(report.first_frame) - Number(this.#header.first_frame);
    const whole = { ...report, first_frame: this.#header.first_frame, frames: String(made) };
    return { ...answer, summary: { ...answer.summary, report: whole } };
  }
}
