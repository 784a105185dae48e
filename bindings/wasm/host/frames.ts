// Places as graphics hosts have them, matrices of 16 numbers, column after column (three's `elements`,
// Babylon's `m`), and as the library has them: rigid, right-handed, metres.

import { ForetouchError } from "../machine.js";
import type { Pose, PoseLike } from "../shapes.js";

export type Matrix = ArrayLike<number>;

/** Rotations (w, x, y, z each) and places (x, y, z each) in W. */
export interface Frames {
  readonly rotations: Float64Array;
  readonly places: Float64Array;
}

export const framesOf = (count: number): Frames => ({ rotations: new Float64Array(4 * count), places: new Float64Array(3 * count) });
export const poseRoom = (count: number): Pose => ({ rotations: new Float64Array(4 * count), translations: new Float64Array(3 * count) });

/** v at `at`, turned by the quaternion at `q`; `sign` -1: turned back. */
function turn(rotations: ArrayLike<number>, q: number, sign: 1 | -1, v: Float64Array, at: number): void {
  const w = rotations[q], x = sign * rotations[q + 1], y = sign * rotations[q + 2], z = sign * rotations[q + 3];
  const a = v[at], b = v[at + 1], c = v[at + 2];
  const tx = 2 * (y * c - z * b), ty = 2 * (z * a - x * c), tz = 2 * (x * b - y * a);
  v[at] = a + w * tx + y * tz - z * ty;
  v[at + 1] = b + w * ty + z * tx - x * tz;
  v[at + 2] = c + w * tz + x * ty - y * tx;
}

/** The quaternion at `a` (`sign` -1: its inverse) times the one at `b`, normalised. */
function multiply(one: ArrayLike<number>, a: number, sign: 1 | -1, other: ArrayLike<number>, b: number, out: Float64Array, at: number): void {
  const w = one[a], x = sign * one[a + 1], y = sign * one[a + 2], z = sign * one[a + 3];
  const p = other[b], q = other[b + 1], r = other[b + 2], s = other[b + 3];
  const ow = w * p - x * q - y * r - z * s, ox = w * q + x * p + y * s - z * r, oy = w * r - x * s + y * p + z * q, oz = w * s + x * r - y * q + z * p;
  const length = Math.sqrt(ow * ow + ox * ox + oy * oy + oz * oz);
  out[at] = ow / length;
  out[at + 1] = ox / length;
  out[at + 2] = oy / length;
  out[at + 3] = oz / length;
}

/** Frames in W as the library's pose: each in its parent's frame (-1: a root). */
export function localPose(parents: ArrayLike<number>, { rotations, places }: Frames, pose: Pose): Pose {
  for (let joint = 0; joint < parents.length; ++joint) {
    const parent = parents[joint], q = 4 * joint, p = 3 * joint;
    if (parent < 0) {
      for (let i = 0; i < 4; ++i) pose.rotations[q + i] = rotations[q + i];
      for (let i = 0; i < 3; ++i) pose.translations[p + i] = places[p + i];
      continue;
    }
    multiply(rotations, 4 * parent, -1, rotations, q, pose.rotations, q);
    for (let i = 0; i < 3; ++i) pose.translations[p + i] = places[p + i] - places[3 * parent + i];
    turn(rotations, 4 * parent, -1, pose.translations, p);
  }
  return pose;
}

/** The way back. */
export function worldFrames(parents: ArrayLike<number>, pose: PoseLike, frames: Frames): Frames {
  const { rotations, places } = frames;
  for (let joint = 0; joint < parents.length; ++joint) {
    const parent = parents[joint], q = 4 * joint, p = 3 * joint;
    for (let i = 0; i < 3; ++i) places[p + i] = pose.translations[p + i];
    if (parent < 0) {
      for (let i = 0; i < 4; ++i) rotations[q + i] = pose.rotations[q + i];
      continue;
    }
    multiply(rotations, 4 * parent, 1, pose.rotations, q, rotations, q);
    turn(rotations, 4 * parent, 1, places, p);
    for (let i = 0; i < 3; ++i) places[p + i] += places[3 * parent + i];
  }
  return frames;
}

