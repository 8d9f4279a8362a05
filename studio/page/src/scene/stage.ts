// The stage: floor, light, camera, dancers, and the handles of the pose being edited.
import * as THREE from 'three';
import type { Pose } from '../project/body';
import { Doll } from './doll';
import { CompanyDolls } from './company_dolls';
import { FloorLine } from './floor_line';
import { HandleDots, openHandles, placesOf } from './handle_dots';
import type { Motion } from '../project/motion';
import { floorHandle, handles, pull } from './reach';
import type { Handle } from './reach';
import { Onion } from './onion';
import { apart, OtherTakes } from './other_takes';
import { colour } from './palette';
import { floorTexture, looks, makeFloor, makeLamp, makeSky } from './scenery';
import * as studio from '../session/studio';
import { View } from './view';

const ground = new THREE.Plane(new THREE.Vector3(0, 1, 0), 0);
const farthest = 9; // metres from the camera's target within which paths may be drawn
const longest = 0.3; // seconds between camera updates; longer gaps were pauses
const alone = 1.65, reach = 0.95; // metres: visible floor around one dancer; from a hip to the fingertips, with a margin
const near = 26; // pixels within which a handle is grabbed

export class Stage {
  /// Called with the edited pose when the handle is released.
  onPosed: (pose: Pose) => void = () => {};
  /// Pictures per second while there is something to draw.
  rate = 60;

  private readonly renderer: THREE.WebGLRenderer;
  private readonly scene = new THREE.Scene();
  readonly view: View;
  private readonly camera: THREE.PerspectiveCamera;
  private readonly lamp = makeLamp();
  private readonly sky = makeSky(looks.light.sky);
  private readonly floor = makeFloor();
  private readonly others: OtherTakes;
  private readonly company: CompanyDolls;
  private readonly ghost: Doll;
  private readonly onion: Onion;
  private readonly dots = new HandleDots();
  private readonly line = new FloorLine();
  private posing: Pose | null = null;
  private grabbed: { handle: Handle; plane: THREE.Plane; from: Pose; offset: THREE.Vector3 } | null = null;
  /// The longest time, in seconds of sound, that a picture took during the last playback.
  lateness = 0;

  private readonly middle = new THREE.Vector3(); // of all dancers
  private seen: unknown[] = [];
  private drawn = 0; // time of the last picture, ms
  private looked = 0; // time of the last camera update, ms
  private isDark = false;

