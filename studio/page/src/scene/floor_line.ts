// The path on the stage's floor: drawn with the pointer, shown as a line with a dot per second.
import * as THREE from 'three';
import { colour } from './palette';
import type { Spot, Step } from '../project/project';

const width = 0.035; // metres
const height = 0.006; // metres above the floor, so that it stays visible
const close = 0.03; // metres between spots of a stroke

export class FloorLine {
  readonly scene = new THREE.Group();
  private stroke: Spot[] | null = null;
  private shown: unknown[] = [];
  private readonly paint = new THREE.MeshBasicMaterial({ transparent: true, opacity: 0.85, side: THREE.DoubleSide, depthWrite: false });

  /// Updates its colours from the page's.
  dress() {
    this.paint.color.set(colour('accent'));
  }
  begin(spot: Spot) {
    this.stroke = [spot];
  }
  /// Whether a stroke is being drawn.
  get isDrawn() {
    return this.stroke !== null;
  }
  add(spot: Spot) {
    const last = this.stroke?.at(-1);
    if (last && Math.hypot(last.x - spot.x, last.z - spot.z) > close) this.stroke = [...this.stroke!, spot];
  }
  end(): Spot[] {
    const done = this.stroke ?? [];
    this.stroke = null;
    return done;
  }

  /// Shows the current stroke, or else the path, with its corners instead of seconds while these are moved, `held` among them. Returns a value that
  /// changes whenever its appearance changes.
  show(path: Step[], fps: number, corners: Spot[] | null, held: number): unknown {
    const next = this.stroke ?? corners ?? path;
    const looks = [next, corners, corners && held];
    if (looks.every((look, i) => look === this.shown[i])) return this.shown;
    this.shown = looks;
    for (const part of this.scene.children) (part as THREE.Mesh).geometry.dispose();
    this.scene.clear();
    if (next.length < 2 && !corners) return this.shown;
    if (next.length > 1) this.scene.add(new THREE.Mesh(ribbon(next), this.paint));
    if (this.stroke) return this.shown;
    const dot = new THREE.CircleGeometry(0.05, 20).rotateX(-Math.PI / 2);
    const seconds = path.filter((step, i) => i === 0 || Math.floor(step.frame / fps) > Math.floor(path[i - 1].frame / fps));
    (corners ?? seconds).forEach(({ x, z }, i) => {
      const mark = new THREE.Mesh(dot, this.paint);
      mark.position.set(x, height, z);
      if (corners && i === held) mark.scale.setScalar(2);
      this.scene.add(mark);
    });
    return this.shown;
  }
}

/// A flat ribbon along the spots.
function ribbon(spots: Spot[]): THREE.BufferGeometry {
  const corners = spots.flatMap(({ x, z }, i) => {
    const [a, b] = [spots[Math.max(0, i - 1)], spots[Math.min(spots.length - 1, i + 1)]];
    const length = Math.hypot(b.x - a.x, b.z - a.z) || 1;
    const [sx, sz] = [((b.z - a.z) / length) * width * 0.5, ((a.x - b.x) / length) * width * 0.5];
    return [x + sx, height, z + sz, x - sx, height, z - sz];
  });
  const made = new THREE.BufferGeometry();
  made.setAttribute('position', new THREE.Float32BufferAttribute(corners, 3));
  made.setIndex(spots.slice(1).flatMap((_, i) => [2 * i, 2 * i + 1, 2 * i + 2, 2 * i + 1, 2 * i + 3, 2 * i + 2]));
  return made;
}
