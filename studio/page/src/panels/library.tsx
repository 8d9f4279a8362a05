// Key poses to choose from: the library's and the user's own.
import { signal } from '@preact/signals';
import { Fragment } from 'preact';
import type { Pose } from '../project/body';
import { drag } from '../timeline/drag';
import type { LibraryPose } from '../generated/studio/studio_pb';
import { displayName } from '../project/project';
import * as studio from '../session/studio';
import { frameUnder } from '../timeline/scale';
import { dropPose } from '../timeline/timeline';

/// Kinds of poses: their headings, and short names to go there.
const stances: Record<string, [string, string]> = {
  standing: ['Standing', 'Stand'], travelling: ['Travelling', 'Travel'], jump: ['In the air', 'Jump'], floor: ['On the floor', 'Floor'],
};
const placeOf = (stance: string) => `poses-${stance}`;
const goTo = (stance: string) => {
  const isRow = matchMedia('(max-width: 900px)').matches; // poses stand in a row on phones (style.css)
  document.getElementById(placeOf(stance))!.scrollIntoView({ block: isRow ? 'nearest' : 'start', inline: 'start' });
};
const carried = signal<{ pose: LibraryPose; x: number; y: number } | null>(null);

/// Drags a pose with the pointer until it is dropped.
const carry = (pose: LibraryPose) => (event: PointerEvent) => {
  const from = { x: event.clientX, y: event.clientY };
  drag(event, (at) => {
    const { clientX: x, clientY: y } = at;
    if (carried.value || Math.hypot(x - from.x, y - from.y) > 6) carried.value = { pose, x, y };
    dropPose.value = carried.value ? frameUnder(at) : null;
  }, (isDropped) => {
    const at = carried.value && isDropped ? dropPose.value : null;
    if (at !== null) studio.addKey(pose, at);
    setTimeout(() => (carried.value = null));
    dropPose.value = null;
  }, window);
};

const standing = ({ pose }: LibraryPose): Pose => ({ root: [0, pose!.rootPosition!.y, 0], rotations: pose!.rotations });

type Props = { pictureOf: (pose: Pose) => string };

function Item({ pose, isOwn, pictureOf }: Props & { pose: LibraryPose; isOwn: boolean }) {
  return (
    <li>
      <button title={pose.description} disabled={!studio.project.value} onPointerDown={carry(pose)}
        onClick={() => !carried.value && studio.addKey(pose)}>
        <img alt="" draggable={false} src={pictureOf(standing(pose))} />
        <span>{displayName(pose.id)}</span>
      </button>
      {isOwn && <button class="icon forget" aria-label={`Forget ${pose.id}`} title="Forget this pose" onClick={() => studio.forgetPose(pose.id)}>×</button>}
    </li>
  );
}

export function Library({ pictureOf }: Props) {
  const poses = studio.welcome.value?.poses ?? [];
  const own = studio.welcome.value ? studio.ownPoses(studio.skeleton.joints) : [];
  return (
    <aside class="library" aria-label="Poses">
      <div class="row head">
        <h2>Poses</h2>
        <div class="choices stances" role="group" aria-label="Kinds of poses">
          {Object.entries(stances).map(([stance, [heading, name]]) => (
            <button key={stance} title={`Poses ${heading.toLowerCase()}`} disabled={poses.length === 0} onClick={() => goTo(stance)}>{name}</button>
          ))}
        </div>
        <button disabled={!studio.shownSong.value || !studio.moment.value} onClick={() => void studio.compose().catch(studio.showError)}
          title="Other poses of the library on the song's beats">New poses</button>
      </div>
      <p class="small">Drag one onto the timeline, or press it to set it at the playhead. Drop a photo to make your own.</p>
      <ul>
        {own.map((pose) => <Item key={`own ${pose.id}`} pose={pose} isOwn pictureOf={pictureOf} />)}
        {poses.map((pose, i) => (
          <Fragment key={pose.id}>
            {pose.stance !== poses[i - 1]?.stance && <li class="stance" id={placeOf(pose.stance)}><h3>{stances[pose.stance]?.[0]}</h3></li>}
            <Item pose={pose} isOwn={false} pictureOf={pictureOf} />
          </Fragment>
        ))}
      </ul>
      {carried.value && (
        <img class="carried" alt="" style={{ left: `${carried.value.x}px`, top: `${carried.value.y}px` }} src={pictureOf(standing(carried.value.pose))} />
      )}
    </aside>
  );
}
