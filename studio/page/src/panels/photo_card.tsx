// The photo with its landmarks, beside the fitted body.
import { create } from '@bufbuild/protobuf';
import { LibraryPoseSchema } from '../generated/studio/studio_pb';
import { parts } from '../project/project';
import * as studio from '../session/studio';
import type { Photo } from '../project/state';

/// Pairs of MediaPipe Pose's landmarks between which there is a bone.
const bones = [[11, 12], [11, 13], [13, 15], [12, 14], [14, 16], [11, 23], [12, 24], [23, 24], [23, 25], [25, 27], [27, 31], [24, 26], [26, 28], [28, 32]];
const seen = 0.5; // least visibility of drawn landmarks
/// The landmarks at limbs' ends, in the order of the parts after the trunk.
const ends = [[13, 15], [14, 16], [25, 27], [26, 28]];

function Seen({ photo }: { photo: Photo }) {
  const { width, height, marks } = photo;
  return (
    <svg viewBox={`0 0 ${width} ${height}`} role="img" aria-label="The photo, with the limbs that were seen in it">
      <image href={photo.url} width={width} height={height} />
      <g stroke-width={Math.max(width, height) / 70} stroke-linecap="round">
        {bones.filter((pair) => pair.every((end) => marks[end].visibility >= seen)).map(([a, b]) => (
          <line key={`${a}-${b}`} class={a % 2 && b % 2 ? 'left' : a % 2 || b % 2 ? '' : 'right'}
            x1={marks[a].x * width} y1={marks[a].y * height} x2={marks[b].x * width} y2={marks[b].y * height} />
        ))}
      </g>
    </svg>
  );
}

export function PhotoCard() {
  const { value } = studio.sketch;
  if (!value) return null;
  const { id, pose, photo } = value;
  const hidden = parts.slice(1).filter((_, limb) => ends[limb].some((end) => photo.marks[end].visibility < seen));
  const set = () => {
    const { x, y, z } = { x: pose.root[0], y: pose.root[1], z: pose.root[2] };
    const posed = create(LibraryPoseSchema, { id, pose: { rootPosition: { x, y, z }, rotations: pose.rotations } });
    studio.dropSketch();
    studio.addKey(posed);
  };
  return (
    <section class="photo" aria-label="Photo">
      <Seen photo={photo} />
      {hidden.length > 0 && <p class="small off">Hardly seen, and so made up: {hidden.join(', ')}.</p>}
      <p class="small hint">This is a guess: pull the dots until the body stands as in the photo.</p>
      <div class="row">
        <button class="primary" disabled={!studio.project.value} onClick={set}>Set as a key</button>
        <button onClick={() => {
          studio.addPose(id, pose);
          studio.dropSketch();
        }}>Add to poses</button>
        <button class="icon" aria-label="Put the photo away" onClick={studio.dropSketch}>×</button>
      </div>
    </section>
  );
}
