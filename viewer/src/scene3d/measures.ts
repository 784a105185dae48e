// For inspection: axes, a grid of one metre, and the sizes of what was loaded, written beside it.

import * as THREE from "three";
import type { Bounds, Vector } from "../data/document.js";
import type { Palette } from "./palette.js";

const maxGridMetres = 200;
/** Metres. */
const axisLength = 1;
const axisColours = { x: "#d55e00", y: "#009e73", z: "#0072b2" };

export class Measures {
  readonly group = new THREE.Group();
  private readonly boxes: THREE.LineBasicMaterial = new THREE.LineBasicMaterial({ transparent: true, opacity: 0.8 });
  private grid: THREE.GridHelper | null = null;
  private readonly origin: Vector;

  constructor(
    origin: Vector,
    private readonly bounds: Bounds,
  ) {
    this.origin = origin;
    this.group.add(...axes(origin));
    this.addBox(bounds);
  }

  addBox(bounds: Bounds): void {
    const box = new THREE.Box3(
      new THREE.Vector3(...bounds.min).sub(new THREE.Vector3(...this.origin)),
      new THREE.Vector3(...bounds.max).sub(new THREE.Vector3(...this.origin)),
    );
    const size = box.getSize(new THREE.Vector3()), edges = new THREE.BoxGeometry(size.x, size.y, size.z);
    const lines = new THREE.LineSegments(new THREE.EdgesGeometry(edges), this.boxes);
    lines.position.copy(box.getCenter(new THREE.Vector3()));
    this.group.add(lines);
  }

  paint(palette: Palette): void {
    this.boxes.color.set(palette.faint);
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