/** Where a point of a joint's frame is in W. */
export function pointIn({ rotations, places }: Frames, joint: number, [x, y, z]: ArrayLike<number> & Iterable<number>): Float64Array {
  const point = Float64Array.of(x, y, z);
  turn(rotations, 4 * joint, 1, point, 0);
  for (let i = 0; i < 3; ++i) point[i] += places[3 * joint + i];
  return point;
}

/** Into the frame of a joint, in place. */
export function intoFrame({ rotations, places }: Frames, joint: number, points: Float64Array): void {
  for (let at = 0; at < points.length; at += 3) {
    for (let i = 0; i < 3; ++i) points[at + i] -= places[3 * joint + i];
    turn(rotations, 4 * joint, -1, points, at);
  }
}

/** Hosts that are left-handed, as Babylon.js is by default, have z the other way round. */
export const mirrored = (isLeftHanded: boolean): 1 | -1 => (isLeftHanded ? -1 : 1);

const cube = (x: number): number => x * x * x;

/**
 * A matrix that moves rigidly: what else is in it (scale, of a mirrored one the mirror) is taken as it
 * stands at first, and must stay. Rigid parts come out; the rest, `stretch`, is for the shape.
 */
export class RigidPart {
  /** 3 x 3, column after column. */
  readonly stretch = new Float64Array(9);
  /** Where it is the same along every axis, be it mirrored; else null. */
  readonly scale: number | null;
  private readonly back = new Float64Array(9);
  private readonly rotation = new Float64Array(9);

  /** `name`: as the host calls it, for messages. */
  constructor(
    readonly name: string,
    matrix: Matrix,
    private readonly mirror: 1 | -1,
  ) {
    const l = this.linear(matrix, new Float64Array(9)), r = this.rotation;
    const volume = l[0] * (l[4] * l[8] - l[5] * l[7]) - l[3] * (l[1] * l[8] - l[2] * l[7]) + l[6] * (l[1] * l[5] - l[2] * l[4]);
    const size = Math.hypot(...l);
    if (!(Math.abs(volume) > 1e-9 * cube(size))) throw new ForetouchError(`${name}: expected a scale other than 0 along every axis, and a matrix of numbers`);
    // Gram and Schmidt, column by column.
    for (let column = 0; column < 3; ++column) {
      for (let i = 0; i < 3; ++i) r[3 * column + i] = l[3 * column + i];
      for (let before = 0; before < column; ++before) {
        const dot = r[3 * before] * l[3 * column] + r[3 * before + 1] * l[3 * column + 1] + r[3 * before + 2] * l[3 * column + 2];
        for (let i = 0; i < 3; ++i) r[3 * column + i] -= dot * r[3 * before + i];
      }
      const length = Math.hypot(r[3 * column], r[3 * column + 1], r[3 * column + 2]) * (column === 2 && volume < 0 ? -1 : 1);
      for (let i = 0; i < 3; ++i) r[3 * column + i] /= length;
    }
    for (let column = 0; column < 3; ++column) for (let row = 0; row < 3; ++row) {
      this.stretch[3 * column + row] = r[3 * row] * l[3 * column] + r[3 * row + 1] * l[3 * column + 1] + r[3 * row + 2] * l[3 * column + 2];
    }
    invert(this.stretch, this.back);
    const s = Math.abs(this.stretch[0]), isEven = this.stretch.every((value, i) => Math.abs(i % 4 === 0 ? Math.abs(value) - s : value) < 1e-4 * s);
    this.scale = isEven ? s : null;
  }

