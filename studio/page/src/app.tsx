// The page: bar, stage, poses, panels, timeline.
import { effect, signal } from '@preact/signals';
import { useEffect, useRef } from 'preact/hooks';
import type { Pose } from './project/body';
import { tempo } from './project/counts';
import { Doll } from './scene/doll';
import { KeepTake } from './panels/keep_take';
import { Library } from './panels/library';
import { Panels } from './panels/panels';
import { PhotoCard } from './panels/photo_card';
import { Pictures } from './scene/pictures';
import { Stage } from './scene/stage';
import * as studio from './session/studio';
import { Timeline } from './timeline/timeline';

export const stage = signal<Stage | null>(null);
export const pictures = signal<Pictures | null>(null);
const marks = signal<{ x: number; y: number }[]>([]);
export const pictureOf = (pose: Pose) => pictures.value?.of(pose) ?? '';

/// The pose being edited: a photo's, or the selected key's while the playhead is on it.
function posed(): Pose | null {
  if (studio.live.value) return null;
  if (studio.sketch.value && studio.audio.paused) return studio.sketch.value.pose;
  const key = studio.keyOf(studio.selectedKey.value);
  if (!key || !studio.audio.paused) return null;
  const away = Math.abs(studio.audio.currentTime - key.frame / studio.dancer.fps);
  return away < 0.02 ? studio.editedPose()! : null;
}

function View() {
  const canvas = useRef<HTMLCanvasElement>(null);
  useEffect(() => effect(() => {
    const { value } = studio.welcome;
    if (!value || stage.peek()) return;
    void Doll.load(value.body, studio.skeleton).then((doll) => {
      pictures.value = new Pictures(doll.another());
      const made = new Stage(canvas.current!, doll, posed, (places) => {
        if (places.length || marks.peek().length) marks.value = places;
      });
      made.onPosed = studio.setEditedPose;
      stage.value = made;
    });
  }), []);
  const takes = studio.takes.value;
  return (
    <main class="stage" id="stage" tabIndex={-1} aria-label="Stage">
      <canvas ref={canvas} class={studio.drawing.value ? 'drawing' : ''} tabIndex={0} role="img" aria-label="The dancer. Drag to look around; drag a handle of a chosen key to pose it." />
      {takes.length > 0 && marks.value.map(({ x, y }, i) => i <= takes.length && (
        <span class="mark" style={{ left: `${x}px`, top: `${y}px` }} key={i}><KeepTake nth={i} /></span>
      ))}
      {!studio.project.value && !studio.sketch.value && <Welcome />}
      <PhotoCard />
      <Progress />
    </main>
  );
}

function Welcome() {
  return (
    <div class="welcome">
      <h1>Drop a song here</h1>
      <p>She dances to it immediately, through poses on its beats. Then make it yours: move poses, bend them, add others.</p>
      <div class="row">
        <FileButton label="Choose a song" primary />
        {studio.canHear() && <button onClick={() => void studio.startLive()}>Use the microphone</button>}
      </div>
      <p class="small">WAV, FLAC, Ogg or MP3. Nothing leaves this machine.</p>
    </div>
  );
}

function Progress() {
  const [there, all] = [studio.danced.value, studio.total.value];
  if (studio.filming.value) {
    const { share, left } = studio.filming.value;
    return (
      <div class="progress filming" role="status">
        filming … {Math.round(100 * share)} %{left && `, ${left} left`} <button onClick={studio.leaveFilm}>Cancel</button>
      </div>
    );
  }
  if (!studio.busy.value) return null;
  const share = all ? Math.min(100, Math.round((100 * there) / all)) : 0;
  return <div class="progress" role="status">{there < all && there > 0 ? `dancing … ${share} %` : 'working …'}</div>;
}

function FileButton({ label, primary = false }: { label: string; primary?: boolean }) {
  const input = useRef<HTMLInputElement>(null);
  return (
    <>
      <button class={primary ? 'primary' : ''} onClick={() => input.current!.click()}>{label}</button>
      <input ref={input} type="file" hidden aria-label={label} accept={studio.accepted} multiple
        onChange={(event) => {
          const files = [...event.currentTarget.files!];
          event.currentTarget.value = '';
          if (files.length) void studio.openFiles(files);
        }} />
    </>
  );
}

