// Lets the camera go along with an avatar over the ground, while time runs.

import * as THREE from "three";
import type { Stage } from "./stage.js";

/** Further in one go is a jump, with which the camera does not go: metres. */
const maxStride = 2;

export class Tracking {
  private before: THREE.Vector3 | null = null;

  constructor(private readonly stage: Stage) {}

  /** `at` in the view's coordinates; null where nothing is tracked. */
  follow(at: THREE.Vector3 | null): void {
    const by = at === null || this.before === null ? null : at.clone().sub(this.before).setY(0);
    this.before = at;
    if (by === null || by.lengthSq() === 0 || by.length() > maxStride) return;
    this.stage.camera.position.add(by);
    this.stage.controls.target.add(by);
    this.stage.controls.update();
  }
}
