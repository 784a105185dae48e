// What of a scene stands in the way: its largest triangles, which are what hides things.

import * as THREE from "three";
import type { Scene } from "../data/document.js";

/** Looking at more costs more time than a better view is worth. */
const maxTriangles = 30000;
/** What is this near to the end of a line of sight does not hide it. */
const almostThere = 0.98;

export class Occluders {
  /** Nine numbers a triangle. */
  private readonly corners: Float32Array;

  constructor(scene: Scene) {
    const { positions, indices } = scene;
    const chosen = largestTriangles(scene, maxTriangles);
    this.corners = new Float32Array(9 * chosen.length);
    chosen.forEach((triangle, i) => {
      for (let corner = 0; corner < 3; ++corner) {
        const vertex = 3 * indices[3 * triangle + corner];
        this.corners.set(positions.subarray(vertex, vertex + 3), 9 * i + 3 * corner);
      }
    });
  }

  hides(point: THREE.Vector3, from: THREE.Vector3): boolean {
    const direction = point.clone().sub(from), distance = direction.length();
    const ray = new THREE.Ray(from, direction.divideScalar(distance));
    const a = new THREE.Vector3(), b = new THREE.Vector3(), c = new THREE.Vector3(), at = new THREE.Vector3();
    for (let i = 0; i < this.corners.length; i += 9) {
      a.fromArray(this.corners, i);
      b.fromArray(this.corners, i + 3);
      c.fromArray(this.corners, i + 6);
      const isMet = ray.intersectTriangle(a, b, c, false, at) !== null;
      if (isMet && at.distanceTo(from) < almostThere * distance) return true;
    }
    return false;
  }
}

function largestTriangles({ positions, indices }: Scene, most: number): Uint32Array {
  const count = indices.length / 3;
  const areas = new Float32Array(count);
  const a = new THREE.Vector3(), b = new THREE.Vector3(), c = new THREE.Vector3();
  for (let i = 0; i < count; ++i) {
    a.fromArray(positions, 3 * indices[3 * i]);
    b.fromArray(positions, 3 * indices[3 * i + 1]).sub(a);
    c.fromArray(positions, 3 * indices[3 * i + 2]).sub(a);
    areas[i] = b.cross(c).lengthSq();
  }
  const order = Uint32Array.from({ length: count }, (_, i) => i);
  return count <= most ? order : order.sort((i, j) => areas[j] - areas[i]).subarray(0, most);
}
