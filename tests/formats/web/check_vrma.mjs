// What VRM's own players make of a .vrma: three-vrm-animation loads it and puts it on bodies of VRM 1.0, which face +Z at rest, and of
// VRM 0.x, which face -Z, and their joints are where we say they are.
//   node check_vrma.mjs FILE.vrma EXPECTED.json
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { VRM, VRMHumanoid } from '@pixiv/three-vrm';
import { VRMAnimationLoaderPlugin, createVRMAnimationClip } from '@pixiv/three-vrm-animation';
import validator from 'gltf-validator';
import * as THREE from 'three';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';

const [file, expectedFile] = process.argv.slice(2);
const bytes = new Uint8Array(readFileSync(file));
const expected = JSON.parse(readFileSync(expectedFile));

const { issues } = await validator.validateBytes(bytes);
// It does not know the extension.
assert.deepEqual(issues.messages.filter(({ code }) => code !== 'UNSUPPORTED_EXTENSION' && code !== 'NODE_EMPTY'), []);

const loader = new GLTFLoader();
loader.register((parser) => new VRMAnimationLoaderPlugin(parser));
const gltf = await loader.parseAsync(bytes.buffer, '');
const [animation] = gltf.userData.vrmAnimations;
assert.ok(Math.abs(animation.duration - expected.duration) < 1e-5, `lasts ${animation.duration} s`);

// A body of the same build, whose bones are turned as its kind of avatar stands.
function avatar(metaVersion) {
  const scene = new THREE.Group();
  const facing = metaVersion === '0' ? -1 : 1;
  const bones = {};
  for (const { bone, parent, offset: [x, y, z] } of expected.rest) {
    const node = new THREE.Object3D();
    node.name = `raw_${bone}`;
    node.position.set(facing * x, y, facing * z);
    (parent ? bones[parent].node : scene).add(node);
    bones[bone] = { node };
  }
  const humanoid = new VRMHumanoid(bones);
  scene.add(humanoid.normalizedHumanBonesRoot);
  return { vrm: new VRM({ scene, humanoid, meta: { metaVersion }, materials: [] }), bones, facing };
}

const point = new THREE.Vector3();
for (const metaVersion of ['1', '0']) {
  const { vrm, bones, facing } = avatar(metaVersion);
  const mixer = new THREE.AnimationMixer(vrm.scene);
  mixer.clipAction(createVRMAnimationClip(animation, vrm)).play();
  let worst = 0;
  let points = 0;
  for (const { time, joints } of expected.frames) {
    mixer.setTime(time);
    vrm.humanoid.update();
    vrm.scene.updateMatrixWorld(true);
    for (const [bone, [x, y, z]] of Object.entries(joints)) {
      bones[bone].node.getWorldPosition(point);
      worst = Math.max(worst, point.distanceTo(new THREE.Vector3(facing * x, y, facing * z)));
      ++points;
    }
  }
  assert.ok(worst < 1e-4, `VRM ${metaVersion}: a joint is ${worst} m off`);
  console.log(`VRM ${metaVersion}: ${points} joints, ${(1e6 * worst).toFixed(2)} µm off at most`);
}
