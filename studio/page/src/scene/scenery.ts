// The stage's floor, lights and shadows, in light and dark mode.
import * as THREE from 'three';

/// The floor's colours, and how bright the lights are.
export const looks = {
  light: { floor: '#ece6dc', line: '#d9d0c2', sky: 1.9, lamp: 2.0 },
  dark: { floor: '#23272e', line: '#343a44', sky: 1.3, lamp: 1.7 },
};

/// A round floor that fades into the background, with lines half a metre apart.
export function floorTexture({ floor, line }: (typeof looks)['light']) {
  const size = 1024;
  const canvas = document.createElement('canvas');
  canvas.width = canvas.height = size;
  const pen = canvas.getContext('2d')!;
  pen.fillStyle = floor;
  pen.fillRect(0, 0, size, size);
  pen.strokeStyle = line;
  pen.lineWidth = 1.6;
  for (let at = 0; at <= size; at += size / 24) {
    pen.strokeRect(at, -2, 0, size + 4);
    pen.strokeRect(-2, at, size + 4, 0);
  }
  const fade = pen.createRadialGradient(size / 2, size / 2, size * 0.16, size / 2, size / 2, size / 2);
  fade.addColorStop(0, 'rgba(0,0,0,1)');
  fade.addColorStop(1, 'rgba(0,0,0,0)');
  pen.globalCompositeOperation = 'destination-in';
  pen.fillStyle = fade;
  pen.fillRect(0, 0, size, size);
  const texture = new THREE.CanvasTexture(canvas);
  texture.colorSpace = THREE.SRGBColorSpace;
  texture.anisotropy = 8;
  return texture;
}

/// A round floor that receives shadows.
export function makeFloor() {
  const floor = new THREE.Mesh(new THREE.PlaneGeometry(12, 12), new THREE.MeshBasicMaterial({ transparent: true, depthWrite: false }));
  floor.rotation.x = -Math.PI / 2;
  // Draws shadows on top of the floor without hiding it.
  const shade = new THREE.Mesh(new THREE.PlaneGeometry(12, 12), new THREE.ShadowMaterial({ opacity: 0.22, depthWrite: false }));
  shade.receiveShadow = true;
  shade.position.z = 0.001;
  floor.renderOrder = -2;
  shade.renderOrder = -1;
  floor.add(shade);
  return floor;
}

/// A light from one side.
export const makeSun = () => new THREE.DirectionalLight('#fff6e8', 2);

/// A light from everywhere.
export const makeSky = (brightness: number) => new THREE.HemisphereLight('#ffffff', '#b8a88f', brightness);

/// A sun that throws shadows.
export function makeLamp() {
  const lamp = makeSun();
  lamp.castShadow = true;
  lamp.shadow.mapSize.set(1024, 1024);
  lamp.shadow.radius = 5;
  lamp.shadow.bias = -0.0005;
  Object.assign(lamp.shadow.camera, { left: -4, right: 4, top: 3, bottom: -3, near: 0.5, far: 12 });
  return lamp;
}
