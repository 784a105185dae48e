// What a ray through the pointer meets.

import * as THREE from "three";
import type { Avatar, Scene, Vector } from "../data/document.js";
import { pointAt, transformSize } from "../motion/chain.js";
import { rayMeets } from "./occluders.js";

export interface Hit {
  readonly link: number;
  readonly distance: number;
}

/** The nearest link that a ray of the world meets; null where it meets none. */
export function pickLink(
  avatar: Avatar,
  world: Float64Array,
  origin: Vector,
  direction: Vector,
): Hit | null {
  let best: Hit | null = null;
  const consider = (link: number, distance: number | null): void => {
    if (distance !== null && (best === null || distance < best.distance)) best = { link, distance };
  };
  for (const lss of avatar.lss) {
    const at = transformSize * lss.link;
    const distance = rayToSegment(origin, direction, pointAt(world, at, lss.a), pointAt(world, at, lss.b), lss.radius);
    consider(lss.link, distance);
  }
  for (const mesh of avatar.meshes) {
    const corner = (i: number): Vector =>
      pointAt(world, transformSize * mesh.link, [
        mesh.positions[3 * i], mesh.positions[3 * i + 1], mesh.positions[3 * i + 2],
      ]);
    for (let t = 0; t < mesh.indices.length; t += 3) {
      const [a, b, c] = [mesh.indices[t], mesh.indices[t + 1], mesh.indices[t + 2]];
      consider(mesh.link, rayToTriangle(origin, direction, corner(a), corner(b), corner(c)));
    }
  }
  return best;
}

/** Where a ray of the view first meets the scene, and the normal there, turned towards where it comes from. */
export function pickScene(scene: Scene, ray: THREE.Ray): { at: THREE.Vector3; normal: THREE.Vector3; triangle: number } | null {
  const { positions, indices } = scene, corners = new Float32Array(9);
  let nearest = Infinity, triangle = -1;
  const normal = new THREE.Vector3();
  for (let t = 0; t + 2 < indices.length; t += 3) {
    for (let i = 0; i < 9; ++i) corners[i] = positions[3 * indices[t + Math.floor(i / 3)] + (i % 3)];
    const distance = rayMeets(corners, 0, ray.origin, ray.direction);
    if (distance >= nearest) continue;
    [nearest, triangle] = [distance, t / 3];
    const [a, b, c] = [0, 3, 6].map((i) => new THREE.Vector3().fromArray(corners, i));
    normal.copy(b.sub(a).cross(c.sub(a))).normalize();
  }
  if (nearest === Infinity) return null;
  if (normal.dot(ray.direction) > 0) normal.negate();
  return { at: ray.at(nearest, new THREE.Vector3()), normal, triangle };
}

/** Along a ray of unit direction, to where it enters the points within `radius` of a segment; 0 inside. */
export function rayToSegment(origin: Vector, direction: Vector, a: Vector, b: Vector, radius: number): number | null {
  const from = new THREE.Vector3(...origin), way = new THREE.Vector3(...direction);
  const end = new THREE.Vector3(...a), axis = new THREE.Vector3(...b).sub(end), apart = from.clone().sub(end);
  const ray = new THREE.Ray(from, way);
  const square = axis.lengthSq(), along = axis.dot(way), before = axis.dot(apart);
  const share = square > 0 ? Math.min(1, Math.max(0, before / square)) : 0;
  if (from.distanceToSquared(end.clone().addScaledVector(axis, share)) <= radius * radius) return 0;
  let best = Infinity;
  // The cylinder around the axis, where that is between the ends.
  const p = square - along * along, q = square * apart.dot(way) - before * along;
  const r = square * (apart.lengthSq() - radius * radius) - before * before;
  const root = Math.sqrt(q * q - p * r), distance = (-q - root) / p, height = before + distance * along;
  if (p > 0 && distance >= 0 && height >= 0 && height <= square) best = distance;
  for (const centre of [end, end.clone().add(axis)]) {
    const onBall = ray.intersectSphere(new THREE.Sphere(centre, radius), new THREE.Vector3());
    if (onBall !== null) best = Math.min(best, onBall.distanceTo(from));
  }
  return best === Infinity ? null : best;
}

function rayToTriangle(origin: Vector, direction: Vector, a: Vector, b: Vector, c: Vector): number | null {
  const ray = new THREE.Ray(new THREE.Vector3(...origin), new THREE.Vector3(...direction));
  const hit = ray.intersectTriangle(
    new THREE.Vector3(...a), new THREE.Vector3(...b), new THREE.Vector3(...c), false, new THREE.Vector3(),
  );
  return hit === null ? null : hit.distanceTo(ray.origin);
}
