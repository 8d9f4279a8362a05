// Onion skin: transparent figures of earlier and later poses.
import * as THREE from 'three';
import type { Doll } from './doll';
import type { Pose } from '../project/body';
import { colour } from './palette';
import * as studio from '../session/studio';

const frames = [-15, -10, -5, 5, 10, 15];

export class Onion {
  readonly scene = new THREE.Group();
  private readonly skins = new Map<number, Doll>();

  constructor(private readonly doll: Doll) {}

  /// Shows what `studio.onion` selects, but nothing beside other takes.
  show(time: number, isHidden: boolean) {
    for (const skin of this.skins.values()) skin.scene.visible = false;
    const { value } = studio.onion;
    if (value === 'off' || isHidden || studio.live.value || !studio.project.value) return;
    const now = Math.round(time * studio.dancer.fps);
    if (value === 'keys') this.showKeys(now);
    else for (const by of frames) this.showFrame(now, by);
  }

  private showFrame(now: number, by: number) {
    const motion = studio.motionAt((now + by) / studio.dancer.fps);
    if (now + by >= 0 && motion && now + by < motion.count) this.put(by, motion.pose(now + by), 0.26 - Math.abs(by) * 0.011);
  }

  private showKeys(now: number) {
    const { keys } = studio.project.value;
    const before = keys.findLast(({ frame }) => frame < now);
    const after = keys.find(({ frame }) => frame > now);
    for (const [by, key] of [[-1, before], [1, after]] as const) {
      if (!key) continue;
      const there = studio.motionAt(key.frame / studio.dancer.fps);
      if (key.hasPlace) this.put(by, key.pose, 0.22);
      else if (there && key.frame < there.count) this.put(by, there.pose(key.frame), 0.22);
    }
  }

  private put(by: number, pose: Pose, opacity: number) {
    let skin = this.skins.get(by);
    if (!skin) {
      skin = this.doll.another().fade(colour(by < 0 ? 'right' : 'gold'), opacity);
      this.skins.set(by, skin);
      this.scene.add(skin.scene);
    }
    skin.scene.visible = true;
    skin.take(pose);
  }
}
