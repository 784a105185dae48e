// Where the camera stands: so that a contact is seen from the side that its link comes from, across
// the motion, and with nothing in the way if that can be had.

import * as THREE from "three";
import type { Scene } from "../data/document.js";

const directions = 12;
/** Of the camera above the horizon, radians. */
const elevations = [0.28, 0.5, 0.8];
/** Looking further into a scene for what is in the way costs more time than it is worth. */
const maxTrianglesLookedAt = 40000;
/** Off the scene, metres. */
const lift = 0.02;
/** What hiding one point weighs against a direction that is liked (up to about 2.5). */
const hiddenCost = 0.8;

export interface Sight {
  /** In the view's coordinates, as everything here. */
  readonly target: THREE.Vector3;
  readonly position: THREE.Vector3;
}

/** What a sight is to show. */
export interface Subject {
  readonly centre: THREE.Vector3;
  readonly radius: number;
  /** The point that should be seen, and from which side; null where there is none. */
  readonly point: THREE.Vector3 | null;
  /** What else should not be hidden. */
  readonly wanted: readonly THREE.Vector3[];
  readonly normal: THREE.Vector3 | null;
  readonly motion: THREE.Vector3 | null;
}

export function sightOf(subject: Subject, camera: THREE.PerspectiveCamera, scene: Scene): Sight {
  const distance = distanceFor(subject.radius, camera);
  let best: Sight | null = null, bestScore = -Infinity;
  for (const elevation of elevations) {
    for (let i = 0; i < directions; ++i) {
      const azimuth = (2 * Math.PI * (i + 0.5)) / directions;
      const towards = new THREE.Vector3(
        Math.cos(elevation) * Math.sin(azimuth), Math.sin(elevation), Math.cos(elevation) * Math.cos(azimuth),
      );
      const position = subject.centre.clone().addScaledVector(towards, distance);
      const score = liking(subject, towards, elevation) - hiding(subject, position, scene);
      if (score > bestScore) {
        best = { target: subject.centre.clone(), position };
        bestScore = score;
      }
    }
  }
  return best ?? { target: subject.centre.clone(), position: new THREE.Vector3(distance, distance, distance) };
}

/** So that a ball of `radius` fits the narrower side of the picture. */
export function distanceFor(radius: number, camera: THREE.PerspectiveCamera): number {
  const vertical = (camera.fov * Math.PI) / 360;
  const half = camera.aspect < 1 ? Math.atan(Math.tan(vertical) * camera.aspect) : vertical;
  return radius / Math.sin(half);
}

function liking(subject: Subject, towards: THREE.Vector3, elevation: number): number {
  let score = 1 - Math.abs(elevation - 0.35);
  if (subject.normal !== null) score += 1.2 * Math.min(0.5, subject.normal.dot(towards));
  if (subject.motion !== null && subject.motion.lengthSq() > 0) {
    score += 0.9 * (1 - Math.abs(subject.motion.clone().normalize().dot(towards)));
  }
  return score;
}

/** How many of what should be seen from `position` is hidden. */
function hiding(subject: Subject, position: THREE.Vector3, scene: Scene): number {
  const { point, normal } = subject;
  // The point lies on the scene, which would hide it.
  const seen = point === null ? [] : [normal === null ? point : point.clone().addScaledVector(normal, lift)];
  return [...seen, ...subject.wanted].filter((one) => isHidden(one, position, scene)).length * hiddenCost;
}

function isHidden(point: THREE.Vector3, position: THREE.Vector3, scene: Scene): boolean {
  const direction = point.clone().sub(position);
  const distance = direction.length();
  const ray = new THREE.Ray(position, direction.divideScalar(distance));
  const a = new THREE.Vector3(), b = new THREE.Vector3(), c = new THREE.Vector3(), at = new THREE.Vector3();
  const triangles = scene.indices.length / 3;
  const stride = Math.max(1, Math.ceil(triangles / maxTrianglesLookedAt));
  for (let t = 0; t < triangles; t += stride) {
    a.fromArray(scene.positions, 3 * scene.indices[3 * t]);
    b.fromArray(scene.positions, 3 * scene.indices[3 * t + 1]);
    c.fromArray(scene.positions, 3 * scene.indices[3 * t + 2]);
    if (ray.intersectTriangle(a, b, c, false, at) !== null && at.distanceTo(position) < 0.97 * distance) return true;
  }
  return false;
}