  /** Into frame number `at`; false where the rest is no longer as it was. */
  read(matrix: Matrix, { rotations, places }: Frames, at: number): boolean {
    const l = this.linear(matrix, this.rotation), b = this.back;
    const l0 = l[0], l1 = l[1], l2 = l[2], l3 = l[3], l4 = l[4], l5 = l[5], l6 = l[6], l7 = l[7], l8 = l[8];
    const xx = l0 * b[0] + l3 * b[1] + l6 * b[2], xy = l1 * b[0] + l4 * b[1] + l7 * b[2], xz = l2 * b[0] + l5 * b[1] + l8 * b[2];
    const yx = l0 * b[3] + l3 * b[4] + l6 * b[5], yy = l1 * b[3] + l4 * b[4] + l7 * b[5], yz = l2 * b[3] + l5 * b[4] + l8 * b[5];
    const zx = l0 * b[6] + l3 * b[7] + l6 * b[8], zy = l1 * b[6] + l4 * b[7] + l7 * b[8], zz = l2 * b[6] + l5 * b[7] + l8 * b[8];
    places[3 * at] = matrix[12];
    places[3 * at + 1] = matrix[13];
    places[3 * at + 2] = this.mirror * matrix[14];
    l[0] = xx; l[1] = xy; l[2] = xz; l[3] = yx; l[4] = yy; l[5] = yz; l[6] = zx; l[7] = zy; l[8] = zz;
    quaternionOf(l, rotations, 4 * at);
    const off = Math.max(
      Math.abs(xx * xx + xy * xy + xz * xz - 1), Math.abs(yx * yx + yy * yy + yz * yz - 1), Math.abs(zx * zx + zy * zy + zz * zz - 1),
      Math.abs(xx * yx + xy * yy + xz * yz), Math.abs(xx * zx + xy * zy + xz * zz), Math.abs(yx * zx + yy * zy + yz * zz),
    );
    return off < 2e-3;
  }

  /** A frame as the host's matrix, with what else was in it. */
  write({ rotations, places }: Frames, at: number, matrix: Float64Array | number[]): void {
    const q = 4 * at, m = this.mirror;
    const w = rotations[q], x = rotations[q + 1], y = rotations[q + 2], z = rotations[q + 3], s = this.stretch;
    const r = [1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y), 2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x), 2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)];
    for (let column = 0; column < 3; ++column) for (let row = 0; row < 3; ++row) {
      const value = r[row] * s[3 * column] + r[3 + row] * s[3 * column + 1] + r[6 + row] * s[3 * column + 2];
      matrix[4 * column + row] = (row === 2) !== (column === 2) ? m * value : value;
    }
    matrix[3] = matrix[7] = matrix[11] = 0;
    matrix[12] = places[3 * at];
    matrix[13] = places[3 * at + 1];
    matrix[14] = m * places[3 * at + 2];
    matrix[15] = 1;
  }

  private linear(matrix: Matrix, out: Float64Array): Float64Array {
    const m = this.mirror;
    out[0] = matrix[0]; out[1] = matrix[1]; out[2] = m * matrix[2];
    out[3] = matrix[4]; out[4] = matrix[5]; out[5] = m * matrix[6];
    out[6] = m * matrix[8]; out[7] = m * matrix[9]; out[8] = matrix[10];
    return out;
  }
}

function invert(a: Float64Array, out: Float64Array): void {
  const c0 = a[4] * a[8] - a[5] * a[7], c1 = a[2] * a[7] - a[1] * a[8], c2 = a[1] * a[5] - a[2] * a[4];
  const volume = a[0] * c0 + a[3] * c1 + a[6] * c2;
  out.set([c0, c1, c2, a[5] * a[6] - a[3] * a[8], a[0] * a[8] - a[2] * a[6], a[2] * a[3] - a[0] * a[5], a[3] * a[7] - a[4] * a[6], a[1] * a[6] - a[0] * a[7], a[0] * a[4] - a[1] * a[3]].map((value) => value / volume));
}

/** A rotation's quaternion, column after column. Numbers handed on singly would be garbage. */
function quaternionOf(r: Float64Array, out: Float64Array, at: number): void {
  const xx = r[0], yy = r[4], zz = r[8], dx = r[5] - r[7], dy = r[6] - r[2], dz = r[1] - r[3], sx = r[7] + r[5], sy = r[6] + r[2], sz = r[3] + r[1];
  let w = 1 + xx + yy + zz, x = dx, y = dy, z = dz;
  if (w < 1) {
    if (xx >= yy && xx >= zz) [w, x, y, z] = [dx, 1 + xx - yy - zz, sz, sy];
    else if (yy >= zz) [w, x, y, z] = [dy, sz, 1 + yy - xx - zz, sx];
    else [w, x, y, z] = [dz, sy, sx, 1 + zz - xx - yy];
  }
  const length = Math.sqrt(w * w + x * x + y * y + z * z);
  out[at] = w / length;
  out[at + 1] = x / length;
  out[at + 2] = y / length;
  out[at + 3] = z / length;
}
