// The other dancers on the stage, beside the one whose dance is worked on.
import * as THREE from 'three';
import type { Doll } from './doll';
import type { Motion } from './motion';
import { colour, shirtOf } from './palette';
import * as studio from './studio';

const room = 1; // metres around a dancer that are in the picture, too

export class CompanyDolls {
  readonly scene = new THREE.Group();
  private readonly dolls: Doll[] = [];
  private readonly place = new THREE.Vector3();

  constructor(private readonly doll: Doll) {}

  /// Whether the dance that is worked on is nobody's: all are mirrored, or come later, or dance otherwise.
  get hasNoLead() {
    return studio.cast.value.length > 0 && !studio.cast.value.some(({ isLead }) => isLead);
  }

  /// Where nothing else is compared. `middle` becomes that of all dancers; returns how many metres the picture has to have, 0 for one dancer.
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
