// Requests frames for a project from the program: whole dances, and parts to dance anew.
import type { Clip } from '../generated/studio/studio_pb';
import type { ModelInfo } from '../generated/choreo/v1/choreography_pb';
import { Motion } from './motion';
import type { Fault } from './motion';
import { poseMessage, projectMessage } from './project_file';
import type { Project } from './project';
import type { Wire } from './wire';

/// Receives the progress of a dance.
export type Watch = {
  /// Called when more frames have arrived.
  onFrames: (motion: Motion) => void;
  /// Receives a warning for people, about a frame or the whole dance.
  onWarning: (text: string, frame?: number) => void;
};

export class Dancer {
  constructor(private readonly wire: Wire, private readonly model: ModelInfo) {}

  get fps() {
    return this.model.modelFrameRate;
  }
  frames(project: Project) {
    return Math.max(1, Math.round(project.seconds * this.fps));
  }

  /// Dances all frames after `from` (-1: the whole dance) and keeps the earlier ones. Ends early,
  /// with the frames so far, if `signal` is aborted.
  stream(project: Project, before: Motion | null, from: number, watch: Watch, signal: AbortSignal): Promise<Motion> {
    const motion = before && from >= 0 ? before.head(from + 1) : this.nothing();
    const poses = motion.poses(motion.count - this.model.historyFrames, motion.count).map((pose) => poseMessage(pose));
    return new Promise((resolve, reject) => {
      const call = this.wire.open(
        { case: 'dance', value: { project: this.message(project), history: poses.length ? { poses, firstFrame: BigInt(motion.count) } : undefined } },
        {
          onFailure: reject,
          onResponse: ({ response }) => {
            if (response.case === 'resumed') watch.onWarning('The server was lost; the dance continues without a seam.');
            if (response.case !== 'dance') return;
            const part = response.value.response;
            if (part.case === 'frames') {
              motion.append(part.value);
              watch.onFrames(motion);
            } else if (part.case === 'event' && part.value.event.case === 'warning') {
              watch.onWarning(part.value.event.value.message, Number(part.value.frame));
            } else if (part.case === 'summary') {
              this.wire.end(call);
              resolve(motion);
            }
          },
        },
      );
      const cancel = () => {
        this.wire.send(call, { case: 'cancel', value: {} });
        this.wire.end(call);
        resolve(motion);
      };
      if (signal.aborted) cancel();
      else signal.addEventListener('abort', cancel);
    });
  }

  /// Dances `count` motions for the frames between `from` and `to`, through the keys there. Keeps
  /// both end frames. -1 and the number of frames mean the beginning and the end.
  async between(project: Project, motion: Motion, from: number, to: number, count: number, watch: Watch): Promise<Motion[]> {
    const dance: Clip = motion.toClip();
    const answer = await this.wire.request({ case: 'retake', value: { project: this.message(project), dance, from: BigInt(from), to: BigInt(to), takes: count } });
    if (answer.case !== 'takes') return [];
    for (const { frame, event } of answer.value.warnings) if (event.case === 'warning') watch.onWarning(event.value.message, Number(frame));
    return answer.value.frames.map((frames) => {
      const part = this.nothing();
      part.append(frames);
      return motion.with(from + 1, part);
    });
  }

  /// What looks wrong in a dance.
  async check(motion: Motion): Promise<Fault[]> {
    const answer = await this.wire.request({ case: 'check', value: motion.toClip() });
    if (answer.case !== 'faults') throw new Error(`The program answers a check with ${answer.case}.`);
    return answer.value.faults.map(({ firstFrame, lastFrame, text }) => ({ from: Number(firstFrame), to: Number(lastFrame), text: text.replaceAll('_', ' ') }));
  }

  /// Whether one transition can span the interval.
  spans(frames: number) {
    return frames <= this.model.maxTransitionFrames;
  }

  private message(project: Project) {
    const frames = this.frames(project);
    return projectMessage({ ...project, keys: project.keys.filter(({ frame }) => frame < frames), markers: [], dancers: [] }, this.fps);
  }

  private nothing() {
    return new Motion(this.model.skeleton!.jointNames.length, this.fps);
  }
}
