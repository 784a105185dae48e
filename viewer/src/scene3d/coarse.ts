// The scene in fewer triangles, over the same vertices, for pictures that move where drawing is
// slow: vertices of one cell of a grid become one. What is thinner than a cell stays as lines.

/** Of scenes and of an avatar's meshes, metres; doubled until few enough triangles are left. */
export const sceneCell = 0.03, bodyCell = 0.008;
const maxDoublings = 8;

export interface CoarseSurface {
  /** Three a triangle. */
  readonly triangles: Uint32Array;
  /** Two a line. */
  readonly lines: Uint32Array;
}

/** O(vertices + triangles) a doubling. */
export function coarsened(positions: Float32Array, indices: Uint32Array, maxTriangles: number, smallestCell = sceneCell): CoarseSurface {
  let cell = smallestCell, surface = merged(indices, representatives(positions, cell));
  for (let i = 0; i < maxDoublings && surface.triangles.length / 3 > maxTriangles; ++i) {
    cell *= 2;
    surface = merged(indices, representatives(positions, cell));
  }
  return surface;
}

/** By vertex, the first vertex of its cell. */
function representatives(positions: Float32Array, cell: number): Uint32Array {
  const first = new Map<string, number>();
  const of = new Uint32Array(positions.length / 3);
  for (let i = 0; i < of.length; ++i) {
    const at = (axis: number): number => Math.floor(positions[3 * i + axis] / cell);
    const key = `${at(0)},${at(1)},${at(2)}`;
    const known = first.get(key);
    if (known === undefined) first.set(key, i);
    of[i] = known ?? i;
  }
  return of;
}

function merged(indices: Uint32Array, representative: Uint32Array): CoarseSurface {
  const triangles: number[] = [], lines: number[] = [];
  const edges = new Set<number>();
  const count = representative.length;
  const edge = (p: number, q: number): number => Math.min(p, q) * count + Math.max(p, q);
  const slim: [number, number][] = [];
  for (let i = 0; i + 2 < indices.length; i += 3) {
    const [a, b, c] = [representative[indices[i]], representative[indices[i + 1]], representative[indices[i + 2]]];
    if (a === b && b === c) continue;
    if (a === b || b === c || c === a) {
      slim.push(a === b ? [b, c] : [a, b]);
      continue;
    }
    triangles.push(a, b, c);
    edges.add(edge(a, b)).add(edge(b, c)).add(edge(c, a));
  }
  for (const [p, q] of slim) {
    if (edges.has(edge(p, q))) continue;
    edges.add(edge(p, q));
    lines.push(p, q);
  }
  return { triangles: Uint32Array.from(triangles), lines: Uint32Array.from(lines) };
}
