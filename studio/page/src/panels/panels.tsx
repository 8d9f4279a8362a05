// The panels beside the stage: selected key, takes, beats, music, style, velocity.
import { signal } from '@preact/signals';
import { confidence, tempo } from '../project/counts';
import { DancersPanel } from './dancers_panel';
import { FaultsPanel } from '../timeline/faults';
import { KeepTake } from './keep_take';
import { MarkersPanel } from './markers_panel';
import { PathPoints } from './path_points';
import { PhrasePanel } from './phrase_panel';
import { PoseTools } from './pose_tools';
import { parts, displayName } from '../project/project';
import type { Stage } from '../scene/stage';
import * as studio from '../session/studio';

const follows = signal(true);
const brisk = 2.5; // metres a second; few dancers keep this up

function KeyPanel({ stage }: { stage: Stage | null }) {
  const pose = studio.editedPose();
  const key = studio.sketch.value ? null : studio.keyOf(studio.selectedKey.value);
  return (
    <section aria-label="Key">
      <h2>
        {studio.sketch.value ? 'Photo' : key ? displayName(key.id) : 'Key'}
        {key && <small> {(key.frame / studio.dancer.fps).toFixed(2)} s</small>}
      </h2>
      {pose
        ? <PoseTools stage={stage} pose={pose} />
        : <p class="small">Press a pose on the timeline to bend it by its hands, feet, hips and head.</p>}
    </section>
  );
}

function TakesPanel() {
  const takes = studio.takes.value;
  const interval = studio.selection.value;
  const { fps } = studio.dancer ?? { fps: 30 };
  return (
    <section aria-label="Takes">
      <h2>Takes</h2>
      <p class="small">
        {interval
          ? `Of the phrase from ${(interval[0] / fps).toFixed(1)} to ${(interval[1] / fps).toFixed(1)} s; the rest stays.`
          : 'Of the whole dance. Choose an interval under the keys, or a phrase, to change it alone.'}
      </p>
      <div class="row">
        {takes.length === 0
          ? <>
              <button class="primary" disabled={!studio.moment.value} onClick={() => void studio.tryTakes()}>Try 3 more</button>
              {interval && <button onClick={() => void studio.tryTheRest()}>Freeze it, try the rest</button>}
            </>
          : [...Array(takes.length + 1).keys()].map((nth) => <KeepTake key={nth} nth={nth} />)}
      </div>
    </section>
  );
}

/// The style, if the model has any.
function StylePanel() {
  const styles = studio.welcome.value?.model?.styles ?? [];
  if (styles.length === 0) return null;
  const shown = studio.welcome.value?.stylesShown;
  const hidden = studio.welcome.value?.model?.styleRecognition?.shows === false;
  const options = styles.map((style) => <option key={style} value={style}>{style}</option>);
  const { value } = studio.project;
  return (
    <section aria-label="Style">
      <h2>Style</h2>
      <select aria-label="How to dance" disabled={!value} value={value?.style ?? ''}
        onChange={(event) => studio.change({ style: event.currentTarget.value })}>
        <option value="">none in particular</option>
        {hidden ? <optgroup label="These do not show">{options}</optgroup> : options}
      </select>
      <p class="small">{shown}</p>
    </section>
  );
}

type SliderProps = { name: string; title?: string; low: number; high: number; value: number; isFixed?: boolean; set: (value: number) => void };

function Slider({ name, title, low, high, value, isFixed = !studio.project.value, set }: SliderProps) {
  return (
    <label class="slider" title={title}>
      <span>{name}</span>
      <input type="range" min={low} max={high} step="0.1" disabled={isFixed} value={value}
        onChange={(event) => set(Number(event.currentTarget.value))} />
      <output>{value.toFixed(1)}</output>
    </label>
  );
}

/// How the dance follows the music.
function MusicPanel() {
  if (!studio.canHear()) return null;
  const { dynamics, variation } = studio.following.value;
  const isFixed = !!studio.live.value;
  return (
    <section aria-label="Music">
      <h2>Music</h2>
      <Slider name="energy" title="How much the music's energy shapes the dance" low={0} high={1} value={dynamics} isFixed={isFixed}
        set={(next) => studio.follow({ dynamics: next })} />
      <Slider name="variation" title="How much the dance differs when the music returns" low={0} high={1} value={variation} isFixed={isFixed}
        set={(next) => studio.follow({ variation: next })} />
      {isFixed && <p class="small">Set before a live dance begins.</p>}
    </section>
  );
}

