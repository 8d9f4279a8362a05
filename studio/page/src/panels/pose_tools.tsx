// Tools for editing the pose without dragging: by parts, by keyboard, by numbers, from other poses.
import { signal } from '@preact/signals';
import { Vector3 } from 'three';
import { turned } from '../project/body';
import type { Pose } from '../project/body';
import { HandsTool } from './hands_tool';
import { HitTool } from './hit_tool';
import { degreesOf, withDegrees } from '../project/joint_angles';
import { NumberField } from './number_field';
import { parts, displayName } from '../project/project';
import { canPull, floorHandle, handles } from '../scene/reach';
import type { Stage } from '../scene/stage';
import * as studio from '../session/studio';

const step = 0.02; // metres a press of an arrow key
const ways: Record<string, [number, number, number]> = {
  ArrowLeft: [-1, 0, 0],
  ArrowRight: [1, 0, 0],
  ArrowUp: [0, 1, 0],
  ArrowDown: [0, -1, 0],
  PageUp: [0, 0, -1],
  PageDown: [0, 0, 1],
};
/// The joint whose degrees are shown.
const joint = signal('left_shoulder');

/// The parts being edited, and whether the key is limited to them.
function Parts() {
  const key = studio.sketch.value ? undefined : studio.keyOf(studio.selectedKey.value);
  const chosen = key?.joints ? studio.partsOf(key.joints) : studio.worked.value;
  return (
    <>
      <div class="parts" role="group" aria-label="Parts that are worked on">
        {parts.map((part, i) => (
          <button key={part} aria-pressed={chosen[i]} onClick={() => studio.workOn(i, !chosen[i])}>{part}</button>
        ))}
      </div>
      {key && (
        <label class="check">
          <input type="checkbox" checked={!!key.joints} disabled={!key.joints && chosen.every(Boolean)}
            onChange={(event) => studio.fixParts(key.id, event.currentTarget.checked)} />
          Ask for these parts alone
        </label>
      )}
      {key?.joints && <p class="small">The key asks for {studio.inWords(key.joints, studio.skeleton.names)}. The model chooses the rest.</p>}
    </>
  );
}

/// Takes a library pose, or the edited parts of it.
function TakeFrom() {
  const own = studio.ownPoses(studio.skeleton.joints);
  const all = [...own, ...(studio.welcome.value?.poses ?? [])];
  return (
    <select aria-label="Take these parts from a pose" value="" onChange={(event) => {
      studio.copyPose(all[Number(event.currentTarget.value)]);
      event.currentTarget.value = '';
    }}>
      <option value="" disabled>{studio.movable.value ? 'Take these parts from …' : 'Take it from a pose …'}</option>
      {all.map((pose, i) => <option key={i} value={i}>{displayName(pose.id)}</option>)}
    </select>
  );
}

function Joints({ pose }: { pose: Pose }) {
  const { names } = studio.skeleton;
  const mask = studio.movable.value;
  const open = names.filter((_, i) => !mask || mask.includes(i));
  const name = open.includes(joint.value) ? joint.value : open[0];
  const at = studio.skeleton.find(name);
  const turn = studio.welcome.value!.turns[at];
  const { low, high } = turn;
  const degrees = degreesOf(turn, pose, at);
  const isHinge = turn.hinge.length > 0;
  const field = (label: string, axis: string, i: number) => (
    <NumberField key={`${name} ${label}`} label={label} name={`${displayName(name)}, ${axis}`} value={degrees[i]} low={low} high={high} step={1}
      rule={`The ${displayName(name)} ${isHinge ? `bends ${low} to ${high} degrees` : `turns ${low} to ${high} degrees about ${label}`}`}
      set={(value) => studio.previewEditedPose(withDegrees(turn, pose, at, degrees.map((old, axis) => (axis === i ? value : old))))} />
  );
  return (
    <details>
      <summary>Joints in degrees</summary>
      <select aria-label="Joint" value={name} onChange={(event) => (joint.value = event.currentTarget.value)}>
        {open.map((one) => <option key={one} value={one}>{displayName(one)}</option>)}
      </select>
      <div class="row">
        {isHinge ? field('bends', 'degrees that it bends', 0)
          : ['x', 'y', 'z'].map((axis, i) => field(axis, `degrees about ${axis}`, i))}
      </div>
      <p class="small">
        {isHinge ? `0 is straight, ${high} the most.`
          : `${low} to ${high} degrees: about x, which points to her left, y up and z ahead while she stands with her arms out.`}
        {' '}Arrow keys change them by 1, with Shift by 10.
      </p>
    </details>
  );
}

function Handles({ stage }: { stage: Stage | null }) {
  const nudge = (id: string) => (event: KeyboardEvent) => {
    const way = ways[event.key];
    if (!way) return;
    stage?.nudge(id, new Vector3(...way).multiplyScalar(step));
    event.preventDefault();
  };
  return (
    <details>
      <summary>Handles by keyboard</summary>
      <p class="small" id="handles-hint">On a handle, the arrow keys move it; page up and down, in depth.</p>
      <div class="row" role="application" aria-label="Handles" aria-describedby="handles-hint">
        {[...handles, floorHandle].filter((handle) => canPull(studio.skeleton, handle, studio.movable.value)).map(({ id, label }) => (
          <button key={id} onKeyDown={nudge(id)}>{label}</button>
        ))}
      </div>
    </details>
  );
}

export function PoseTools({ stage, pose }: { stage: Stage | null; pose: Pose }) {
  const change = (made: (pose: Pose) => Pose) => () => studio.setEditedPose(made(studio.editedPose()!));
  const key = studio.sketch.value ? null : studio.selectedKey.value;
  const item = studio.keyOf(key);
  // With fixed hips the whole body can neither turn nor sink.
  const areHipsFixed = !!studio.movable.value && !studio.movable.value.includes(0);
  return (
    <>
      <p class="small">Pull the dots on the body; the ring moves it over the floor.</p>
      <div class="row">
        <button onClick={studio.mirror}>Mirror</button>
        <button disabled={areHipsFixed} onClick={change((old) => studio.skeleton.grounded(old))}>To the floor</button>
        <button aria-label="Turn left" title="Turn left" class="icon" disabled={areHipsFixed} onClick={change((old) => turned(old, Math.PI / 12))}>⟲</button>
        <button aria-label="Turn right" title="Turn right" class="icon" disabled={areHipsFixed} onClick={change((old) => turned(old, -Math.PI / 12))}>⟳</button>
        {key && <button title="Add this pose to the poses, to set it elsewhere" onClick={() => studio.addPose(key, pose)}>Add to poses</button>}
        {key && <button title="Set it again at the playhead, or on the next beat (Ctrl+D)" onClick={studio.duplicateKey}>Duplicate</button>}
        {item && !studio.live.value && <button title="Come to rest in it on a last beat, and hold it to the end" onClick={() => studio.endIn(item.id)}>End in it</button>}
        {key && <button onClick={() => studio.removeKey(key)}>Remove</button>}
      </div>
      {item && <HitTool item={item} />}
      {item && <HandsTool item={item} />}
      <Parts />
      <TakeFrom />
      <Joints pose={pose} />
      <Handles stage={stage} />
    </>
  );
}
