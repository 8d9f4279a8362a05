// Other takes of an interval, beside the dancer from left to right.
import * as THREE from 'three';
import type { Doll } from './doll';
import { colour, shirtOf } from './palette';
import * as studio from '../session/studio';

export const apart = 1.25; // metres between takes
const nameHeight = 2; // metres above the floor

export class OtherTakes {
  readonly scene = new THREE.Group();
  private readonly dolls: Doll[] = [];

  constructor(private readonly doll: Doll) {}

  /// Sets `middle` to the middle of all dancers; returns the places of their names, none for one take.
  show(time: number, centre: THREE.Vector3, camera: THREE.Camera, middle: THREE.Vector3) {
    const takes = studio.takes.value;
    while (this.dolls.length < takes.length) {
      this.dolls.push(this.doll.another().wear(colour(shirtOf(this.dolls.length + 1))));
      this.scene.add(this.dolls.at(-1)!.scene);
    }
    const side = new THREE.Vector3(1, 0, 0).applyQuaternion(camera.quaternion).setY(0).normalize();
    middle.copy(side).multiplyScalar((takes.length * apart) / 2).add(centre);
    const names = [centre.clone().setY(nameHeight)];
    this.dolls.forEach((doll, i) => {
      doll.scene.visible = i < takes.length;
      if (!doll.scene.visible) return;
      doll.follow(takes[i].motion, time);
      // Side by side, wherever each dances: a dancer who walks off would leave the stage or collide.
      const place = side.clone().multiplyScalar((i + 1) * apart).add(centre).setY(nameHeight);
      doll.scene.position.copy(place).sub(doll.place()).setY(0);
      names.push(place);
    });
    return takes.length ? names : [];
  }
}
