// Boxes and balls around what is shown, in the world. Metres.

import type { Avatar, Bounds, Vector } from "../data/document.js";
import { pointAt, transformSize } from "../motion/chain.js";
import { limbsOf } from "../motion/limbs.js";

/** A box is asked for every frame: some vertices of a mesh have to do. */
const maxVerticesOfBox = 500;
const smallestRadius = 0.05;

export const emptyBounds: Bounds = {
  min: [Infinity, Infinity, Infinity],
  max: [-Infinity, -Infinity, -Infinity],
};

export function union(a: Bounds, b: Bounds): Bounds {
  const pick = (choose: (x: number, y: number) => number, p: Vector, q: Vector): Vector => [
    choose(p[0], q[0]), choose(p[1], q[1]), choose(p[2], q[2]),
  ];
  return { min: pick(Math.min, a.min, b.min), max: pick(Math.max, a.max, b.max) };
}

/** The ball around a box; one of a metre about the origin where the box is empty. */
export function ball({ min, max }: Bounds): { centre: Vector; radius: number } {
  if (!(min[0] <= max[0])) return { centre: [0, 0, 0], radius: 1 };
  return {
    centre: [(min[0] + max[0]) / 2, (min[1] + max[1]) / 2, (min[2] + max[2]) / 2],
    radius: Math.max(smallestRadius, Math.hypot(max[0] - min[0], max[1] - min[1], max[2] - min[2]) / 2),
  };
}

/** Of an avatar whose links have these world transforms. */
export function boundsOfPosture(avatar: Avatar, world: Float64Array): Bounds {
  let bounds = emptyBounds;
  const include = ([x, y, z]: Vector, radius: number): void => {
    bounds = union(bounds, { min: [x - radius, y - radius, z - radius], max: [x + radius, y + radius, z + radius] });
  };
  for (const lss of avatar.lss) {
    include(pointAt(world, transformSize * lss.link, lss.a), lss.radius);
    include(pointAt(world, transformSize * lss.link, lss.b), lss.radius);
  }
  for (const { link, positions } of avatar.lss.length > 0 ? [] : avatar.meshes) {
    const stride = 3 * Math.max(1, Math.ceil(positions.length / 3 / maxVerticesOfBox));
    for (let i = 0; i + 2 < positions.length; i += stride) {
      include(pointAt(world, transformSize * link, [positions[i], positions[i + 1], positions[i + 2]]), 0);
    }
  }
  if (bounds === emptyBounds) {
    avatar.links.forEach((_, link) => include(pointAt(world, transformSize * link, [0, 0, 0]), 0));
  }
  return bounds;
}

/** Parts of a body this near to its lowest point stand on what it stands on: of its height. */
const soleShare = 0.08;

/** The middle of what a body stands on, at its lowest height. */
export function footOf(avatar: Avatar, world: Float64Array): Vector {
  const balls = avatar.lss.flatMap(({ link, a, b, radius }) =>
    [a, b].map((end) => ({ at: pointAt(world, transformSize * link, end), radius })));
  const points = balls.length > 0 ? balls : avatar.links.map((_, link) => ({ at: pointAt(world, transformSize * link, [0, 0, 0]), radius: 0 }));
  const lows = points.map(({ at, radius }) => at[1] - radius), low = Math.min(...lows);
  const reach = soleShare * (Math.max(...lows) - low) + 1e-3;
  const soles = points.filter((_, i) => lows[i] <= low + reach);
  const mean = (axis: 0 | 2): number => soles.reduce((sum, { at }) => sum + at[axis], 0) / soles.length;
  return [mean(0), low, mean(2)];
}

/** Where a body looks, over the ground: across the line from its right side to its left. */
export function facingOf(avatar: Avatar, world: Float64Array): Vector {
  const limbs = limbsOf(avatar.links), sum = { left: [0, 0, 0], right: [0, 0, 0] }, count = { left: 0, right: 0 };
  limbs.forEach((limb, link) => {
    const side = limb.startsWith("left") ? "left" : limb.startsWith("right") ? "right" : null;
    if (side === null) return;
    ++count[side];
    pointAt(world, transformSize * link, [0, 0, 0]).forEach((value, axis) => (sum[side][axis] += value));
  });
  if (count.left === 0 || count.right === 0) return [0, 0, 1];
  const [x, , z] = sum.left.map((value, axis) => value / count.left - sum.right[axis] / count.right);
  return [-z, 0, x];
}
