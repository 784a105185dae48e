// Lets the camera go along with an avatar over the ground, while time runs, and brings it back into
// the picture where it has left it.

import * as THREE from "three";
import type { Stage } from "./stage.js";

/** Further in one go is a jump, after which the camera looks at the avatar anew: metres. */
const maxStride = 2;
/** Of half the picture: beyond it the avatar is brought back, by this share a frame. */
const calm = 0.45, gain = 0.2;

export class Tracking {
  private before: THREE.Vector3 | null = null;

  constructor(private readonly stage: Stage) {}

  /** `at` in the view's coordinates; null where nothing is tracked. */
  follow(at: THREE.Vector3 | null): void {
    const { before } = this;
    this.before = at === null ? null : at.clone();
    if (at === null) return;
    const by = before === null ? new THREE.Vector3() : at.clone().sub(before).setY(0);
    if (by.length() > maxStride) by.set(0, 0, 0);
    this.move(by);
    const back = this.wayBack(at);
    if (back !== null) this.move(back);
  }

  private move(by: THREE.Vector3): void {
    if (by.lengthSq() === 0) return;
    this.stage.camera.position.add(by);
    this.stage.controls.target.add(by);
    this.stage.controls.update();
  }

  private wayBack(at: THREE.Vector3): THREE.Vector3 | null {
    const { camera, controls } = this.stage;
    camera.updateMatrixWorld();
    const seen = at.clone().project(camera);
    if (Math.abs(seen.x) < calm && Math.abs(seen.y) < calm && seen.z < 1) return null;
    const way = at.clone().sub(controls.target);
    return way.length() > maxStride ? way : way.multiplyScalar(gain);
  }
}
