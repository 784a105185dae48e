// Bodies and contacts as lines, for a host's debug drawing.

import type { Lss, Link } from "../shapes.js";
import { type Frames, pointIn } from "./frames.js";
import type { Press } from "./touches.js";

const sides = 12;

/** Pairs of points on a capsule, in its link's frame: rings at both ends, arcs over them, and lines between. */
function outlineOf({ a, b, radius }: Lss, out: number[]): void {
  const axis = [0, 1, 2].map((i) => b[i] - a[i]), length = Math.hypot(...axis);
  const along = length > 0 ? axis.map((value) => value / length) : [0, 0, 1];
  const least = along.reduce((at, value, i) => (Math.abs(value) < Math.abs(along[at]) ? i : at), 0);
  const seed = [0, 1, 2].map((i) => (i === least ? 1 : 0) - along[least] * along[i]), size = Math.hypot(...seed);
  const u = seed.map((value) => value / size), v = [0, 1, 2].map((i) => along[(i + 1) % 3] * u[(i + 2) % 3] - along[(i + 2) % 3] * u[(i + 1) % 3]);
  const at = (center: ArrayLike<number>, p: number[], cos: number, q: number[], sin: number): void => void out.push(...[0, 1, 2].map((i) => center[i] + radius * (cos * p[i] + sin * q[i])));
  for (let side = 0; side < sides; ++side) {
    const [from, to] = [side, side + 1].map((i) => (2 * Math.PI * i) / sides);
    for (const end of [a, b]) for (const angle of [from, to]) at(end, u, Math.cos(angle), v, Math.sin(angle));
    for (const across of [u, v]) {
      const end = side < sides / 2 ? b : a;
      for (const angle of [from, to]) at(end, across, Math.cos(angle), along, Math.sin(angle));
    }
  }
  for (const across of [u, v]) for (const sign of [1, -1]) for (const end of [a, b]) at(end, across, sign, across, 0);
}

/** All capsules of a body: pairs of points in the host's world, at update(). */
export class BodyLines {
  readonly positions: Float32Array;
  private readonly local: { readonly link: number; readonly points: number[] }[];

  constructor(
    links: readonly Link[],
    private readonly mirror: 1 | -1,
  ) {
    this.local = links.map(({ lss }, link) => {
      const points: number[] = [];
      lss?.forEach((one) => outlineOf(one, points));
      return { link, points };
    });
    this.positions = new Float32Array(this.local.reduce((count, { points }) => count + points.length, 0));
  }

  update(frames: Frames): Float32Array {
    let at = 0;
    for (const { link, points } of this.local) {
      for (let i = 0; i < points.length; i += 3) {
        const [x, y, z] = pointIn(frames, link, [points[i], points[i + 1], points[i + 2]]);
        this.positions[at++] = x;
        this.positions[at++] = y;
        this.positions[at++] = this.mirror * z;
      }
    }
    return this.positions;
  }
}

/** An arrow shaft per press, along its normal and as long as it is hard, 3 cm at least. */
export function linesOfPresses<O>(presses: readonly Press<O>[]): Float32Array {
  return Float32Array.from(presses.flatMap(({ point, normal, push }) => [...point, ...point.map((value, i) => value + normal[i] * Math.max(0.03, push))]));
}
