// What the view document is made of: vectors, boxes, meshes in the world. Metres.

export type Vector = readonly [number, number, number];
export type Verdict = "contact" | "starts_in_contact" | "undecided";

export interface Bounds {
  readonly min: Vector;
  readonly max: Vector;
}

/** A triangle mesh whose vertices are `origin` + `positions` in the world. */
export interface PlacedMesh {
  readonly origin: Vector;
  readonly positions: Float32Array;
  readonly indices: Uint32Array;
}
