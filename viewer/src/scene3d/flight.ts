// Moves the camera from one sight to another, quickly and without a jump; at once where motion is
// not wanted.

import type { Sight } from "./framing.js";
import type { Stage } from "./stage.js";

const durationMs = 380;

export class Flight {
  private generation = 0;

  constructor(private readonly stage: Stage) {
    stage.controls.addEventListener("start", () => ++this.generation);
  }

  to(sight: Sight, isInstant: boolean): void {
    const generation = ++this.generation;
    if (isInstant || matchMedia("(prefers-reduced-motion: reduce)").matches) {
      this.stand(sight, sight, 1);
      return;
    }
    const from: Sight = {
      target: this.stage.controls.target.clone(),
      position: this.stage.camera.position.clone(),
    };
    const start = performance.now();
    const move = (now: number): void => {
      if (generation !== this.generation) return;
      const u = Math.min(1, Math.max(0, (now - start) / durationMs));
      this.stand(from, sight, u * u * (3 - 2 * u));
      if (u < 1) requestAnimationFrame(move);
    };
    requestAnimationFrame(move);
  }

  private stand(from: Sight, to: Sight, u: number): void {
    this.stage.controls.target.lerpVectors(from.target, to.target, u);
    this.stage.camera.position.lerpVectors(from.position, to.position, u);
    this.stage.controls.update();
    this.stage.draw();
  }
}
