// Where the camera stands: so that a contact is seen from the side that its link comes from, across
// the motion, and with nothing in the way if that can be had.

import * as THREE from "three";
import type { Occluders } from "./occluders.js";

const directions = 12;
/** Of the camera above the horizon, radians. */
const elevations = [0.28, 0.5, 0.8, 1];
/** Of a contact, and of everything: into a room one looks from above, radians. */
const likedElevation = 0.35, likedElevationOfAll = 0.8;
/** Off the scene, metres. */
const lift = 0.02;
/** What hiding one point weighs against a direction that is liked (up to about 2.5). */
const hiddenCost = 0.9;

export interface Sight {
  /** In the view's coordinates, as everything here. */
  readonly target: THREE.Vector3;
  readonly position: THREE.Vector3;
}

/** A segment with a radius, metres. */
export interface Limb {
  readonly a: THREE.Vector3;
  readonly b: THREE.Vector3;
  readonly radius: number;
}

/** What a sight is to show. */
export interface Subject {
  readonly centre: THREE.Vector3;
  readonly radius: number;
  /** The point that should be seen, and from which side; null where there is none. */
  readonly point: THREE.Vector3 | null;
  /** What else should not be hidden. */
  readonly wanted: readonly THREE.Vector3[];
  /** What of the avatar itself may be in the way of `point`. */
  readonly body: readonly Limb[];
  readonly normal: THREE.Vector3 | null;
  readonly motion: THREE.Vector3 | null;
}

export function sightOf(subject: Subject, camera: THREE.PerspectiveCamera, occluders: Occluders): Sight {
  const distance = distanceFor(subject.radius, camera);
  const candidates = elevations.flatMap((elevation) => Array.from({ length: directions }, (_, i) => {
    const azimuth = (2 * Math.PI * (i + 0.5)) / directions;
    const towards = new THREE.Vector3(
      Math.cos(elevation) * Math.sin(azimuth), Math.sin(elevation), Math.cos(elevation) * Math.cos(azimuth),
    );
    return { towards, liked: liking(subject, towards, elevation) };
  }));
  // What is hidden only takes away from what is liked: once the best one found is liked more than
  // what is left, looking on is of no use.
  candidates.sort((a, b) => b.liked - a.liked);
  let best = subject.centre.clone().addScaledVector(candidates[0].towards, distance), bestScore = -Infinity;
  for (const { towards, liked } of candidates) {
    if (liked <= bestScore) break;
    const position = subject.centre.clone().addScaledVector(towards, distance);
    const score = liked - hiding(subject, position, occluders);
    if (score > bestScore) [best, bestScore] = [position, score];
  }
  return { target: subject.centre.clone(), position: best };
}

/** So that a ball of `radius` fits the narrower side of the picture. */
export function distanceFor(radius: number, camera: THREE.PerspectiveCamera): number {
  const vertical = (camera.fov * Math.PI) / 360;
  const half = camera.aspect < 1 ? Math.atan(Math.tan(vertical) * camera.aspect) : vertical;
  return radius / Math.sin(half);
}

function liking(subject: Subject, towards: THREE.Vector3, elevation: number): number {
  let score = 1 - Math.abs(elevation - (subject.point === null ? likedElevationOfAll : likedElevation));
  if (subject.normal !== null) score += 0.7 * Math.min(0.5, Math.max(-0.4, subject.normal.dot(towards)));
  if (subject.motion !== null && subject.motion.lengthSq() > 0) {
    score += 0.9 * (1 - Math.abs(subject.motion.clone().normalize().dot(towards)));
  }
  return score;
}

/** How many of what should be seen from `position` is hidden. */
function hiding(subject: Subject, position: THREE.Vector3, occluders: Occluders): number {
  const { point, normal } = subject;
  // The point lies on the scene, which would hide it.
  const seen = point === null ? [] : [normal === null ? point : point.clone().addScaledVector(normal, lift)];
  const hidden = [...seen, ...subject.wanted].filter((one) => occluders.hides(one, position)).length;
  const behind = [...seen, ...subject.wanted].filter((one) => isBehindBody(one, position, subject.body)).length;
  return (hidden + 0.7 * behind) * hiddenCost;
}

function isBehindBody(point: THREE.Vector3, position: THREE.Vector3, body: readonly Limb[]): boolean {
  const direction = point.clone().sub(position).normalize();
  const ray = new THREE.Ray(position, direction), nearest = new THREE.Vector3();
  return body.some(({ a, b, radius }) => {
    const square = ray.distanceSqToSegment(a, b, nearest);
    return square < radius * radius && nearest.distanceTo(position) < point.distanceTo(position);
  });
}