function Bar() {
  const { shownSong: song, moments, momentIndex: present, message, isConnected, live } = studio;
  const shown = message.value;
  return (
    <header>
      <strong class="name">Choreo <span>studio</span></strong>
      <span class="song">
        {song.value ? `${song.value.name} · ${Math.round(tempo(studio.beats.value))} beats a minute` : live.value ? 'live' : isConnected.value ? '' : 'connecting …'}
      </span>
      <nav aria-label="Project">
        <button class="icon" aria-label="Undo" title="Undo (Ctrl+Z)" disabled={present.value < 1 || !!live.value} onClick={studio.undo}>↶</button>
        <button class="icon" aria-label="Redo" title="Redo (Ctrl+Shift+Z)" disabled={present.value >= moments.value.length - 1 || !!live.value} onClick={studio.redo}>↷</button>
        <FileButton label="Open" />
        {studio.canHear() && <button class="icon live" aria-pressed={!!live.value} aria-label="Dance to the microphone" title="Dance to the microphone"
          onClick={() => void (live.value ? studio.stopLive() : studio.startLive())}>●</button>}
        <button disabled={!studio.moment.value || !!live.value} onClick={studio.saveProject}>Save</button>
        <label class="export">
          <span class="hidden">Export the dance</span>
          <select disabled={!studio.moment.value || !!live.value} value="" onChange={(event) => {
            const { value } = event.currentTarget;
            if (value === 'webm' || value === 'mp4') void (stage.value && studio.exportFilm(value, stage.value));
            else void studio.exportAs(value);
            event.currentTarget.value = '';
          }}>
            <option value="" disabled>Export …</option>
            <option value="glb">glTF, with the body (.glb)</option>
            <option value="bvh">BVH (.bvh)</option>
            <option value="npz">SMPL, as AMASS (.npz)</option>
            <option value="mp4">Film, with the song (.mp4)</option>
            <option value="webm">Film, with the song (.webm)</option>
          </select>
        </label>
      </nav>
      {shown && (
        <div class={shown.isError ? 'message error' : 'message'} role={shown.isError ? 'alert' : 'status'}>
          {shown.text}
          <button class="icon" aria-label="Close this message" onClick={() => (message.value = null)}>×</button>
        </div>
      )}
    </header>
  );
}

/// The button that the pointer pressed, as long as it has the focus.
let pressed: Element | null = null;
/// Whether Space plays while this element has the focus. It presses buttons, but not one that the pointer has just pressed, like a pose; keys,
/// intervals, markers and suggestions react to Enter.
const playsOn = (at: HTMLElement) => !at.matches('button') || at === pressed || at.matches('.key, .interval, .marker, .suggested');

function useKeyboard() {
  useEffect(() => {
    const press = (event: KeyboardEvent) => {
      const at = event.target as HTMLElement;
      const withControl = event.ctrlKey || event.metaKey;
      // Sliders and boxes have no undo of their own, sliders no use for Space.
      const types = at.matches('input, select') && !(withControl && at.matches('[type=range], [type=checkbox]')) && !(event.key === ' ' && at.matches('[type=range]'));
      if (event.defaultPrevented || types) return;
      const key = event.key.toLowerCase();
      if (event.repeat && 'tm'.includes(key)) return; // a key that is held is one tap, and one marker
      if (event.key === ' ' && playsOn(at)) studio.togglePlay();
      else if (key === 't' && !withControl && (studio.shownSong.value || studio.live.value) && studio.project.value) studio.tap();
      else if (key === 'm' && !withControl) studio.addMarker();
      else if (withControl && key === 'z') event.shiftKey ? studio.redo() : studio.undo();
      else if (withControl && key === 'd' && studio.selectedKey.value) studio.duplicateKey();
      else if (withControl && key === 'v') studio.pasteKeys();
      else if (withControl && key === 'c') {
        if (!getSelection()?.isCollapsed || !studio.copyKeys()) return;
      }
      else if (event.key === 'Escape') {
        [studio.selectedKey.value, studio.selection.value, studio.takes.value] = [null, null, []];
        studio.dropSketch();
        studio.drawing.value = false;
      }
      else if (event.key === 'Delete' && studio.selectedKey.value) studio.removeKey(studio.selectedKey.value);
      else if (event.key === 'Delete' && studio.selection.value) studio.removePhrase();
      else return;
      event.preventDefault();
    };
    // Some browsers press a button when Space is released.
    const release = (event: KeyboardEvent) => {
      const at = event.target as HTMLElement;
      if (event.key === ' ' && at.matches('button') && playsOn(at)) event.preventDefault();
    };
    const point = ({ target }: Event) => (pressed = (target as Element).closest('button'));
    const focus = ({ target }: Event) => {
      if (target !== pressed) pressed = null;
    };
    const listening = new AbortController();
    const { signal } = listening;
    window.addEventListener('keydown', press, { signal });
    window.addEventListener('keyup', release, { signal });
    window.addEventListener('pointerdown', point, { signal, capture: true });
    window.addEventListener('focusin', focus, { signal });
    return () => listening.abort();
  }, []);
}

export function App() {
  useKeyboard();
  return (
    <div class="page" onDragOver={(event) => event.preventDefault()} onDrop={(event) => {
      event.preventDefault();
      const files = [...(event.dataTransfer?.files ?? [])];
      if (files.length) void studio.openFiles(files);
    }}>
      <a class="skip" href="#stage">Skip to the stage</a>
      <a class="skip" href="#timeline">Skip to the timeline</a>
      <Bar />
      <Library pictureOf={pictureOf} />
      <View />
      <Panels stage={stage.value} />
      <Timeline pictureOf={pictureOf} />
    </div>
  );
}
