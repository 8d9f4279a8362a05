// The timeline: the song with its beats, key poses, and playhead.
import { signal } from '@preact/signals';
import { useEffect, useRef } from 'preact/hooks';
import WaveSurfer from 'wavesurfer.js';
import { useFrameDrag } from './drag';
import { eight, isDownbeat, tempo } from '../project/counts';
import type { Pose } from '../project/body';
import { colour } from '../scene/palette';
import { displayName } from '../project/project';
import type { Key } from '../project/project';
import { FaultMarks } from './faults';
import { HitGrip } from './hit_grip';
import { HoldGrip } from './hold_grip';
import { MarkerFlags } from './marker_flags';
import { PhraseBand } from './phrase_band';
import { clock, content, edge, seconds, snapped, stepped, timeUnder, x, zoom, zoomTo } from './scale';
import * as studio from '../session/studio';

const loops = signal(false);
const isPlaying = signal(false);
const dark = matchMedia('(prefers-color-scheme: dark)');
const isDark = signal(dark.matches);
dark.addEventListener('change', () => (isDark.value = dark.matches));
const digit = 15; // pixels that a count takes
const hues = 5; // of sections (style.css)
/// The frame over which a pose is being dragged.
export const dropPose = signal<number | null>(null);

const seek = (time: number) => (studio.audio.currentTime = Math.min(Math.max(time, 0), Math.max(0, seconds() - 0.01)));

function Wave() {
  const box = useRef<HTMLDivElement>(null);
  const { value } = studio.shownSong;
  useEffect(() => {
    if (!value) return;
    const wave = WaveSurfer.create({
      container: box.current!,
      media: studio.audio,
      peaks: [value.analysis.peaks],
      duration: value.analysis.seconds,
      height: 50,
      interact: false,
      cursorWidth: 0,
      normalize: true,
      barWidth: 2,
      barGap: 1,
      barRadius: 2,
      waveColor: colour('wave'),
      progressColor: colour('wave-done'),
    });
    // Until the song plays or is sought, nothing else tells the new wave how much of it was played.
    wave.on('ready', () => studio.audio.dispatchEvent(new Event('timeupdate')));
    return () => wave.destroy();
  }, [value, zoom.value, isDark.value]);
  // As wide as the song, which may exist before the project; wavesurfer.js fails with width 0.
  const width = Math.max(1, (value?.analysis.seconds ?? 0) * zoom.value);
  return <div class="wave" ref={box} style={{ left: `${edge}px`, width: `${width}px` }} />;
}

/// Beats, bars and counts, as space permits.
function Ruler() {
  const { bar, list } = studio.beats.value;
  const room = (60 / Math.max(tempo(studio.beats.value), 1)) * zoom.value; // pixels per beat
  return list.map((beat) => {
    const isOne = beat.count === 1;
    const isCounted = beat.count > 0 && (room >= digit || (isOne && room * eight(bar) >= digit));
    return (
      <i class={`beat${isDownbeat(beat, bar) ? ' down' : ''}${isOne ? ' one' : ''}`} key={beat.time} style={{ left: `${x(beat.time)}px`, '--sure': beat.sure ?? 1 }}
        title={beat.sure === undefined ? undefined : `A beat: around it they stand out by ${Math.round(100 * beat.sure)} %`}>
        {isCounted && beat.count}
      </i>
    );
  });
}

/// Repetitions have the same letter and colour.
function Sections() {
  return studio.form.value.map(({ from, to, nth, letter, others }) => (
    <i class="section" key={from} title={`${letter}: alike at ${others.map(clock).join(', ')}`}
      style={{ left: `${x(from)}px`, width: `${(to - from) * zoom.value}px`, '--hue': `var(--form-${nth % hues})` }}>{letter}</i>
  ));
}

/// Keys that the music suggests; a press sets them.
function Suggestions() {
  return studio.suggested.value.map(({ time, pose }) => {
    const known = studio.welcome.value!.poses.find(({ id }) => id === pose);
    const name = `Suggested: ${displayName(pose)} at ${clock(time)}`;
    return known && (
      <button class="suggested" key={time} style={{ left: `${x(time)}px` }} aria-label={name} title={`${name}. Press to set it.`}
        onClick={() => studio.addKey(known, Math.round(time * studio.dancer.fps))} />
    );
  });
}

