// From where the stage is seen: the camera, the hand that turns it, and whom it follows.
import * as THREE from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import * as studio from './studio';

const middle = 0.92; // metres: what the camera looks at
const photoWidth = 272; // pixels of the stage at most (style.css)
/// What of the way is left after a second, of the camera that follows, of the zoom, and of getting up to draw.
const [following, zooming, rising] = [5e-4, 1e-5, 3e-8];

/// What the hand is at: bending a pose, or drawing on the floor.
export type Hand = 'free' | 'bends' | 'draws';

export class View {
  follows = true;
  readonly camera = new THREE.PerspectiveCamera(32, 1, 0.05, 60);
  readonly controls: OrbitControls;
  private seat: THREE.Vector3 | null = null; // from which somebody got up to draw

  constructor(private readonly canvas: HTMLCanvasElement) {
    this.camera.position.set(1.5, 1.35, 4.4);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.target.set(0, middle, 0);
    this.controls.enablePan = false;
    this.controls.minDistance = 1.2;
    this.controls.maxDistance = 14;
    this.controls.maxPolarAngle = Math.PI / 2 - 0.02;
    this.controls.enableDamping = true;
  }

  /// Where the camera looks.
  get target() {
    return this.controls.target;
  }

  /// Goes on looking at somebody, with so many metres in the picture, for so many seconds, however many pictures are made of them.
  look(at: THREE.Vector3, seconds: number, metres: number, hand: Hand) {
    const { camera, target } = this;
    const share = (left: number) => 1 - left ** seconds;
    const takes = studio.takes.value.length;
    // Takes are compared, which needs all of them in the picture.
    if ((this.follows || takes > 0) && hand !== 'bends' && !studio.drawing.value) {
      const step = new THREE.Vector3(at.x, middle, at.z).sub(target).multiplyScalar(share(following));
      target.add(step);
      camera.position.add(step);
    }
    if (hand !== 'draws') this.sit(share(rising));
    this.controls.update();
    // All dancers fit into the picture.
    const width = 2 * camera.position.distanceTo(target) * Math.tan((camera.fov * Math.PI) / 360) * camera.aspect;
    const wanted = metres ? Math.min(1, width / metres) : 1;
    if (Math.abs(wanted - camera.zoom) > 1e-3) {
      camera.zoom += (wanted - camera.zoom) * share(zooming);
      camera.updateProjectionMatrix();
    }
  }

  /// A photo lies on the left of the stage: who stands in the middle steps aside.
  stepAside() {
    const { clientWidth, clientHeight } = this.canvas;
    const shift = studio.sketch.value ? Math.round(Math.min(clientWidth * 0.38, photoWidth) / 2) : 0;
    const { view } = this.camera;
    if ((view?.enabled ? -view.offsetX : 0) === shift && (!shift || (view!.fullWidth === clientWidth && view!.fullHeight === clientHeight))) return;
    if (shift) this.camera.setViewOffset(clientWidth, clientHeight, -shift, 0, clientWidth, clientHeight);
    else this.camera.clearViewOffset();
  }

  /// Who draws on the floor looks at it from above, rests there while the hand draws, and comes back to where they sat.
  private sit(share: number) {
    const { position } = this.camera;
    if (studio.drawing.value) {
      this.seat ??= position.clone().sub(this.target);
      const aside = this.seat.clone().setY(0).setLength(3.2);
      position.lerp(aside.setY(5.2).add(this.target), share);
    } else if (this.seat) {
      const goal = this.seat.clone().add(this.target);
      if (position.lerp(goal, share).distanceTo(goal) < 0.02) this.seat = null;
    }
  }

  /// For a picture so many pixels large. A narrow one needs distance, not a cut-off body.
  fit(width: number, height: number) {
    this.camera.aspect = width / Math.max(1, height);
    this.camera.fov = this.camera.aspect < 1 ? 40 : 32;
    this.camera.updateProjectionMatrix();
  }
}
