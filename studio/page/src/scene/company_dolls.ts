// The other dancers on the stage, beside the one whose dance is edited.
import * as THREE from 'three';
import type { Doll } from './doll';
import type { Motion } from '../project/motion';
import { colour, shirtOf } from './palette';
import * as studio from '../session/studio';

const room = 1; // metres visible around each dancer

export class CompanyDolls {
  readonly scene = new THREE.Group();
  private readonly dolls: Doll[] = [];
  private readonly place = new THREE.Vector3();

  constructor(private readonly doll: Doll) {}

  /// Whether no dancer has exactly the edited dance: all are mirrored, delayed or different.
  get hasNoLead() {
    return studio.cast.value.length > 0 && !studio.cast.value.some(({ isLead }) => isLead);
  }

  /// Shows the dancers, unless takes are compared. Sets `middle` to the middle of all dancers; returns the metres that the picture must show, 0 for
  /// one dancer.
  show(motion: Motion | undefined, time: number, middle: THREE.Vector3): number {
    const cast = motion && studio.takes.value.length === 0 ? studio.cast.value : [];
    const all = cast.filter(({ isLead }) => !isLead);
    while (this.dolls.length < all.length) {
      this.dolls.push(this.doll.another().wear(colour(shirtOf(this.dolls.length + 1))));
      this.scene.add(this.dolls.at(-1)!.scene);
    }
    const places = all.length < cast.length ? [this.doll.place().clone()] : [];
    this.dolls.forEach(({ scene }, i) => (scene.visible = i < all.length));
    all.forEach(({ motion: own, after, mirrored, x, z, facing }, i) => {
      const { scene } = this.dolls[i];
      this.dolls[i].follow(own ?? motion!, Math.max(0, time - after), mirrored);
      scene.position.set(x, 0, z);
      scene.rotation.y = facing;
      places.push(this.place.copy(this.dolls[i].place()).applyAxisAngle(THREE.Object3D.DEFAULT_UP, facing).add(scene.position).clone());
    });
    if (all.length === 0) return 0;
    middle.set(0, 0, 0);
    for (const place of places) middle.addScaledVector(place, 1 / places.length);
    return 2 * Math.max(...places.map((place) => Math.hypot(place.x - middle.x, place.z - middle.z))) + 2 * room;
  }
}
