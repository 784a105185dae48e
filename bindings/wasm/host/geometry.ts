// Meshes of a host as the library's triangles.

import { ForetouchError } from "../machine.js";
import type { SceneArrays } from "../shapes.js";
import { type Frames, intoFrame, type Matrix } from "./frames.js";

export interface HostMesh<O> {
  /** What events name. */
  readonly object: O;
  readonly name: string;
  /** x, y, z per vertex, in the mesh's own space. */
  readonly positions: ArrayLike<number>;
  /** Three per triangle; null: three vertices per triangle, in order. */
  readonly indices: ArrayLike<number> | null;
  /** From there to the host's world. */
  readonly matrix: Matrix;
}

export interface Gathered<O> {
  readonly arrays: SceneArrays;
  /** By the number that contacts have as `object`. */
  readonly objects: readonly O[];
}

/** How a note reaches a person: `of` is what it is about. */
export type Note<O> = (words: string, of: O | null) => void;

function countOf<O>({ name, positions, indices }: HostMesh<O>): { vertices: number; corners: number } {
  const vertices = Math.floor(positions.length / 3), corners = indices?.length ?? vertices;
  for (let corner = 0; indices !== null && corner < corners; ++corner) {
    if (!(indices[corner] >= 0 && indices[corner] < vertices)) throw new ForetouchError(`${name}: its index names vertex ${indices[corner]}, and it has ${vertices} of them`);
  }
  return { vertices, corners: corners - (corners % 3) };
}

/** Null: there are no triangles. `frame`: in this place, not in W. */
export function gathered<O>(meshes: Iterable<HostMesh<O>>, mirror: 1 | -1, note: Note<O>, frame: Frames | null = null): Gathered<O> | null {
  const used: { readonly mesh: HostMesh<O>; readonly vertices: number; readonly corners: number }[] = [];
  let vertices = 0, corners = 0;
  for (const mesh of meshes) {
    const count = countOf(mesh);
    if (count.corners === 0) {
      note(`${mesh.name} has no ${count.vertices === 0 ? "vertices" : "triangles"}: nothing can touch it`, mesh.object);
      continue;
    }
    used.push({ mesh, ...count });
    vertices += count.vertices;
    corners += count.corners;
  }
  if (used.length === 0) return null;
  const positions = new Float64Array(3 * vertices), indices = new Uint32Array(corners), objects = new Uint32Array(corners / 3);
  let firstVertex = 0, firstCorner = 0;
  used.forEach(({ mesh, ...count }, object) => {
    placed(mesh, mirror, positions.subarray(3 * firstVertex, 3 * (firstVertex + count.vertices)));
    for (let corner = 0; corner < count.corners; ++corner) indices[firstCorner + corner] = firstVertex + (mesh.indices?.[corner] ?? corner);
    objects.fill(object, firstCorner / 3, (firstCorner + count.corners) / 3);
    firstVertex += count.vertices;
    firstCorner += count.corners;
  });
  if (frame !== null) intoFrame(frame, 0, positions);
  return { arrays: { positions, indices, objects, objectNames: used.map(({ mesh }) => mesh.name) }, objects: used.map(({ mesh }) => mesh.object) };
}

function placed<O>({ positions: p, matrix: m, name }: HostMesh<O>, mirror: 1 | -1, out: Float64Array): void {
  for (let at = 0; at < out.length; at += 3) {
    const x = p[at], y = p[at + 1], z = p[at + 2];
    out[at] = m[0] * x + m[4] * y + m[8] * z + m[12];
    out[at + 1] = m[1] * x + m[5] * y + m[9] * z + m[13];
    out[at + 2] = mirror * (m[2] * x + m[6] * y + m[10] * z + m[14]);
    if (!Number.isFinite(out[at] + out[at + 1] + out[at + 2])) throw new ForetouchError(`${name}: its vertex ${at / 3} is at no place: (${x}, ${y}, ${z}), moved by its matrix`);
  }
}
