// For inspection: axes, a grid of one metre, and the sizes of what was loaded, written beside it.

import * as THREE from "three";
import type { Bounds, Vector } from "../data/document.js";
import { emptyBounds, union } from "./bounds.js";
import type { Label } from "./labels.js";
import type { Palette } from "./palette.js";

const maxGridMetres = 200;
/** Metres. */
const axisLength = 1;
const axisColours = { x: "#d55e00", y: "#009e73", z: "#0072b2" };

export class Measures {
  readonly group = new THREE.Group();
  private readonly lines = new THREE.LineBasicMaterial({ transparent: true, opacity: 0.8 });
  private grid: THREE.GridHelper | null = null;
  private readonly bounds: Bounds;

  /** `origin` is the world's point that the view has at zero. */
  constructor(
    private readonly origin: Vector,
    private readonly boxes: readonly Bounds[],
  ) {
    this.bounds = boxes.reduce(union, emptyBounds);
    this.group.add(...axes(origin));
    for (const box of boxes) this.addBox(box);
  }

  /** Names of the axes, and the sides of every box. */
  labels(): Label[] {
    const names: Label[] = (["x", "y", "z"] as const).map((name, axis) => {
      const end: [number, number, number] = [0, 0, 0];
      end[axis] = 1.08 * axisLength;
      return { kind: "axis", text: name, at: this.local(end) };
    });
    return [...names, ...this.boxes.flatMap((box) => this.sides(box))];
  }

  private sides({ min, max }: Bounds): Label[] {
    const middle = (axis: number): number => (min[axis] + max[axis]) / 2;
    const places: Vector[] = [[middle(0), min[1], max[2]], [max[0], middle(1), max[2]], [max[0], min[1], middle(2)]];
    return places.map((place, axis) => {
      const text = `${(max[axis] - min[axis]).toFixed(2)} m`;
      return { kind: "dimension", text, at: this.local(place) };
    });
  }

  private local(point: Vector): THREE.Vector3 {
    return new THREE.Vector3(...point).sub(new THREE.Vector3(...this.origin));
  }

  private addBox({ min, max }: Bounds): void {
    const box = new THREE.Box3(this.local(min), this.local(max));
    const size = box.getSize(new THREE.Vector3()), edges = new THREE.BoxGeometry(size.x, size.y, size.z);
    const lines = new THREE.LineSegments(new THREE.EdgesGeometry(edges), this.lines);
    lines.position.copy(box.getCenter(new THREE.Vector3()));
    this.group.add(lines);
  }

  paint(palette: Palette): void {
    this.lines.color.set(palette.faint);
    this.grid?.removeFromParent();
    const { min, max } = this.bounds;
    const extent = Math.max(max[0] - min[0], max[2] - min[2]);
    const metres = 2 * Math.ceil(Math.min(extent, maxGridMetres) / 2 + 1);
    this.grid = new THREE.GridHelper(metres, metres, palette.grid, palette.grid);
    // On whole metres, and on the ground where the ground is anywhere near.
    const isGroundNear = min[1] <= extent && max[1] >= -extent;
    this.grid.position.set(
      Math.round((min[0] + max[0]) / 2) - this.origin[0],
      (isGroundNear ? 0 : min[1]) - this.origin[1],
      Math.round((min[2] + max[2]) / 2) - this.origin[2],
    );
    this.group.add(this.grid);
  }
}

function axes(origin: Vector): THREE.Object3D[] {
  const at = new THREE.Vector3(...origin).negate();
  const directions: [Vector, string][] = [
    [[1, 0, 0], axisColours.x], [[0, 1, 0], axisColours.y], [[0, 0, 1], axisColours.z],
  ];
  return directions.map(
    ([d, colour]) => new THREE.ArrowHelper(new THREE.Vector3(...d), at, axisLength, new THREE.Color(colour), 0.16, 0.08),
  );
}
