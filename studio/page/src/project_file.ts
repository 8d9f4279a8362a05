// A project as the program's message, which alone reads and writes its file: `choreo dance --project FILE` dances it.
import type { MessageInitShape } from '@bufbuild/protobuf';
import { keyMessage, pathMessage, readKey } from './dancer';
import type { Project as Message, ProjectKey, ProjectSchema, StageDancer } from './generated/studio/studio_pb';
import { emptyProject, trimmed } from './project';
import type { Key, Partner, Project } from './project';

/// The dancers of a project; with keys of their own as `said`.
export const dancersMessage = ({ dancers, apart }: Project, said?: (keys: Key[]) => MessageInitShape<typeof ProjectSchema>['keys']) => ({
  dancers: dancers.map(({ keys, seed, ...rest }) => ({ ...rest, seed: seed === null ? undefined : BigInt(seed), hasKeys: !!(said && keys), keys: (keys && said?.(keys)) ?? [] })),
  apart,
});

export function projectMessage(project: Project, fps: number): MessageInitShape<typeof ProjectSchema> {
  const said = (keys: Key[]) => trimmed(keys, Math.round(project.seconds * fps), fps).map((key) => ({ key: keyMessage(key), hold: BigInt(key.hold) }));
  const { song, seconds, seed, style, dynamics, variation, beats, velocities, path, markers, keys } = project;
  return {
    song, seconds, seed: BigInt(seed), style, musicDynamics: dynamics, variation, velocityFactors: velocities,
    ...(beats ? { beats: { bar: beats.bar, times: beats.list.map(({ time }) => time), counts: beats.list.map(({ count }) => count) } } : {}),
    ...(path.length ? { path: pathMessage(path) } : {}),
    markers: markers.map(({ frame, name }) => ({ frame: BigInt(frame), name })),
    ...dancersMessage(project, said),
    keys: said(keys),
  };
}

/// `height`: of the hips where a key does not say where they are.
export function readProject(said: Message, fps: number, height: number): Project {
  const keysOf = (keys: ProjectKey[]) => keys.map(({ key, hold }): Key => ({ ...readKey(key!, fps, height), hold: Number(hold) }));
  const partner = ({ id, x, z, facing, mirrored, after, inCounts, seed, style, hasKeys, keys }: StageDancer): Partner => ({
    id, x, z, facing, mirrored, after, inCounts: inCounts || after === 0, seed: seed === undefined ? null : Number(seed), style, keys: hasKeys ? keysOf(keys) : null,
  });
  const usual = emptyProject(said.song, said.seconds ?? 0);
  return {
    ...usual,
    seed: Number(said.seed ?? usual.seed),
    style: said.style,
    dynamics: said.musicDynamics ?? usual.dynamics,
    variation: said.variation ?? usual.variation,
    beats: said.beats ? { bar: said.beats.bar, list: said.beats.times.map((time, i) => ({ time, count: said.beats!.counts[i] })) } : null,
    velocities: said.velocityFactors.length ? said.velocityFactors : usual.velocities,
    path: said.path ? said.path.frames.map((frame, i) => ({ frame: Number(frame), x: said.path!.points[2 * i], z: said.path!.points[2 * i + 1] })) : [],
    markers: said.markers.map(({ frame, name }) => ({ frame: Number(frame), name })),
    keys: keysOf(said.keys),
    dancers: said.dancers.map(partner),
    apart: said.apart ?? usual.apart,
  };
}
