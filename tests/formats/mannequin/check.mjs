// The mannequin dances: its limbs point where the dance's do, its hips go where the dance's go, and its mesh is the one that it had.
//   node check.mjs DANCE.glb MANNEQUIN.glb MANNEQUIN_THAT_DANCES.glb
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import * as THREE from 'three';
import { MeshoptDecoder } from 'three/examples/jsm/libs/meshopt_decoder.module.js';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';

const [danceFile, beforeFile, afterFile] = process.argv.slice(2);
const most = 10; // degrees that a limb may point elsewhere: feet stand where they belong, whatever the width of the hips
const limbs = ['left', 'right'].flatMap((side) => [['hip', 'knee'], ['knee', 'ankle'], ['shoulder', 'elbow'], ['elbow', 'wrist']]
  .map((ends) => ends.map((end) => `${side}_${end}`)));
const vrm = { hip: 'UpperLeg', knee: 'LowerLeg', ankle: 'Foot', shoulder: 'UpperArm', elbow: 'LowerArm', wrist: 'Hand', foot: 'Toes' };
const inVrm = (joint) => joint.replace(/^(left|right)_(.*)/, (_, side, part) => side + vrm[part]);

const load = async (file) => {
  const bytes = new Uint8Array(readFileSync(file));
  return new GLTFLoader().setMeshoptDecoder(MeshoptDecoder).parseAsync(bytes.buffer, '');
};
/// What a file holds after its JSON.
const binary = (file) => {
  const bytes = readFileSync(file);
  return bytes.subarray(20 + bytes.readUInt32LE(12) + 8);
};
const place = (scene, name) => scene.getObjectByName(name).getWorldPosition(new THREE.Vector3());

const [dance, after] = await Promise.all([danceFile, afterFile].map(load));
const old = binary(beforeFile);
assert.ok(binary(afterFile).subarray(0, old.length).equals(old), 'the mesh is another one');

const moved = [dance, after].map(({ scene, animations }) => {
  const mixer = new THREE.AnimationMixer(scene);
  mixer.clipAction(animations.find(({ name }) => name === 'dance') ?? animations[0]).play();
  return (time) => {
    mixer.setTime(time);
    scene.updateMatrixWorld(true);
  };
});
let worst = { limb: '', off: 0 };
const travelled = { dance: 0, after: 0 };
let last = null;
for (let frame = 0; frame < 60; frame += 3) {
  for (const move of moved) move(frame / 30);
  for (const [from, to] of limbs) {
    const way = (scene, a, b) => place(scene, b).sub(place(scene, a));
    const off = THREE.MathUtils.radToDeg(way(dance.scene, from, to).angleTo(way(after.scene, inVrm(from), inVrm(to))));
    if (off > worst.off) worst = { limb: `${from} to ${to}`, off };
  }
  const roots = { dance: place(dance.scene, 'pelvis'), after: place(after.scene, 'hips') };
  for (const who of ['dance', 'after']) travelled[who] += last ? roots[who].distanceTo(last[who]) : 0;
  last = roots;
}
console.log(`the mannequin's ${worst.limb} points ${worst.off.toFixed(1)} degrees elsewhere, the most of ${limbs.length} limbs; its hips go ${travelled.after.toFixed(2)} m where the dance's go ${travelled.dance.toFixed(2)}`);
assert.ok(worst.off < most);
assert.ok(travelled.dance > 0.05 && Math.abs(travelled.after / travelled.dance - 1) < 0.3, 'it does not go where the dance goes');

// Skin and skeleton still fit: nothing of the body is torn.
const body = [];
after.scene.traverse((part) => part.isSkinnedMesh && body.push(part));
assert.ok(body.length > 0);
const box = new THREE.Box3();
const point = new THREE.Vector3();
for (const mesh of body) {
  mesh.skeleton.update();
  for (let i = 0; i < mesh.geometry.attributes.position.count; i += 7) box.expandByPoint(mesh.getVertexPosition(i, point).applyMatrix4(mesh.matrixWorld));
}
const { y } = box.getSize(point);
console.log(`its mesh is ${y.toFixed(2)} m high at the end, and its lowest point ${(100 * box.min.y).toFixed(1)} cm above the floor`);
assert.ok(y > 0.8 && y < 2.5 && Math.abs(box.min.y) < 0.12);
