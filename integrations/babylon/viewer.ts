// What the library takes bodies for, and where they are pressed, drawn as lines.

import type { LinesMesh, Scene } from "@babylonjs/core";
import { Color3 } from "@babylonjs/core/Maths/math.color.js";
import { Vector3 } from "@babylonjs/core/Maths/math.vector.js";
import { CreateLineSystem } from "@babylonjs/core/Meshes/Builders/linesBuilder.js";
import { BodyLines, linesOfPresses } from "foretouch/host";
import type { Body } from "./touchers.js";

const pairs = (points: ArrayLike<number>): Vector3[][] => Array.from({ length: points.length / 6 }, (_, i) => [Vector3.FromArray(points, 6 * i), Vector3.FromArray(points, 6 * i + 3)]);

/** Call update() after the world's. */
export class TouchViewer {
  private capsules: { readonly lines: BodyLines; readonly mesh: LinesMesh } | null = null;
  private arrows: LinesMesh | null = null;

  constructor(
    private readonly body: Body,
    private readonly scene: Scene,
    private readonly color = new Color3(0.13, 0.4, 0.87),
    private readonly pressColor = new Color3(0.87, 0.2, 0.13),
  ) {}

  update(): void {
    const { member, mirror } = this.body;
    if (member === null) return;
    if (this.capsules === null) {
      const lines = new BodyLines(member.links, mirror), mesh = CreateLineSystem("Foretouch capsules", { lines: pairs(lines.positions), updatable: true }, this.scene);
      mesh.color = this.color;
      this.capsules = { lines, mesh };
    }
    this.capsules.mesh.updateVerticesData("position", this.capsules.lines.update(member.drawn));
    this.arrows?.dispose();
    const points = linesOfPresses(this.body.presses.map((press) => ({ ...press, point: press.point.asArray() as [number, number, number], normal: press.normal.asArray() as [number, number, number] })));
    this.arrows = points.length === 0 ? null : CreateLineSystem("Foretouch presses", { lines: pairs(points) }, this.scene);
    if (this.arrows !== null) this.arrows.color = this.pressColor;
  }

  dispose(): void {
    this.capsules?.mesh.dispose();
    this.arrows?.dispose();
  }
}
