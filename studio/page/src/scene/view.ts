// The camera: its controls, and whom it follows.
import * as THREE from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import * as studio from '../session/studio';

const middle = 0.92; // metres: height of the camera's target
const photoWidth = 272; // pixels of the stage at most (style.css)
const nearest = 0.95; // share of the camera's distance at which dancers around the middle are still fitted in
/// The share of a movement left after a second: of following, of zooming, and of rising for drawing.
const [following, zooming, rising] = [5e-4, 1e-5, 3e-8];

/// What the pointer does: nothing, editing a pose, or drawing on the floor.
export type Hand = 'free' | 'bends' | 'draws';

export class View {
  follows = true;
  readonly camera = new THREE.PerspectiveCamera(32, 1, 0.05, 60);
  readonly controls: OrbitControls;
  private seat: THREE.Vector3 | null = null; // the camera's place before drawing

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

  /// The camera's target.
  get target() {
    return this.controls.target;
  }

  /// Follows a dancer for this time with these metres in view, independently of the frame rate.
  look(at: THREE.Vector3, seconds: number, metres: number, hand: Hand) {
    const { camera, target } = this;
    const share = (left: number) => 1 - left ** seconds;
    const takes = studio.takes.value.length;
    // Comparing takes needs all of them in view.
    if ((this.follows || takes > 0) && hand !== 'bends' && !studio.drawing.value) {
      const step = new THREE.Vector3(at.x, middle, at.z).sub(target).multiplyScalar(share(following));
      target.add(step);
      camera.position.add(step);
    }
    if (hand !== 'draws') this.sit(share(rising));
    this.controls.update();
    // Fits all dancers into the picture. Those between the camera and the middle look wider; takes stand beside each other.
    const distance = camera.position.distanceTo(target);
    const width = 2 * distance * Math.tan((camera.fov * Math.PI) / 360) * camera.aspect;
    const nearness = takes > 0 ? 0 : Math.min(nearest, metres / 2 / distance);
    const wanted = metres ? Math.min(1, (width / metres) * Math.sqrt(1 - nearness ** 2)) : 1;
    if (Math.abs(wanted - camera.zoom) > 1e-3) {
      camera.zoom += (wanted - camera.zoom) * share(zooming);
      camera.updateProjectionMatrix();
    }
  }

  /// Shifts the view, as a photo covers the left of the stage.
  stepAside() {
    const { clientWidth, clientHeight } = this.canvas;
    const shift = studio.sketch.value ? Math.round(Math.min(clientWidth * 0.38, photoWidth) / 2) : 0;
    const { view } = this.camera;
    if ((view?.enabled ? -view.offsetX : 0) === shift && (!shift || (view!.fullWidth === clientWidth && view!.fullHeight === clientHeight))) return;
    if (shift) this.camera.setViewOffset(clientWidth, clientHeight, -shift, 0, clientWidth, clientHeight);
    else this.camera.clearViewOffset();
  }

  /// Raises the camera for drawing on the floor, holds it while drawing, and returns it afterwards.
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

  /// Adapts to a picture of this size; a narrow one is seen from further away, so that it does not cut off the body.
  fit(width: number, height: number) {
    this.camera.aspect = width / Math.max(1, height);
    this.camera.fov = this.camera.aspect < 1 ? 40 : 32;
    this.camera.updateProjectionMatrix();
  }
}
