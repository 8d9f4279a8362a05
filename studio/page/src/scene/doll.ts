// The body, as in the program's pictures: a glTF skin whose bones have the joints' names.
import { Color, Mesh, MeshBasicMaterial, MeshStandardMaterial, Object3D, Quaternion } from 'three';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';
import { clone } from 'three/examples/jsm/utils/SkeletonUtils.js';
import { toQuaternion } from '../project/body';
import type { Pose, Skeleton, Triple } from '../project/body';
import type { Motion } from '../project/motion';

const shirt = 'trunk'; // the material's name in the body's file

export class Doll {
  private readonly bones: Object3D[];
  private readonly turns: Quaternion[];
  private readonly root: Triple = [0, 0, 0];

  private constructor(readonly scene: Object3D, private readonly skeleton: Skeleton) {
    this.bones = skeleton.names.map((name) => scene.getObjectByName(name)!);
    this.turns = this.bones.map(() => new Quaternion());
    scene.traverse((part) => {
      part.frustumCulled = false;
      if (part instanceof Mesh) part.castShadow = true;
    });
  }

  static async load(bytes: Uint8Array, skeleton: Skeleton) {
    const { scene } = await new GLTFLoader().parseAsync(bytes.slice().buffer as ArrayBuffer, '');
    return new Doll(scene, skeleton);
  }

  another() {
    return new Doll(clone(this.scene), this.skeleton);
  }

  /// Makes the body a ghost: transparent, in one colour.
  fade(colour: string, opacity: number) {
    const material = new MeshStandardMaterial({ color: new Color(colour), transparent: true, opacity, roughness: 1, depthWrite: false });
    // Shows only the nearest surface, so that no limb shows through another.
    const nearest = new MeshBasicMaterial({ colorWrite: false, transparent: true });
    const parts: Mesh[] = [];
    this.scene.traverse((part) => part instanceof Mesh && parts.push(part));
    for (const part of parts) {
      part.castShadow = false;
      const mask = part.clone(false);
      [mask.material, mask.renderOrder] = [nearest, -0.5];
      part.parent!.add(mask);
      part.material = material;
    }
    return this;
  }

  /// Sets the colour of the shirt.
  wear(colour: string) {
    this.scene.traverse((part) => {
      if (!(part instanceof Mesh) || part.material.name !== shirt) return;
      part.material = part.material.clone();
      part.material.color.set(colour);
    });
    return this;
  }

  take(pose: Pose) {
    this.bones[0].position.set(...pose.root);
    this.bones.forEach((bone, joint) => toQuaternion(pose.rotations, 3 * joint, bone.quaternion));
  }

  /// Takes a motion's pose at a time, or its mirror image in the plane x = 0. Hides the body if the
  /// motion has no pose there.
  follow(motion: Motion, time: number, mirrored = false) {
    if (!motion.sample(time, this.root, this.turns)) return;
    const [x, y, z] = this.root;
    this.bones[0].position.set(mirrored ? -x : x, y, z);
    this.bones.forEach((bone, joint) => {
      if (!mirrored) return bone.quaternion.copy(this.turns[joint]);
      const turn = this.turns[this.skeleton.twins[joint]];
      bone.quaternion.set(turn.x, -turn.y, -turn.z, turn.w);
    });
  }

  place() {
    return this.bones[0].position;
  }
}
