// Where a clip stands in its scene: where `--place X,Y,Z,YAW` puts its origin, and which place puts
// the body somewhere else. The body may be metres from its clip's origin.

import type { Vector } from "../data/document.js";
import { transformSize } from "./chain.js";

export interface Place {
  /** Of the clip's origin in the world, metres. */
  readonly origin: Vector;
  /** About +Y. */
  readonly yawDegrees: number;
}

export const unplaced: Place = { origin: [0, 0, 0], yawDegrees: 0 };

/** From a document's setting "placed at": "1, 0, -2 m, turned by 90 degrees". */
export function placeFrom(text: string): Place {
  const numbers = text.match(/-?\d+(?:\.\d+)?(?:e[-+]?\d+)?/gi)?.map(Number) ?? [];
  if (numbers.length < 3 || !numbers.every(Number.isFinite)) return unplaced;
  return { origin: [numbers[0], numbers[1], numbers[2]], yawDegrees: numbers[3] ?? 0 };
}

/** To the millimetre and the degree: a click is no finer. */
export function placeOption({ origin, yawDegrees }: Place): string {
  const numbers = [...origin.map((value) => Number(value.toFixed(3))), Math.round(yawDegrees)];
  return `--place ${numbers.map((value) => String(value === 0 ? 0 : value)).join(",")}`;
}

/** The place that takes the point `held` of the body as it is placed now to `target`, turned to `yawDegrees`. */
export function placeWith(now: Place, held: Vector, target: Vector, yawDegrees: number): Place {
  const inClip = turned(minus(held, now.origin), -now.yawDegrees);
  return { origin: minus(target, turned(inClip, yawDegrees)), yawDegrees };
}

/** Transforms of all links as they would be at another place. */
export function carried(world: Float64Array, now: Place, to: Place): Float64Array {
  const out = Float64Array.from(world), turn = to.yawDegrees - now.yawDegrees;
  for (let at = 0; at < world.length; at += transformSize) {
    for (let column = 0; column < 3; ++column) {
      const axis = turned([world[at + column], world[at + 3 + column], world[at + 6 + column]], turn);
      axis.forEach((value, row) => (out[at + 3 * row + column] = value));
    }
    const point = turned(minus([world[at + 9], world[at + 10], world[at + 11]], now.origin), turn);
    point.forEach((value, axis) => (out[at + 9 + axis] = value + to.origin[axis]));
  }
  return out;
}

/** Degrees about +Y that turn +z towards `direction`, over the ground. */
export function yawTowards([x, , z]: Vector): number {
  return (Math.atan2(x, z) * 180) / Math.PI;
}

/** In (-180, 180]. */
export function wrapped(degrees: number): number {
  const rest = ((degrees % 360) + 360) % 360;
  return rest > 180 ? rest - 360 : rest;
}

function minus(a: Vector, b: Vector): Vector {
  return [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
}

function turned([x, y, z]: Vector, degrees: number): Vector {
  const angle = (degrees * Math.PI) / 180, c = Math.cos(angle), s = Math.sin(angle);
  return [c * x + s * z, y, c * z - s * x];
}
