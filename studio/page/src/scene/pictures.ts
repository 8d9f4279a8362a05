// Small pictures of poses, drawn once each.
import * as THREE from 'three';
import type { Pose } from '../project/body';
import { heading, turned } from '../project/body';
import type { Doll } from './doll';
import { looks, makeSky, makeSun } from './scenery';

const [width, height] = [104, 132];

export class Pictures {
  private readonly renderer = new THREE.WebGLRenderer({ antialias: true, alpha: true, preserveDrawingBuffer: true });
  private readonly scene = new THREE.Scene();
  private readonly camera = new THREE.PerspectiveCamera(30, width / height, 0.1, 20);
  private readonly known = new Map<string, string>();

  constructor(private readonly doll: Doll) {
    this.renderer.setSize(width, height);
    this.renderer.setPixelRatio(1.5);
    const lamp = makeSun();
    lamp.position.set(1, 3, 2.4);
    this.scene.add(makeSky(looks.light.sky), lamp, doll.scene);
    this.camera.position.set(1.2, 1.15, 4.1);
    this.camera.lookAt(0, 0.96, 0);
  }

  /// A pose's picture, as a URL. The body faces the viewer.
  of(pose: Pose): string {
    const name = pose.rotations.join();
    let url = this.known.get(name);
    if (!url) {
      const facing = turned(pose, -heading(pose));
      this.doll.take({ ...facing, root: [0, pose.root[1], 0] });
      this.renderer.render(this.scene, this.camera);
      url = this.renderer.domElement.toDataURL('image/webp', 0.85);
      this.known.set(name, url);
    }
    return url;
  }
}