function Scrubber() {
  /// The start of the phrase being selected.
  const begun = useRef<number | null>(null);
  const slide = (event: PointerEvent) => {
    const at = event.currentTarget as HTMLElement;
    if (event.type === 'pointerdown') {
      at.setPointerCapture(event.pointerId);
      begun.current = event.shiftKey && studio.project.value ? snapped(timeUnder(event.clientX)) : null;
    } else if (!at.hasPointerCapture(event.pointerId)) return;
    if (begun.current !== null) return studio.choosePhrase(begun.current, snapped(timeUnder(event.clientX)));
    seek(timeUnder(event.clientX));
  };
  const press = (event: KeyboardEvent) => {
    const step = { ArrowLeft: -1, ArrowRight: 1, PageUp: 30, PageDown: -30 }[event.key];
    if (event.key === 'Home') seek(0);
    else if (event.key === 'End') seek(seconds());
    else if (step) seek(studio.audio.currentTime + step / studio.dancer.fps);
    else return;
    event.preventDefault();
  };
  return (
    <div class="scrubber" role="slider" tabIndex={0} aria-label="Playhead" aria-valuemin={0} aria-valuemax={Math.round(seconds())}
      aria-valuenow={0} onPointerDown={slide} onPointerMove={slide} onKeyDown={press}>
      <Sections />
      <Wave />
      <Ruler />
    </div>
  );
}

/// Warnings at their frames.
function Warnings() {
  const { fps } = studio.dancer;
  const frames = [...new Set(studio.warnings.value.map(({ frame }) => frame))];
  return frames.map((frame) => {
    const text = studio.warnings.value.filter((warning) => warning.frame === frame).map((warning) => warning.text).join('; ');
    return (
      <button class="warning" key={frame} style={{ left: `${x(frame / fps)}px` }} title={text} aria-label={`Warning at ${(frame / fps).toFixed(1)} s`}
        onClick={() => studio.notify(`${(frame / fps).toFixed(1)} s: ${text}`)}>!</button>
    );
  });
}

function KeyChip({ item, pictureOf }: { item: Key; pictureOf: (pose: Pose) => string }) {
  const { fps } = studio.dancer;
  const isSelected = studio.selectedKey.value === item.id;
  const isReplaced = dropPose.value !== null && studio.replaced(dropPose.value).includes(item);
  const choose = () => {
    if (studio.live.value) return;
    studio.selectedKey.value = item.id;
    studio.audio.pause();
    seek(item.frame / fps);
  };
  const [dragged, grab] = useFrameDrag({ from: item.frame, drop: (to) => studio.moveKey(item.id, to), press: choose });
  const frame = dragged ?? item.frame;
  // Moves the keyboard focus to a neighbouring key.
  const remove = (chip: EventTarget | null) => {
    const chips = [...document.querySelectorAll<HTMLElement>('[data-key]')];
    const at = chips.findIndex((other) => other === chip);
    studio.removeKey(item.id);
    (chips[at + 1] ?? chips[at - 1])?.focus();
  };
  const press = (event: KeyboardEvent) => {
    if (event.key === 'Enter') choose();
    else if (event.key === 'Delete' || event.key === 'Backspace') remove(event.currentTarget);
    else if (event.key === 'ArrowRight') studio.moveKey(item.id, stepped(item.frame, 1, event.shiftKey));
    else if (event.key === 'ArrowLeft') studio.moveKey(item.id, stepped(item.frame, -1, event.shiftKey));
    else return;
    event.preventDefault();
  };
  return (
    <button class={`key${isSelected ? ' selected' : ''}${item.joints ? ' partial' : ''}${isReplaced ? ' replaced' : ''}`} style={{ left: `${x(frame / fps)}px` }} data-key={item.id} data-frame={item.frame}
      aria-label={`Key ${item.id} at ${(frame / fps).toFixed(1)} s${item.joints ? `, only ${studio.inWords(item.joints, studio.skeleton.names)}` : ''}`} aria-pressed={isSelected}
      title={`${displayName(item.id)} at ${(frame / fps).toFixed(2)} s. Drag to move, press to pose.`}
      onPointerDown={grab} onKeyDown={press} onClick={(event) => event.detail === 0 && choose()}>
      <img alt="" draggable={false} src={pictureOf(item.pose)} />
    </button>
  );
}

/// The intervals between keys, for selecting.
function Intervals() {
  const { fps } = studio.dancer;
  const { keys } = studio.project.value!;
  return keys.slice(1).map((key, i) => {
    const from = keys[i].frame;
    const isChosen = studio.selection.value?.[0] === from && studio.selection.value[1] === key.frame;
    return (
      <button key={`${from}-${key.frame}`} class={isChosen ? 'interval selected' : 'interval'} aria-pressed={isChosen}
        aria-label={`Interval from ${(from / fps).toFixed(1)} to ${(key.frame / fps).toFixed(1)} s`} title="Choose this interval: loop it, or try other ways to dance it. With Shift, all up to it"
        style={{ left: `${x(from / fps)}px`, width: `${((key.frame - from) / fps) * zoom.value}px` }}
        onClick={({ shiftKey }) => {
          studio.takes.value = [];
          const { value } = studio.selection;
          if (shiftKey && value) return studio.choosePhrase(Math.min(value[0], from), Math.max(value[1], key.frame));
          studio.selection.value = isChosen ? null : [from, key.frame];
          if (!isChosen) seek(from / fps);
        }} />
    );
  });
}

