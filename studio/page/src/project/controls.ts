// Converts a project's controls to the API's and back, for new dances, transitions and the
// project's file.
import type { MessageInitShape } from '@bufbuild/protobuf';
import { BodyPart } from '../generated/choreo/v1/choreography_pb';
import type { Controls, ControlsSchema } from '../generated/choreo/v1/choreography_pb';
import { parts } from './project';
import type { Project } from './project';

type Asked = Pick<Project, 'path' | 'velocities'>;

const bodyParts = parts.map((_, i) => BodyPart.TRUNK + i);

/// undefined: the model decides all of them.
export function controlsMessage({ path, velocities }: Asked): MessageInitShape<typeof ControlsSchema> | undefined {
  const isUsual = velocities.every((factor) => factor === 1);
  if (isUsual && path.length === 0) return undefined;
  return {
    ...(path.length ? { rootPath: { frames: path.map(({ frame }) => BigInt(frame)), points: path.flatMap(({ x, z }) => [x, z]) } } : {}),
    ...(isUsual ? {} : { velocityFactors: { factors: velocities, parts: bodyParts } }),
  };
}

export function readControls({ rootPath, velocityFactors }: Controls): Asked {
  return {
    path: rootPath ? rootPath.frames.map((frame, i) => ({ frame: Number(frame), x: rootPath.points[2 * i], z: rootPath.points[2 * i + 1] })) : [],
    velocities: bodyParts.map((part) => velocityFactors?.factors[velocityFactors.parts.indexOf(part)] ?? 1),
  };
}
