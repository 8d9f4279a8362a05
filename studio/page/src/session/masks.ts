// The joints being edited: those of some parts of the body, or those of a partial key.
import { computed, signal } from '@preact/signals';
import { BodyPart } from '../generated/choreo/v1/choreography_pb';
import { parts, displayName } from '../project/project';
import { project, selectedKey, sketch, welcome } from '../project/state';

/// For each of `parts`: whether it is being edited, unless the key determines that.
export const worked = signal(parts.map(() => true));

const partOf = (joint: number) => welcome.value!.turns[joint].part - BodyPart.TRUNK;
const joints = () => welcome.value!.turns.map((_, joint) => joint);

/// Adds a part's joints to these or removes them; null: all.
export function withPart(chosen: number[], part: number, isOn: boolean): number[] | null {
  const left = joints().filter((joint) => (partOf(joint) === part ? isOn : chosen.includes(joint)));
  return left.length === joints().length ? null : left;
}

/// The joints of those parts, in order; null: all.
export const jointsOf = (chosen: boolean[]): number[] | null =>
  chosen.every(Boolean) ? null : joints().filter((joint) => chosen[partOf(joint)]);

/// For each part, whether it has one of these joints.
export const partsOf = (chosen: number[] | null): boolean[] => parts.map((_, part) => !chosen || chosen.some((joint) => partOf(joint) === part));

/// Text: "left arm, right arm"; names joints of incomplete parts.
export function inWords(chosen: number[], names: string[]): string {
  const isWhole = (part: number) => joints().every((joint) => partOf(joint) !== part || chosen.includes(joint));
  const whole = parts.filter((_, part) => isWhole(part));
  const others = chosen.filter((joint) => !isWhole(partOf(joint))).map((joint) => displayName(names[joint]));
  return [...whole, ...others].join(', ');
}

/// The joints that may change now; null: all.
export const movable = computed<number[] | null>(() => {
  const key = sketch.value ? undefined : project.value?.keys.find(({ id }) => id === selectedKey.value);
  return key?.joints ?? jointsOf(worked.value);
});
