// Boxes and balls around what is shown, in the world. Metres.

import type { Avatar, Bounds, Vector } from "../data/document.js";
import { pointAt, transformSize } from "../motion/chain.js";

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
