// From a project to frames, which the program dances: whole dances, and parts of one that are danced anew.
import type { Clip } from './generated/studio/studio_pb';
import type { ModelInfo } from './generated/choreo/v1/choreography_pb';
import { Motion } from './motion';
import { poseMessage, projectMessage } from './project_file';
import type { Project } from './project';
import type { Wire } from './wire';

/// What is heard of a dance in progress.
export type Watch = {
  /// More of it is there.
  grown: (motion: Motion) => void;
  /// For people: of a frame, or of the whole.
  noted: (text: string, frame?: number) => void;
};

export class Dancer {
  constructor(private readonly wire: Wire, private readonly model: ModelInfo) {}

  get fps() {
    return this.model.modelFrameRate;
  }
  frames(project: Project) {
    return Math.max(1, Math.round(project.seconds * this.fps));
  }

  /// Everything behind frame `from` (-1: all of it); what stands before stays. Ends early, with what
  /// there is by then, once `signal` is aborted.
  stream(project: Project, before: Motion | null, from: number, watch: Watch, signal: AbortSignal): Promise<Motion> {
    const motion = before && from >= 0 ? before.head(from + 1) : this.nothing();
    const poses = motion.poses(motion.count - this.model.historyFrames, motion.count).map((pose) => poseMessage(pose));
    return new Promise((resolve, reject) => {
      const call = this.wire.open(
        { case: 'dance', value: { project: this.message(project), history: poses.length ? { poses, firstFrame: BigInt(motion.count) } : undefined } },
        {
          failed: reject,
          heard: ({ response }) => {
            if (response.case === 'resumed') watch.noted('The server was lost; the dance goes on without a seam.');
            if (response.case !== 'dance') return;
            const part = response.value.response;
            if (part.case === 'frames') {
              motion.append(part.value);
              watch.grown(motion);
            } else if (part.case === 'event' && part.value.event.case === 'warning') {
              watch.noted(part.value.event.value.message, Number(part.value.frame));
            } else if (part.case === 'summary') {
              this.wire.end(call);
              resolve(motion);
            }
          },
        },
      );
      signal.addEventListener('abort', () => {
        this.wire.say(call, { case: 'cancel', value: {} });
        this.wire.end(call);
        resolve(motion);
      });
    });
  }

  /// The frames between `from` and `to`, both of which stay, through the keys there: `count` motions.
  /// -1 and the number of frames stand for the beginning and the end.
  async between(project: Project, motion: Motion, from: number, to: number, count: number, watch: Watch): Promise<Motion[]> {
    const dance: Clip = motion.toClip();
    const answer = await this.wire.ask({ case: 'retake', value: { project: this.message(project), dance, from: BigInt(from), to: BigInt(to), takes: count } });
    if (answer.case !== 'takes') return [];
    for (const { frame, event } of answer.value.warnings) if (event.case === 'warning') watch.noted(event.value.message, Number(frame));
    return answer.value.frames.map((frames) => {
      const part = this.nothing();
      part.append(frames);
      return motion.with(from + 1, part);
    });
  }

  /// Whether one transition can span it.
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
