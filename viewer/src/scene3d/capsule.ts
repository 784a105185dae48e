// Surfaces of LSS: two half spheres and what lies between them.

import type { Lss, Vector } from "../data/document.js";

/** How many corners a surface has: around, and from the rim of a cap to its pole. */
interface Roundness {
  readonly around: number;
  readonly rings: number;
}
export const round: Roundness = { around: 20, rings: 6 };
/** For pictures that move where drawing is slow. */
export const roundEnough: Roundness = { around: 8, rings: 2 };

/** Vertices with normals, and the link that each belongs to. */
export interface Surface {
  readonly positions: number[];
  readonly normals: number[];
  readonly links: number[];
  readonly indices: number[];
}

export function emptySurface(): Surface {
  return { positions: [], normals: [], links: [], indices: [] };
}

/** Appends the surface of one LSS, in its link's frame. */
export function appendCapsule(surface: Surface, lss: Lss, { around: segments, rings: ringsPerCap }: Roundness): void {
  const { axis, side, other } = frameAlong(lss);
  const first = surface.links.length;
  const rings = 2 * (ringsPerCap + 1);
  for (let ring = 0; ring < rings; ++ring) {
    const isFirstCap = ring <= ringsPerCap;
    const centre = isFirstCap ? lss.a : lss.b;
    const step = isFirstCap ? ring - ringsPerCap : ring - ringsPerCap - 1;
    const latitude = (step / ringsPerCap) * (Math.PI / 2);
    for (let segment = 0; segment <= segments; ++segment) {
      const around = (segment / segments) * 2 * Math.PI;
      const c = Math.cos(latitude) * Math.cos(around), s = Math.cos(latitude) * Math.sin(around);
      for (let i = 0; i < 3; ++i) {
        const normal = axis[i] * Math.sin(latitude) + side[i] * c + other[i] * s;
        surface.normals.push(normal);
        surface.positions.push(centre[i] + lss.radius * normal);
      }
      surface.links.push(lss.link);
    }
  }
  appendQuads(surface.indices, first, rings, segments);
}

function appendQuads(indices: number[], first: number, rings: number, segments: number): void {
  const row = segments + 1;
  for (let ring = 0; ring + 1 < rings; ++ring) {
    for (let segment = 0; segment < segments; ++segment) {
      const a = first + ring * row + segment, b = a + 1, c = a + row, d = c + 1;
      indices.push(a, b, c, b, d, c);
    }
  }
}

function frameAlong(lss: Lss): { axis: Vector; side: Vector; other: Vector } {
  const along: Vector = [lss.b[0] - lss.a[0], lss.b[1] - lss.a[1], lss.b[2] - lss.a[2]];
  const length = Math.hypot(...along);
  const axis: Vector = length > 0 ? [along[0] / length, along[1] / length, along[2] / length] : [0, 1, 0];
  const helper: Vector = Math.abs(axis[1]) < 0.9 ? [0, 1, 0] : [1, 0, 0];
  const side = normalised(cross(axis, helper));
  return { axis, side, other: cross(axis, side) };
}

function cross(a: Vector, b: Vector): Vector {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

function normalised(v: Vector): Vector {
  const length = Math.hypot(...v);
  return [v[0] / length, v[1] / length, v[2] / length];
}
