import type { Bounds, PlacedMesh, Scene, SceneObject } from "./document.js";
import type { Reader } from "./reader.js";

export const emptyScene: Scene = {
  name: "",
  origin: [0, 0, 0],
  positions: new Float32Array(),
  indices: new Uint32Array(),
  triangleIds: null,
  objects: [],
  trianglesInFile: 0,
  reduction: "none",
  bounds: null,
};

export function decodeScene(scene: Reader): Scene {
  const mesh = decodePlacedMesh(scene);
  const triangles = mesh.indices.length / 3;
  return {
    ...mesh,
    name: scene.field("name").text(),
    triangleIds: scene.optional("triangle_ids")?.typed("u32", triangles) ?? null,
    objects: (scene.optional("objects")?.items() ?? []).map((item) => decodeObject(item, triangles)),
    trianglesInFile: scene.optional("triangles_in_file")?.count() ?? triangles,
    reduction: scene.optional("reduction")?.oneOf(["none", "clipped", "simplified"] as const) ?? "none",
    bounds: decodeBounds(scene.optional("bounds")),
  };
}

/** Vertices and triangles of `reader`, and its origin where it has one. */
export function decodePlacedMesh(reader: Reader): PlacedMesh {
  const place = reader.field("positions");
  const positions = place.typed("f32");
  if (positions.length % 3 !== 0) place.fail("ends within a vertex");
  const corners = reader.field("indices");
  const indices = corners.typedIndices("u32", positions.length / 3);
  if (indices.length % 3 !== 0) corners.fail("ends within a triangle");
  return { origin: reader.optional("origin")?.vector() ?? [0, 0, 0], positions, indices };
}

function decodeObject(item: Reader, triangles: number): SceneObject {
  const first = item.field("first").index(triangles + 1);
  const count = item.field("count").count();
  if (first + count > triangles) item.fail(`ends at ${first + count} of ${triangles} triangles`);
  return { name: item.field("name").text(), first, count };
}

function decodeBounds(reader: Reader | null): Bounds | null {
  if (reader === null || reader.value === null) return null;
  const min = reader.field("min").vector();
  const max = reader.field("max").vector();
  if (min.some((low, axis) => low > max[axis])) reader.fail("ends before it begins");
  return { min, max };
}
