// World transforms of an articulated body: composition of its joints down the chain. A transform
// is twelve numbers: the rotation matrix row by row, then the origin.

import { slerp } from "./quaternion.js";

/** Numbers of one transform. */
export const transformSize = 12;

/** One pose: parent-relative rotations (links × 4, unit) and translations (links × 3). */
export interface LocalPose {
  readonly rotations: Float64Array;
  readonly translations: Float64Array;
}

export function emptyPose(links: number): LocalPose {
  return { rotations: new Float64Array(4 * links), translations: new Float64Array(3 * links) };
}

/** out = the in-between motion from `from` to `to` at `u` in [0,1]: slerp and linear. */
export function interpolate(from: LocalPose, to: LocalPose, u: number, out: LocalPose): void {
  for (let i = 0; i < out.translations.length; ++i) {
    out.translations[i] = from.translations[i] + u * (to.translations[i] - from.translations[i]);
  }
  for (let q = 0; q < out.rotations.length; q += 4) {
    slerp(from.rotations, q, to.rotations, q, u, out.rotations, q);
  }
}

/** world = transforms of all links, transformSize numbers each. */
export function compose(parents: Int32Array, pose: LocalPose, world: Float64Array): void {
  for (let link = 0; link < parents.length; ++link) {
    const at = transformSize * link;
    writeRotation(pose.rotations, 4 * link, world, at);
    for (let i = 0; i < 3; ++i) world[at + 9 + i] = pose.translations[3 * link + i];
    if (parents[link] >= 0) carry(world, transformSize * parents[link], at);
  }
}

/** Rotation matrix of the unit quaternion at `q`. */
function writeRotation(rotations: Float64Array, q: number, out: Float64Array, at: number): void {
  const w = rotations[q], x = rotations[q + 1], y = rotations[q + 2], z = rotations[q + 3];
  out[at] = 1 - 2 * (y * y + z * z);
  out[at + 1] = 2 * (x * y - w * z);
  out[at + 2] = 2 * (x * z + w * y);
  out[at + 3] = 2 * (x * y + w * z);
  out[at + 4] = 1 - 2 * (x * x + z * z);
  out[at + 5] = 2 * (y * z - w * x);
  out[at + 6] = 2 * (x * z - w * y);
  out[at + 7] = 2 * (y * z + w * x);
  out[at + 8] = 1 - 2 * (x * x + y * y);
}

/** Transform at `child`, given in the frame of the one at `parent`, becomes a world transform. */
function carry(world: Float64Array, parent: number, child: number): void {
  // Columns of the child's rotation, then its origin: each is turned by the parent's rotation.
  for (let column = 0; column < 3; ++column) {
    turn(world, parent, child + column, 3);
  }
  turn(world, parent, child + 9, 1);
  for (let i = 0; i < 3; ++i) world[child + 9 + i] += world[parent + 9 + i];
}

function turn(world: Float64Array, rotation: number, at: number, stride: number): void {
  const x = world[at], y = world[at + stride], z = world[at + 2 * stride];
  for (let row = 0; row < 3; ++row) {
    const r = rotation + 3 * row;
    world[at + row * stride] = world[r] * x + world[r + 1] * y + world[r + 2] * z;
  }
}

/** The point p of the frame at `at`, in the world. */
export function pointAt(
  world: ArrayLike<number>,
  at: number,
  p: readonly [number, number, number],
): [number, number, number] {
  const row = (r: number): number =>
    world[at + 3 * r] * p[0] + world[at + 3 * r + 1] * p[1] + world[at + 3 * r + 2] * p[2] +
    world[at + 9 + r];
  return [row(0), row(1), row(2)];
}