/// Editing beats.
function BeatsPanel() {
  const { value } = studio.project;
  const { beats, taps } = studio;
  const { live } = studio;
  if (!value || !(studio.shownSong.value || live.value)) return null;
  const isNone = beats.value.list.length === 0;
  const sure = confidence(beats.value);
  const pace = live.value?.hint.pace;
  return (
    <section aria-label="Beats">
      <h2>Beats <small title={sure === null ? undefined : 'How much more sound begins on them than elsewhere; not how likely they are to be right'}>
        {isNone ? 'none heard' : `${tempo(beats.value).toFixed(1)} a minute${sure === null ? '' : `, they stand out by ${sure} %`}`}
      </small></h2>
      <div class="row">
        <button title="Tap along while it plays (T)" aria-pressed={taps.value.length > 0} onClick={studio.tap}>
          {taps.value.length > 0 ? `Tap ${taps.value.length}` : 'Tap'}
        </button>
        <div class="choices" role="group" aria-label="Tempo">
          <button disabled={isNone || pace === 'half'} title="Every second beat alone" onClick={studio.halveBeats}>Halve</button>
          <button disabled={isNone || pace === 'double'} title="One between two beats, too" onClick={studio.doubleBeats}>Double</button>
        </div>
        <div class="choices" role="group" aria-label="When">
          <button disabled={isNone} aria-label="Beats 10 ms earlier" title="10 ms earlier" onClick={() => studio.nudgeBeats(-1)}>◂</button>
          <button disabled={isNone} aria-label="Beats 10 ms later" title="10 ms later" onClick={() => studio.nudgeBeats(1)}>▸</button>
        </div>
        <button disabled={isNone} title={live.value ? 'The beat that sounds now is the first of a bar' : 'The beat at the playhead is the first of a bar'} onClick={studio.countFromHere}>This is 1</button>
        {(live.value ? !studio.isAsHeard() : value.beats) && <button title="Back to the beats that were heard" onClick={studio.hearBeats}>As heard</button>}
      </div>
    </section>
  );
}

function VelocityPanel() {
  if (!studio.takesVelocities()) return null;
  const { value } = studio.project;
  const set = (part: number, factor: number) =>
    studio.change({ velocities: value.velocities.map((old, i) => (i === part ? factor : old)) });
  return (
    <section aria-label="Velocity">
      <h2>Velocity</h2>
      {parts.map((part, i) => (
        <Slider key={part} name={part} low={0.2} high={2} value={value?.velocities[i] ?? 1} set={(factor) => set(i, factor)} />
      ))}
    </section>
  );
}

/// The floor path.
function PathPanel() {
  if (!studio.canBeLed()) return null;
  const { value } = studio.project;
  const path = value?.path ?? [];
  const { fps } = studio.dancer;
  const [from, to] = path.length ? [path[0].frame, path.at(-1)!.frame] : [0, 1];
  const pace = (studio.lengthOf(path) * fps) / (to - from);
  const time = (label: string, frame: number, set: (frame: number) => void) => (
    <label class="time">
      <span>{label}</span>
      <input type="number" min="0" max={(value.seconds - 1 / fps).toFixed(1)} step="0.5" value={(frame / fps).toFixed(1)} onChange={(event) => {
        const seconds = event.currentTarget.valueAsNumber;
        if (seconds >= 0 && seconds <= value.seconds) set(Math.min(Math.round(seconds * fps), studio.total.value - 1));
      }} />
      <span>s</span>
    </label>
  );
  return (
    <section aria-label="Floor path">
      <h2>Floor path</h2>
      {path.length === 0
        ? <p class="small">Draw where the dancer goes, or set its points: in the chosen interval, or from the playhead to the end.</p>
        : <p class={pace > brisk ? 'small off' : 'small'}>{studio.lengthOf(path).toFixed(1)} m, {pace.toFixed(1)} m/s{pace > brisk ? ': faster than people dance. Give it more time.' : ''}</p>}
      {path.length > 0 && <div class="row">{time('from', from, (frame) => studio.rush(frame, to))}{time('to', to, (frame) => studio.rush(from, frame))}</div>}
      <div class="row">
        <button aria-pressed={studio.drawing.value} disabled={!value} onClick={() => {
          studio.drawing.value = !studio.drawing.value;
          // On phones the floor is further up the page.
          if (studio.drawing.value) document.querySelector('.stage')!.scrollIntoView({ block: 'nearest' });
        }}>
          {studio.drawing.value ? 'Draw on the floor …' : path.length ? 'Draw another' : 'Draw a path'}
        </button>
        {path.length > 0 && <button onClick={studio.clearPath}>Clear</button>}
      </div>
      <PathPoints />
    </section>
  );
}

/// The state of a live dance.
function LivePanel() {
  return (
    <section aria-label="Live">
      <h2>Live</h2>
      <meter class="level" min="0" max="1" value={studio.level.value} aria-label="How loud it is" />
      <p class="small">Press a pose: she takes it on a beat soon. Or drag it to an empty part of the timeline.</p>
      <div class="row"><button class="primary" onClick={() => void studio.stopLive()}>Stop</button></div>
      <p class="small">The recording becomes the song, and the dance stays.</p>
    </section>
  );
}

export function Panels({ stage }: { stage: Stage | null }) {
  if (studio.live.value) return <aside class="panels" aria-label="Settings"><LivePanel /><BeatsPanel /><MusicPanel /></aside>;
  return (
    <aside class="panels" aria-label="Settings">
      <KeyPanel stage={stage} />
      <FaultsPanel />
      <PhrasePanel />
      <MarkersPanel />
      <TakesPanel />
      <DancersPanel />
      <PathPanel />
      <BeatsPanel />
      <MusicPanel />
      <StylePanel />
      <VelocityPanel />
      <section aria-label="View">
        <h2>View</h2>
        <label class="check">
          <input type="checkbox" checked={follows.value} onChange={(event) => {
            follows.value = event.currentTarget.checked;
            if (stage) stage.view.follows = follows.value;
          }} />
          The camera follows
        </label>
        <div class="choices" role="group" aria-label="Onion skin">
          {(['off', 'keys', 'frames'] as const).map((way) => (
            <button key={way} aria-pressed={studio.onion.value === way} onClick={() => (studio.onion.value = way)}>
              {{ off: 'No onion skin', keys: 'Keys', frames: 'Frames' }[way]}
            </button>
          ))}
        </div>
      </section>
    </aside>
  );
}
