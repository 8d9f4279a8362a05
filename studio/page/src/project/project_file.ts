// Converts a project to the program's message and back. Only the program reads and writes project
// files; `choreo dance --project FILE` dances one.
import type { MessageInitShape } from '@bufbuild/protobuf';
import type { Pose } from './body';
import type { Keyframe, KeyframeSchema } from '../generated/choreo/v1/choreography_pb';
import type { PoseSchema } from '../generated/choreo/v1/motion_pb';
import { controlsMessage, readControls } from './controls';
import type { Project as Message, ProjectKey, ProjectSchema, StageDancer } from '../generated/studio/studio_pb';
import { emptyProject, trimmed } from './project';
import type { Key, Partner, Project } from './project';

export const poseMessage = ({ root: [x, y, z], rotations }: Pose, hasPlace = true): MessageInitShape<typeof PoseSchema> =>
  ({ rotations, ...(hasPlace ? { rootPosition: { x, y, z } } : {}) });

export const keyMessage = (key: Key): MessageInitShape<typeof KeyframeSchema> => ({
  id: key.id,
  when: { case: 'frame', value: BigInt(key.frame) },
  pose: poseMessage(key.pose, key.hasPlace),
  mask: key.joints ? { joints: key.joints } : undefined,
  hit: key.hit ?? undefined,
  hands: key.hands,
});

/// Converts a key from its message. `height`: that of the hips if the key has no place.
export function readKey({ id, when, pose, mask, hit, hands }: Keyframe, fps: number, height: number): Key {
  const root = pose!.rootPosition;
  return {
    id,
    frame: when.case === 'frame' ? Number(when.value) : Math.round(Number(when.value) * fps),
    pose: { root: root ? [root.x, root.y, root.z] : [0, height, 0], rotations: pose!.rotations },
    hasPlace: !!root,
    joints: mask ? mask.joints : null,
    hold: 0,
    hit: hit ?? null,
    hands,
  };
}

/// A project's dancers, with their own keys as `keyMessages` gives them.
export const dancersMessage = ({ dancers, apart }: Project, keyMessages?: (keys: Key[]) => MessageInitShape<typeof ProjectSchema>['keys']) => ({
  dancers: dancers.map(({ keys, seed, ...rest }) => ({ ...rest, seed: seed === null ? undefined : BigInt(seed), hasKeys: !!(keyMessages && keys), keys: (keys && keyMessages?.(keys)) ?? [] })),
  apart,
});

export function projectMessage(project: Project, fps: number): MessageInitShape<typeof ProjectSchema> {
  const keyMessages = (keys: Key[]) => trimmed(keys, Math.round(project.seconds * fps), fps).map((key) => ({ key: keyMessage(key), hold: BigInt(key.hold) }));
  const { song, seconds, seed, style, dynamics, variation, beats, markers, keys } = project;
  return {
    song, seconds, seed: BigInt(seed), style, musicDynamics: dynamics, variation, controls: controlsMessage(project),
    ...(beats ? { beats: { bar: beats.bar, times: beats.list.map(({ time }) => time), counts: beats.list.map(({ count }) => count) } } : {}),
    markers: markers.map(({ frame, name }) => ({ frame: BigInt(frame), name })),
    ...dancersMessage(project, keyMessages),
    keys: keyMessages(keys),
  };
}

/// `height`: that of the hips if a key has no place.
export function readProject(message: Message, fps: number, height: number): Project {
  const keysOf = (keys: ProjectKey[]) => keys.map(({ key, hold }): Key => ({ ...readKey(key!, fps, height), hold: Number(hold) }));
  const partner = ({ id, x, z, facing, mirrored, after, inCounts, seed, style, hasKeys, keys }: StageDancer): Partner => ({
    id, x, z, facing, mirrored, after, inCounts: inCounts || after === 0, seed: seed === undefined ? null : Number(seed), style, keys: hasKeys ? keysOf(keys) : null,
  });
  const usual = emptyProject(message.song, message.seconds ?? 0);
  return {
    ...usual,
    seed: Number(message.seed ?? usual.seed),
    style: message.style,
    dynamics: message.musicDynamics ?? usual.dynamics,
    variation: message.variation ?? usual.variation,
    beats: message.beats ? { bar: message.beats.bar, list: message.beats.times.map((time, i) => ({ time, count: message.beats!.counts[i] })) } : null,
    ...(message.controls ? readControls(message.controls) : {}),
    markers: message.markers.map(({ frame, name }) => ({ frame: Number(frame), name })),
    keys: keysOf(message.keys),
    dancers: message.dancers.map(partner),
    apart: message.apart ?? usual.apart,
  };
}
