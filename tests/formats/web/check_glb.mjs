// What a web page makes of a .glb: Khronos's validator has nothing to say, and three.js puts joints and skin where we say they are.
//   node check_glb.mjs FILE.glb EXPECTED.json
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import validator from 'gltf-validator';
import * as THREE from 'three';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';

const [glb, expectedFile] = process.argv.slice(2);
const bytes = new Uint8Array(readFileSync(glb));
const expected = JSON.parse(readFileSync(expectedFile));

const { issues } = await validator.validateBytes(bytes);
console.log(`validator: ${issues.numErrors} errors, ${issues.numWarnings} warnings, ${issues.numInfos} infos, ${issues.numHints} hints`);
assert.deepEqual(issues.messages, []);

// No page and no GPU is needed to load, animate and skin.
const gltf = await new GLTFLoader().parseAsync(bytes.buffer, '');
const [clip] = gltf.animations;
assert.ok(Math.abs(clip.duration - expected.duration) < 1e-5, `lasts ${clip.duration} s`);
const skins = {};
gltf.scene.traverse((object) => {
  if (object.isSkinnedMesh) skins[object.material.name] = object;
});
// Of a character of somebody's own only the joints are told.
if (expected.frames[0].skin) assert.deepEqual(Object.keys(skins).sort(), Object.keys(expected.frames[0].skin).sort());

const mixer = new THREE.AnimationMixer(gltf.scene);
mixer.clipAction(clip).play();
const point = new THREE.Vector3();
let points = 0;
let worst = 0;
const compare = (what, [x, y, z]) => {
  const distance = point.distanceTo(new THREE.Vector3(x, y, z));
  assert.ok(distance < 1e-4, `${what} is ${distance} m off`);
  worst = Math.max(worst, distance);
  ++points;
};
for (const { time, joints, skin } of expected.frames) {
  mixer.setTime(time);
  gltf.scene.updateMatrixWorld(true);
  for (const [name, place] of Object.entries(joints)) {
    gltf.scene.getObjectByName(THREE.PropertyBinding.sanitizeNodeName(name)).getWorldPosition(point);
    compare(`${name} at ${time} s`, place);
  }
  for (const [material, vertices] of Object.entries(skin ?? {})) {
    const mesh = skins[material];
    mesh.skeleton.update();
    for (const [index, place] of Object.entries(vertices)) {
      mesh.getVertexPosition(Number(index), point).applyMatrix4(mesh.matrixWorld);
      compare(`vertex ${index} of ${material} at ${time} s`, place);
    }
  }
}
console.log(`three.js ${THREE.REVISION}: ${points} points, ${(1e6 * worst).toFixed(2)} µm off at most`);
