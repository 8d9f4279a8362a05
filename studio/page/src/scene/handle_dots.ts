// The dots at a pose's handles.
import * as THREE from 'three';
import { Figure } from '../project/body';
import type { Pose } from '../project/body';
import { colour } from './palette';
import { canPull, floorHandle, handles } from './reach';
import * as studio from '../session/studio';

const aboveFloor = 0.004; // metres

/// The world positions of a pose's handles, by name.
export function placesOf(pose: Pose) {
  const figure = new Figure(studio.skeleton, pose);
  const out = new Map<string, THREE.Vector3>();
  for (const { id, joint } of handles) out.set(id, figure.places[studio.skeleton.find(joint)].clone());
  out.set(floorHandle.id, new THREE.Vector3(pose.root[0], 0, pose.root[2]));
  return out;
}

/// The handles that can be dragged now.
export function openHandles() {
  return [...handles, floorHandle].filter((handle) => canPull(studio.skeleton, handle, studio.movable.value));
}

export class HandleDots {
  readonly scene = new THREE.Group();

  constructor() {
    const dot = (color: string, radius: number) =>
      new THREE.Mesh(new THREE.SphereGeometry(radius, 16, 12), new THREE.MeshBasicMaterial({ color, depthTest: false, transparent: true, opacity: 0.9 }));
    for (const handle of handles) {
      const side = handle.id.startsWith('left') ? 'left' : handle.id.startsWith('right') ? 'right' : 'gold';
      const rim = dot('#ffffff', 0.034);
      const core = dot(colour(side), 0.026);
      rim.renderOrder = 1;
      core.renderOrder = 2;
      const both = new THREE.Group().add(rim, core);
      both.name = handle.id;
      this.scene.add(both);
    }
    const ring = new THREE.Mesh(new THREE.RingGeometry(0.3, 0.34, 48), new THREE.MeshBasicMaterial({ color: colour('gold'), depthTest: false, transparent: true, opacity: 0.9 }));
    ring.rotation.x = -Math.PI / 2;
    ring.renderOrder = 1;
    const disc = new THREE.Group().add(ring);
    disc.name = floorHandle.id;
    this.scene.add(disc);
  }

  /// Shows the handles of the pose being edited, if any.
  show(pose: Pose | null) {
    this.scene.visible = !!pose;
    if (!pose) return;
    const open = openHandles().map(({ id }) => id);
    for (const [id, place] of placesOf(pose)) {
      const dot = this.scene.getObjectByName(id)!;
      dot.visible = open.includes(id);
      dot.position.copy(place).setY(id === floorHandle.id ? aboveFloor : place.y);
    }
  }
}