  constructor(private readonly canvas: HTMLCanvasElement, private readonly doll: Doll, private readonly posed: () => Pose | null, private readonly onPlaced: (marks: { x: number; y: number }[]) => void) {
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true });
    this.sharpen();
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = THREE.PCFSoftShadowMap;
    this.ghost = doll.another().fade(colour('gold'), 0.28);
    this.ghost.scene.visible = false;
    this.onion = new Onion(doll);
    this.others = new OtherTakes(doll);
    this.company = new CompanyDolls(doll);
    this.scene.add(this.sky, this.lamp, this.lamp.target, this.floor, doll.scene, this.ghost.scene, this.dots.scene, this.line.scene, this.onion.scene, this.others.scene, this.company.scene);
    this.view = new View(canvas);
    this.camera = this.view.camera;
    canvas.addEventListener('pointerdown', (event) => this.grab(event), { capture: true });
    canvas.addEventListener('pointermove', (event) => this.drag(event));
    canvas.addEventListener('pointerup', () => this.release());
    canvas.addEventListener('pointercancel', () => this.release());
    const dark = matchMedia('(prefers-color-scheme: dark)');
    dark.addEventListener('change', () => this.dress(dark.matches));
    this.dress(dark.matches);
    this.renderer.setAnimationLoop(() => this.draw());
  }

  /// A handle's position on the page; null while no pose is edited.
  whereIs(id: string) {
    if (!this.posing) return null;
    const { x, y } = this.toScreen(placesOf(this.posing).get(id)!);
    const { left, top } = this.canvas.getBoundingClientRect();
    return { x: x + left, y: y + top };
  }

  /// Moves a handle by metres, as dragging does.
  nudge(id: string, by: THREE.Vector3) {
    const handle = [...handles, floorHandle].find((some) => some.id === id);
    if (!handle || !this.posing) return;
    const to = placesOf(this.posing).get(id)!.add(by);
    this.posing = pull(studio.skeleton, this.posing, handle, to, studio.movable.value);
    studio.previewEditedPose(this.posing);
  }

  private dress(isDark: boolean) {
    this.isDark = isDark;
    const look = looks[isDark ? 'dark' : 'light'];
    this.scene.background = new THREE.Color(colour('paper'));
    this.line.dress();
    this.floor.material.map?.dispose();
    this.floor.material.map = floorTexture(look);
    this.floor.material.needsUpdate = true;
    this.sky.intensity = look.sky;
    this.lamp.intensity = look.lamp;
  }

  private toScreen(point: THREE.Vector3) {
    const { width, height } = this.canvas.getBoundingClientRect();
    const seen = point.clone().project(this.camera);
    return { x: ((seen.x + 1) / 2) * width, y: ((1 - seen.y) / 2) * height };
  }

  private ray(event: PointerEvent) {
    const { left, top, width, height } = this.canvas.getBoundingClientRect();
    const caster = new THREE.Raycaster();
    caster.setFromCamera(new THREE.Vector2((2 * (event.clientX - left)) / width - 1, 1 - (2 * (event.clientY - top)) / height), this.camera);
    return caster.ray;
  }

  /// The floor spot under the pointer; null above the horizon and too far away.
  private spot(event: PointerEvent) {
    const hit = this.ray(event).intersectPlane(ground, new THREE.Vector3());
    return hit && hit.distanceTo(this.view.target) < farthest ? { x: hit.x, z: hit.z } : null;
  }

  private grab(event: PointerEvent) {
    if (studio.drawing.value) {
      const spot = this.spot(event);
      if (!spot) return;
      event.stopImmediatePropagation();
      this.canvas.setPointerCapture(event.pointerId);
      this.view.controls.enabled = false;
      return this.line.begin(spot);
    }
    if (!this.posing) return;
    const { left, top } = this.canvas.getBoundingClientRect();
    const places = placesOf(this.posing);
    const away = (id: string) => {
      const { x, y } = this.toScreen(places.get(id)!);
      const off = Math.hypot(x - event.clientX + left, y - event.clientY + top);
      return id === floorHandle.id ? Math.min(off, Math.abs(off - 30)) : off;
    };
    const [handle] = openHandles().sort((a, b) => away(a.id) - away(b.id));
    if (!handle || away(handle.id) > near) return;
    event.stopImmediatePropagation();
    this.canvas.setPointerCapture(event.pointerId);
    const place = places.get(handle.id)!;
    const normal = handle === floorHandle ? new THREE.Vector3(0, 1, 0) : this.camera.getWorldDirection(new THREE.Vector3());
    const plane = new THREE.Plane().setFromNormalAndCoplanarPoint(normal, place);
    const hit = this.ray(event).intersectPlane(plane, new THREE.Vector3()) ?? place;
    this.grabbed = { handle, plane, from: this.posing, offset: place.clone().sub(hit) };
    this.view.controls.enabled = false;
  }

  private drag(event: PointerEvent) {
    if (this.line.isDrawn) {
      const spot = this.spot(event);
      if (spot) this.line.add(spot);
    }
    if (!this.grabbed) return;
    const hit = this.ray(event).intersectPlane(this.grabbed.plane, new THREE.Vector3());
    if (hit) this.posing = pull(studio.skeleton, this.grabbed.from, this.grabbed.handle, hit.add(this.grabbed.offset), studio.movable.value);
  }

  private release() {
    if (this.line.isDrawn) {
      this.view.controls.enabled = true;
      return studio.drawPath(this.line.end());
    }
    if (!this.grabbed) return;
    const changed = this.posing !== this.grabbed.from;
    this.grabbed = null;
    this.view.controls.enabled = true;
    if (changed && this.posing) this.onPosed(this.posing);
  }

  private draw() {
    this.resize();
    if (!this.grabbed) this.posing = this.posed();
    const time = studio.now();
    const motion = studio.motionAt(time);
    const { doll } = this;
    doll.scene.visible = (!!motion?.count && (!this.company.hasNoLead || studio.takes.value.length > 0)) || !!this.posing;
    if (this.posing) doll.take(this.posing);
    else if (motion) doll.follow(motion, time);
    const centre = doll.place().clone();
    const takes = studio.takes.value;
    const marks = this.others.show(time, centre, this.camera, this.middle).map((place) => this.toScreen(place));
    const width = this.company.show(motion, time, this.middle) || (takes.length ? takes.length * apart + 2 * reach : alone);
    this.drawGhost(time);
    this.onion.show(time, takes.length > 0);
    this.dots.show(this.posing);
    const isSet = studio.areCornersShown.value || !!studio.draftCorners.value;
    const path = this.line.show(studio.project.value?.path ?? [], studio.dancer.fps, isSet ? studio.corners.value : null, studio.heldCorner.value);
    const now = performance.now();
    this.look(this.middle, Math.min(longest, (now - this.looked) / 1000), width);
    this.looked = now;
    this.view.stepAside();
    this.camera.updateMatrixWorld();
    // Skips pictures equal to the last one.
    const seen = [time, path, motion, motion?.count, this.posing, studio.momentIndex.value, studio.takes.value, studio.cast.value, this.ghost.scene.visible, studio.onion.value, studio.movable.value,
      studio.selectedKey.value, this.camera.aspect, studio.live.value, studio.sketch.value, this.canvas.clientWidth, this.renderer.getPixelRatio(), this.isDark, this.camera.zoom,
      ...this.camera.matrixWorld.elements.map((value) => Math.round(value * 1e4))];
    if (seen.every((value, i) => value === this.seen[i])) return;
    this.seen = seen;
    this.renderer.render(this.scene, this.camera);
    this.onPlaced(marks);
    this.lateness = studio.audio.paused ? 0 : Math.max(this.lateness, studio.audio.currentTime - time);
    this.adapt();
  }

  /// Draws one picture of the dance of this size, for a film with one every `pace` seconds; the page's own drawing pauses until `leave`.
  picture(motion: Motion, time: number, pace: number, width: number, height: number): HTMLCanvasElement {
    const size = this.renderer.getSize(new THREE.Vector2());
    if (size.x !== width || size.y !== height || this.renderer.getPixelRatio() !== 1) {
      this.camera.clearViewOffset();
      this.renderer.setAnimationLoop(null);
      this.renderer.setPixelRatio(1);
      this.renderer.setSize(width, height, false);
      this.view.fit(width, height);
      for (const part of [this.ghost.scene, this.dots.scene, this.line.scene, this.onion.scene, this.others.scene]) part.visible = false;
      this.doll.scene.visible = !this.company.hasNoLead; // even for the very first picture
    }
    this.doll.follow(motion, time);
    this.middle.copy(this.doll.place());
    this.look(this.middle, pace, this.company.show(motion, time, this.middle));
    this.renderer.render(this.scene, this.camera);
    return this.canvas;
  }

  leave() {
    for (const part of [this.line.scene, this.onion.scene, this.others.scene]) part.visible = true;
    this.seen = [];
    this.sharpen();
    this.renderer.setAnimationLoop(() => this.draw());
  }

  /// Uses the screen's full resolution, even if slow.
  sharpen() {
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.rate = 60;
  }

  /// A slow machine gets fewer pixels rather than fewer pictures.
  private adapt() {
    const now = performance.now();
    const took = now - this.drawn;
    this.drawn = now;
    if (took > 400) return; // it was paused
    this.rate += (1000 / Math.max(took, 1) - this.rate) * 0.1;
    if (this.rate < 22 && this.renderer.getPixelRatio() > 0.6) {
      this.renderer.setPixelRatio(this.renderer.getPixelRatio() * 0.75);
      this.rate = 60;
    }
  }

  /// Draws the selected key at its place.
  private drawGhost(time: number) {
    const key = studio.keyOf(studio.selectedKey.value);
    const away = key ? Math.abs(key.frame / studio.dancer.fps - time) : 0;
    this.ghost.scene.visible = !!key?.hasPlace && !this.posing && away > 0.05 && studio.takes.value.length === 0;
    if (this.ghost.scene.visible) this.ghost.take(key!.pose);
  }

  /// Moves the camera, light and floor towards a dancer for this time, with these metres in view.
  private look(at: THREE.Vector3, seconds: number, width: number) {
    this.view.look(at, seconds, width, this.grabbed ? 'bends' : this.line.isDrawn ? 'draws' : 'free');
    const { target } = this.view;
    this.lamp.target.position.copy(target);
    this.lamp.position.copy(target).add(new THREE.Vector3(1.6, 4.2, 2.6));
    this.floor.position.set(target.x - (target.x % 0.5), 0, target.z - (target.z % 0.5));
  }

  private resize() {
    const { clientWidth, clientHeight } = this.canvas;
    const size = this.renderer.getSize(new THREE.Vector2());
    if (size.x === clientWidth && size.y === clientHeight) return;
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.view.fit(clientWidth, clientHeight);
  }
}