function Transport({ time }: { time: preact.Ref<HTMLElement> }) {
  return (
    <div class="transport">
      <button class="play" aria-label={studio.live.value ? 'Stop' : isPlaying.value ? 'Pause' : 'Play'} title="Space" disabled={!studio.project.value} onClick={studio.togglePlay}>
        {studio.live.value ? '■' : isPlaying.value ? '❚❚' : '▶'}
      </button>
      <output ref={time as preact.Ref<HTMLOutputElement>} class="clock">0:00.0</output>
      <select aria-label="Speed" title="Speed" onChange={(event) => (studio.audio.defaultPlaybackRate = studio.audio.playbackRate = Number(event.currentTarget.value))}>
        <option value="1">1×</option>
        <option value="0.5">½×</option>
        <option value="0.25">¼×</option>
      </select>
      <button aria-pressed={loops.value} onClick={() => (loops.value = !loops.value)} title="Loop the chosen interval, or all of it">Loop</button>
      <span class="space" />
      <div class="choices" role="group" aria-label="Zoom">
        <button class="icon" aria-label="Show more of the song" onClick={() => zoomTo(zoom.value * 0.7)}>−</button>
        <button class="icon" aria-label="Show less of the song" onClick={() => zoomTo(zoom.value * 1.4)}>+</button>
      </div>
    </div>
  );
}

/// Moves the playhead with the sound, sixty times a second, without rendering.
function usePlayhead(line: preact.RefObject<HTMLElement>, time: preact.RefObject<HTMLElement>) {
  useEffect(() => {
    let next = 0;
    const tick = () => {
      next = requestAnimationFrame(tick);
      const { audio } = studio;
      if (isPlaying.value === audio.paused) isPlaying.value = !audio.paused;
      if (!studio.project.value) return;
      const [from, to] = studio.selection.value?.map((frame) => frame / studio.dancer.fps) ?? [0, seconds() - 0.05];
      if (loops.value && !audio.paused && (audio.currentTime >= to || audio.currentTime < from - 0.1)) audio.currentTime = from;
      const now = studio.now();
      const at = x(now);
      line.current!.style.transform = `translateX(${at}px)`;
      time.current!.textContent = clock(now);
      const scrubber = content.value!.querySelector('.scrubber')!;
      scrubber.setAttribute('aria-valuenow', now.toFixed(1));
      const view = content.value!.parentElement!;
      const isSeen = at > view.scrollLeft && at < view.scrollLeft + view.clientWidth * 0.9;
      if ((!audio.paused || studio.live.value) && !isSeen) view.scrollLeft = at - view.clientWidth * 0.1;
    };
    tick();
    const over = () => {
      if (loops.value) studio.togglePlay();
    };
    studio.audio.addEventListener('ended', over);
    return () => {
      cancelAnimationFrame(next);
      studio.audio.removeEventListener('ended', over);
    };
  }, []);
}

export function Timeline({ pictureOf }: { pictureOf: (pose: Pose) => string }) {
  const box = useRef<HTMLDivElement>(null);
  const line = useRef<HTMLElement>(null);
  const time = useRef<HTMLElement>(null);
  useEffect(() => {
    content.value = box.current;
  }, []);
  usePlayhead(line, time);
  // A short song fills the width; a long one scrolls.
  const length = studio.live.value ? 0 : seconds();
  useEffect(() => {
    if (length) zoom.value = Math.min(130, Math.max(48, (box.current!.parentElement!.clientWidth - 2 * edge) / length));
  }, [length]);
  const shown = studio.project.value;
  const there = (studio.live.value?.motion.count ?? studio.danced.value) / (shown ? studio.dancer.fps : 1);
  return (
    <section class="timeline" id="timeline" tabIndex={-1} aria-label="Timeline">
      <Transport time={time} />
      <div class="scroll">
        <div class="content" ref={box} style={{ width: `${2 * edge + seconds() * zoom.value}px` }}>
          <Scrubber />
          {shown && !studio.live.value && <FaultMarks />}
          <Suggestions />
          <div class="lane" role="group" aria-label="Key poses">
            {shown && <div class="danced" style={{ left: `${edge}px`, width: `${there * zoom.value}px` }} />}
            {shown && !studio.live.value && <Intervals />}
            {shown && !studio.live.value && <Warnings />}
            {shown?.keys.map((key) => <KeyChip key={key.id} item={key} pictureOf={pictureOf} />)}
            <HitGrip />
            <HoldGrip />
            {dropPose.value !== null && shown && <i class="drop" style={{ left: `${x(dropPose.value / studio.dancer.fps)}px` }} />}
          </div>
          {shown && !studio.live.value && <MarkerFlags />}
          {shown && !studio.live.value && <PhraseBand />}
          <i class="playhead" ref={line} />
        </div>
      </div>
    </section>
  );
}
