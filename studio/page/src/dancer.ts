// From a project to frames: whole dances, and parts of one that are danced anew.
import { create } from '@bufbuild/protobuf';
import type { MessageInitShape } from '@bufbuild/protobuf';
import type { Pose } from './body';
import { BodyPart, DanceConfigSchema, GenerateTransitionRequestSchema, KeyframeSchema } from './generated/choreo/v1/choreography_pb';
import type { Keyframe, ModelInfo } from './generated/choreo/v1/choreography_pb';
import { PoseSchema } from './generated/choreo/v1/motion_pb';
import type { Continuation } from './generated/choreo/v1/motion_pb';
import { isDownbeat } from './counts';
import type { Beats } from './counts';
import { Motion } from './motion';
import { handPoses, withHeld } from './project';
import type { Key, Project, Step } from './project';
import type { Wire } from './wire';

type Init<S extends Parameters<typeof create>[0]> = MessageInitShape<S>;

/// Poses of what follows that a transition leads into (kLeadIn of the client).
const leadIn = 10;

/// What is heard of a dance in progress.
export type Watch = {
  /// More of it is there.
  grown: (motion: Motion) => void;
  /// For people: of a frame, or of the whole.
  noted: (text: string, frame?: number) => void;
};

const poseMessage = (pose: Pose, hasPlace = true): Init<typeof PoseSchema> => ({
  rotations: pose.rotations,
  ...(hasPlace
    ? { rootPosition: { x: pose.root[0], y: pose.root[1], z: pose.root[2] } }
    : {}),
});

export const keyMessage = (key: Key): Init<typeof KeyframeSchema> => ({
  id: key.id,
  when: { case: 'frame', value: BigInt(key.frame) },
  pose: poseMessage(key.pose, key.hasPlace),
  mask: key.asks ? { joints: key.asks } : undefined,
  hit: key.hit ?? undefined,
  hands: key.hands ? handPoses.indexOf(key.hands) + 1 : 0,
});

/// The other way round. `height`: of the hips where the key does not say where they are.
export function readKey({ id, when, pose, mask, hit, hands }: Keyframe, fps: number, height: number): Key {
  const root = pose!.rootPosition;
  return {
    id,
    frame: when.case === 'frame' ? Number(when.value) : Math.round(Number(when.value) * fps),
    pose: { root: root ? [root.x, root.y, root.z] : [0, height, 0], rotations: pose!.rotations },
    hasPlace: !!root,
    asks: mask ? mask.joints : null,
    hold: 0,
    hit: hit ?? null,
    hands: hands ? handPoses[hands - 1] : null,
  };
}

export const pathMessage = (path: Step[]) => ({ frames: path.map(({ frame }) => BigInt(frame)), points: path.flatMap(({ x, z }) => [x, z]) });

/// How all of a dance is danced.
export const how = ({ seed, style, dynamics, variation }: Project) => ({ seed: BigInt(seed), style, musicDynamics: dynamics, variation });

/// The beats that a project sets, if any.
export const beatsMessage = (beats: Beats | null): Init<typeof DanceConfigSchema> => beats
  ? { musicBeats: beats.list.map(({ time }) => time), musicDownbeats: beats.list.filter((beat) => isDownbeat(beat, beats.bar)).map(({ time }) => time) }
  : {};

export class Dancer {
  constructor(private readonly wire: Wire, private readonly model: ModelInfo) {}

  get fps() {
    return this.model.modelFrameRate;
  }
  frames(project: Project) {
    return Math.max(1, Math.round(project.seconds * this.fps));
  }

  /// With those that hold others.
  keys(project: Project) {
    return withHeld(project.keys, this.frames(project), this.fps);
  }

  /// Everything behind frame `from` (-1: all of it); what stands before stays. Ends early, with what
  /// there is by then, once `signal` is aborted.
  stream(project: Project, before: Motion | null, from: number, watch: Watch, signal: AbortSignal): Promise<Motion> {
    const motion = before && from >= 0 ? before.head(from + 1) : this.nothing();
    return new Promise((resolve, reject) => {
      const call = this.wire.open(
        { case: 'dance', value: { request: { case: 'config', value: this.config(project, motion, true) } } },
        {
          failed: reject,
          heard: ({ response }) => {
            if (response.case === 'resumed') watch.noted('The server was lost; the dance goes on without a seam.');
            if (response.case !== 'dance') return;
            const said = response.value.response;
            if (said.case === 'frames') {
              motion.append(said.value);
              watch.grown(motion);
            } else if (said.case === 'event' && said.value.event.case === 'warning') {
              watch.noted(said.value.event.value.message, Number(said.value.frame));
            } else if (said.case === 'summary') {
              this.wire.end(call);
              resolve(motion);
            }
          },
        },
      );
      const say = (request: Extract<Parameters<Wire['say']>[1], { case: 'dance' }>['value']) =>
        this.wire.say(call, { case: 'dance', value: request });
      const controls = this.controls(project);
      if (controls) say({ request: { case: 'controls', value: controls } });
      for (const key of this.keys(project)) {
        if (key.frame > from && key.frame < this.frames(project))
          say({ request: { case: 'keyframe', value: keyMessage(key) } });
      }
      say({ request: { case: 'keyframesComplete', value: {} } });
      signal.addEventListener('abort', () => {
        this.wire.say(call, { case: 'cancel', value: {} });
        this.wire.end(call);
        resolve(motion);
      });
    });
  }

