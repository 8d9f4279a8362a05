// What three.js shows: a floor, a light, and one character.
import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { MeshoptDecoder } from 'three/addons/libs/meshopt_decoder.module.js';
import { gltfBones } from 'choreo-client/character';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';

/** A scene on a canvas. `beforeFrame` is called before each picture. */
export function makeStage(canvas, beforeFrame) {
  const renderer = new THREE.WebGLRenderer({ canvas, antialias: true });
  renderer.shadowMap.enabled = true;
  const scene = new THREE.Scene();
  scene.background = new THREE.Color(0x23252e);
  const camera = new THREE.PerspectiveCamera(40, 1, 0.1, 100);
  camera.position.set(0.8, 1.4, 3.4);
  const controls = new OrbitControls(camera, canvas);
  controls.target.set(0, 0.95, 0);
  const sun = new THREE.DirectionalLight(0xffffff, 2.5);
  sun.position.set(2, 5, 3);
  sun.castShadow = true;
  sun.shadow.mapSize.set(2048, 2048);
  for (const side of ['left', 'bottom']) sun.shadow.camera[side] = -4;
  for (const side of ['right', 'top']) sun.shadow.camera[side] = 4;
  const floor = new THREE.Mesh(new THREE.CircleGeometry(6, 64), new THREE.MeshStandardMaterial({ color: 0x5b5f70, roughness: 0.9 }));
  floor.rotation.x = -Math.PI / 2;
  floor.receiveShadow = true;
  scene.add(new THREE.HemisphereLight(0xdde6ff, 0x55505a, 1.6), sun, floor);
  let shown;
  let pelvis; // which the camera follows
  const here = new THREE.Vector3();
  renderer.setAnimationLoop(() => {
    beforeFrame();
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    const ratio = Math.min(devicePixelRatio, 2);
    if (canvas.width !== Math.floor(width * ratio) || canvas.height !== Math.floor(height * ratio)) {
      renderer.setPixelRatio(ratio);
      renderer.setSize(width, height, false);
      camera.aspect = width / height;
      camera.updateProjectionMatrix();
    }
    pelvis?.getWorldPosition(here).sub(controls.target).setY(0).multiplyScalar(0.04);
    if (pelvis) for (const seen of [camera.position, controls.target]) seen.add(here);
    controls.update();
    renderer.render(scene, camera);
  });
  return (character, followed) => {
    if (shown) scene.remove(shown);
    scene.add((shown = character));
    pelvis = followed;
    character.traverse((object) => {
      object.castShadow = object.isMesh === true;
      object.frustumCulled = false; // the bounds of skins are those of the rest pose
    });
  };
}

const loader = new GLTFLoader().setMeshoptDecoder(MeshoptDecoder);

/** What a .glb or .vrm shows: its scene, and the bones that a VRM names itself, as bonesOf() takes them. */
export async function loadCharacter(file) {
  const bytes = await file.arrayBuffer();
  const isGltf = /^(glTF|\s*\{)/.test(new TextDecoder().decode(bytes.slice(0, 16)));
  if (!isGltf) throw new Error('this is no glTF file, .glb or .vrm');
  const { scene, parser } = await loader.parseAsync(bytes, '');
  const nodes = gltfBones(parser.json);
  const humanoid = {};
  scene.traverse((node) => {
    const name = nodes[parser.associations.get(node)?.nodes]?.humanoid;
    if (name) humanoid[name] = { node };
  });
  return { scene, humanoid };
}

/** A doll with the dance's own body: a capsule along each bone. */
export function makeDoll({ joint_names, parents, offsets, pelvis_height }) {
  const cloth = new THREE.MeshStandardMaterial({ color: 0xe0457b, roughness: 0.6 });
  const skin = new THREE.MeshStandardMaterial({ color: 0xf2c9a8, roughness: 0.7 });
  const joints = joint_names.map((name) => Object.assign(new THREE.Object3D(), { name }));
  joint_names.forEach((name, joint) => {
    const offset = new THREE.Vector3().fromArray(offsets, 3 * joint);
    const parent = joints[parents[joint]];
    joints[joint].position.copy(parent ? offset : new THREE.Vector3(0, pelvis_height, 0));
    if (!parent) return;
    parent.add(joints[joint]);
    const isTrunk = /spine|collar|hip|neck/.test(name);
    const radius = isTrunk ? 0.075 : 0.045;
    const bone = new THREE.Mesh(new THREE.CapsuleGeometry(radius, offset.length(), 8, 16), /wrist|hand|neck|head/.test(name) ? skin : cloth);
    bone.position.copy(offset).multiplyScalar(0.5);
    bone.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), offset.clone().normalize());
    parent.add(bone);
  });
  const head = new THREE.Mesh(new THREE.SphereGeometry(0.11, 32, 24), skin);
  head.position.set(0, 0.07, 0.02);
  joints[joint_names.indexOf('head')].add(head);
  return new THREE.Group().add(joints[0]);
}
