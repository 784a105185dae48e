// What of a scene stands in the way: its largest triangles, which are what hides things.

import * as THREE from "three";
import type { Scene } from "../data/document.js";

/** Looking at more costs more time than a better view is worth. */
const maxTriangles = 8000;
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
    const direction = point.clone().sub(from);
    for (let i = 0; i < this.corners.length; i += 9) {
      if (rayMeets(this.corners, i, from, direction) < almostThere) return true;
    }
    return false;
  }
}

/**
 * Where `from` + s * `direction` meets the triangle of nine numbers at `at`: s > 0, or Infinity.
 * Möller and Trumbore's, without a vector made anew for each of thousands of triangles.
 */
export function rayMeets(c: ArrayLike<number>, at: number, from: THREE.Vector3, direction: THREE.Vector3): number {
  const ax = c[at], ay = c[at + 1], az = c[at + 2];
  const ux = c[at + 3] - ax, uy = c[at + 4] - ay, uz = c[at + 5] - az;
  const vx = c[at + 6] - ax, vy = c[at + 7] - ay, vz = c[at + 8] - az;
  const px = direction.y * vz - direction.z * vy, py = direction.z * vx - direction.x * vz, pz = direction.x * vy - direction.y * vx;
  const determinant = ux * px + uy * py + uz * pz;
  if (determinant === 0) return Infinity;
  const sx = from.x - ax, sy = from.y - ay, sz = from.z - az;
  const u = (sx * px + sy * py + sz * pz) / determinant;
  if (!(u >= 0 && u <= 1)) return Infinity;
  const qx = sy * uz - sz * uy, qy = sz * ux - sx * uz, qz = sx * uy - sy * ux;
  const v = (direction.x * qx + direction.y * qy + direction.z * qz) / determinant;
  if (!(v >= 0 && u + v <= 1)) return Infinity;
  const s = (vx * qx + vy * qy + vz * qz) / determinant;
  return s > 0 ? s : Infinity;
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