  /// The frames between `from` and `to`, both of which stay, through the keys there: one motion for
  /// each of `count` candidates. -1 and the number of frames stand for the beginning and the end.
  async between(project: Project, motion: Motion, from: number, to: number, seed: number, count: number, watch: Watch) {
    const leadsOn = to < motion.count;
    const stops: (Key | null)[] = this.keys(project).filter(({ frame }) => frame > from && frame < to);
    const last = stops.at(-1)?.frame ?? from;
    if (leadsOn) stops.push(null);
    else if (last < to - 1) stops.push(null);
    let parts = Array.from({ length: count }, () => this.nothing());
    let continuation: Init<typeof DanceConfigSchema>['start'] | undefined;
    let at = from;
    for (const stop of stops) {
      const end = stop?.frame ?? (leadsOn ? to : to - 1);
      const config = this.config({ ...project, seed }, motion.head(from + 1), false);
      if (continuation) config.start = continuation;
      const request: Init<typeof GenerateTransitionRequestSchema> = {
        config,
        frames: end - at,
        controls: this.controls(project),
        candidates: at === from ? count : 1,
      };
      if (stop) {
        request.target = poseMessage(stop.pose, stop.hasPlace);
        if (stop.asks) request.targetMask = { joints: stop.asks };
        request.targetId = stop.id;
        request.targetHit = stop.hit ?? undefined;
      } else if (leadsOn) {
        const there = project.keys.find(({ frame }) => frame === to);
        request.target = poseMessage(motion.pose(to));
        request.targetId = there?.id ?? '';
        request.targetHit = there?.hit ?? undefined;
        request.after = motion.poses(to + 1, to + 1 + leadIn).map((pose) => poseMessage(pose));
      }
      const made = await this.transition(request, watch);
      if (at === from) parts = made.parts;
      else parts[0] = parts[0].with(parts[0].count, made.parts[0]);
      continuation = { case: 'continuation', value: made.continuation };
      at = end;
    }
    // The last frame, where something follows, is the one that stays.
    return parts.map((part) => motion.with(from + 1, part, to - from - 1));
  }

  /// Whether one transition can span it.
  spans(frames: number) {
    return frames <= this.model.maxTransitionFrames;
  }

  private nothing() {
    return new Motion(this.model.skeleton!.jointNames.length, this.fps);
  }

  private config(project: Project, before: Motion, whole: boolean): Init<typeof DanceConfigSchema> {
    const config: Init<typeof DanceConfigSchema> = { ...how(project), ...beatsMessage(project.beats) };
    if (whole) config.frames = BigInt(this.frames(project));
    if (before.count > 0) {
      config.start = {
        case: 'history',
        value: {
          poses: before.poses(before.count - this.model.historyFrames, before.count).map((pose) => poseMessage(pose)),
          firstFrame: BigInt(before.count),
        },
      };
    }
    return config;
  }

  controls(project: Project): Init<typeof GenerateTransitionRequestSchema>['controls'] {
    const { velocities, path } = project;
    const isUsual = velocities.every((factor) => factor === 1);
    if (isUsual && path.length === 0) return undefined;
    return {
      ...(path.length ? { rootPath: pathMessage(path) } : {}),
      ...(isUsual ? {} : {
        velocityFactors: {
          factors: velocities,
          parts: [BodyPart.TRUNK, BodyPart.LEFT_ARM, BodyPart.RIGHT_ARM, BodyPart.LEFT_LEG, BodyPart.RIGHT_LEG],
        },
      }),
    };
  }

  private transition(request: Init<typeof GenerateTransitionRequestSchema>, watch: Watch) {
    type Made = { parts: Motion[]; continuation: Continuation };
    return new Promise<Made>((resolve, reject) => {
      const parts: Motion[] = [];
      const call = this.wire.open(
        { case: 'transition', value: request },
        {
          failed: reject,
          heard: ({ response }) => {
            if (response.case !== 'transition') return;
            const said = response.value.response;
            if (said.case === 'frames') {
              parts.push(this.nothing());
              parts.at(-1)!.append(said.value);
            } else if (said.case === 'event' && said.value.event.case === 'warning') {
              watch.noted(said.value.event.value.message, Number(said.value.frame));
            } else if (said.case === 'summary') {
              this.wire.end(call);
              const continuation = said.value.candidates[0].continuation;
              if (!continuation) return reject(new Error('The server sent no continuation.'));
              resolve({ parts, continuation });
            }
          },
        },
      );
    });
  }
}
