// What is beside the stage: the chosen key, takes, style, liveliness.
import { signal } from '@preact/signals';
import { Vector3 } from 'three';
import { turned } from './body';
import type { Pose } from './body';
import { parts } from './project';
import { floorHandle, handles } from './reach';
import type { Stage } from './stage';
import * as studio from './studio';

const follows = signal(true);
const step = 0.02; // metres a press of an arrow key

const ways: Record<string, [number, number, number]> = {
  ArrowLeft: [-1, 0, 0],
  ArrowRight: [1, 0, 0],
  ArrowUp: [0, 1, 0],
  ArrowDown: [0, -1, 0],
  PageUp: [0, 0, -1],
  PageDown: [0, 0, 1],
};

function KeyPanel({ stage }: { stage: Stage | null }) {
  const key = studio.keyOf(studio.selectedKey.value);
  if (!key) {
    return (
      <section aria-label="Key">
        <h2>Key</h2>
        <p class="small">Press a pose on the timeline to bend it by its hands, feet, hips and head.</p>
      </section>
    );
  }
  const change = (made: (pose: Pose) => Pose) => () => studio.poseKey(key.id, made(key.pose));
  const nudge = (id: string) => (event: KeyboardEvent) => {
    const way = ways[event.key];
    if (!way) return;
    stage?.nudge(id, new Vector3(...way).multiplyScalar(step));
    event.preventDefault();
  };
  return (
    <section aria-label="Key">
      <h2>{key.id.replaceAll('_', ' ')} <small>{(key.frame / studio.dancer.fps).toFixed(2)} s</small></h2>
      <p class="small">Pull the dots on the body; the ring moves it over the floor.</p>
      <div class="row">
        <button onClick={change((pose) => studio.skeleton.mirrored(pose))}>Mirror</button>
        <button onClick={change((pose) => studio.skeleton.grounded(pose))}>To the floor</button>
        <button aria-label="Turn left" title="Turn left" class="icon" onClick={change((pose) => turned(pose, Math.PI / 12))}>⟲</button>
        <button aria-label="Turn right" title="Turn right" class="icon" onClick={change((pose) => turned(pose, -Math.PI / 12))}>⟳</button>
        <button onClick={() => studio.removeKey(key.id)}>Remove</button>
      </div>
      <details>
        <summary>Handles by keyboard</summary>
        <p class="small">On a handle, the arrow keys move it; page up and down, in depth.</p>
        <div class="row">
          {[...handles, floorHandle].map(({ id, label }) => (
            <button key={id} onKeyDown={nudge(id)}>{label}</button>
          ))}
        </div>
      </details>
    </section>
  );
}

function TakesPanel() {
  const takes = studio.takes.value;
  const interval = studio.chosen.value;
  const { fps } = studio.dancer ?? { fps: 30 };
  return (
    <section aria-label="Takes">
      <h2>Takes</h2>
      <p class="small">
        {interval
          ? `Of the interval from ${(interval[0] / fps).toFixed(1)} to ${(interval[1] / fps).toFixed(1)} s; the rest stays.`
          : 'Of the whole dance. Choose an interval under the keys to change it alone.'}
      </p>
      <div class="row">
        {takes.length === 0
          ? <button class="primary" disabled={!studio.moment.value} onClick={() => void studio.tryTakes()}>Try 3 more</button>
          : <>
              <button onClick={() => (studio.takes.value = [])}>Keep A</button>
              {takes.map((take, i) => <button key={i} class="primary" onClick={() => studio.keepTake(take)}>Keep {'BCDEFG'[i]}</button>)}
            </>}
      </div>
    </section>
  );
}

/// How to dance: a style of the model's, where it has any.
function StylePanel() {
  const styles = studio.welcome.value?.model?.styles ?? [];
  if (styles.length === 0) return null;
  const { value } = studio.project;
  return (
    <section aria-label="Style">
      <h2>Style</h2>
      <select aria-label="How to dance" disabled={!value} value={value?.style ?? ''}
        onChange={(event) => studio.change({ style: event.currentTarget.value })}>
        <option value="">as it comes</option>
        {styles.map((style) => <option key={style} value={style}>{style}</option>)}
      </select>
    </section>
  );
}

function LivelyPanel() {
  if (!studio.canBeLively()) return null;
  const { value } = studio.project;
  const set = (part: number, factor: number) =>
    studio.change({ lively: value.lively.map((old, i) => (i === part ? factor : old)) });
  return (
    <section aria-label="Liveliness">
      <h2>Liveliness</h2>
      {parts.map((part, i) => (
        <label class="slider" key={part}>
          <span>{part}</span>
          <input type="range" min="0.2" max="2" step="0.1" disabled={!value} value={value?.lively[i] ?? 1}
            onChange={(event) => set(i, Number(event.currentTarget.value))} />
          <output>{(value?.lively[i] ?? 1).toFixed(1)}</output>
        </label>
      ))}
    </section>
  );
}

export function Panels({ stage }: { stage: Stage | null }) {
  return (
    <aside class="panels" aria-label="Settings">
      <KeyPanel stage={stage} />
      <TakesPanel />
      <StylePanel />
      <LivelyPanel />
      <section aria-label="View">
        <label class="check">
          <input type="checkbox" checked={follows.value} onChange={(event) => {
            follows.value = event.currentTarget.checked;
            if (stage) stage.follows = follows.value;
          }} />
          The camera follows
        </label>
      </section>
    </aside>
  );
}
