// The view document, decoded: format "foretouch-view" version 1. Metres, seconds, right-handed
// world with +Y up, quaternions w, x, y, z. Everything here has been checked by decode.ts, so that
// nothing behind it has to: indices are in range, numbers finite, quaternions unit. What happened
// (contacts, touches, feet, persons, stays) has the types that its decoders give it.

import type { Avatar } from "./avatar.js";
import type { RecordedFoot } from "./decode_feet.js";
import type { RecordedPerson } from "./decode_person.js";
import type { Check, RecordedStay, RecordedTouch } from "./decode_touch.js";
import type { Bounds, PlacedMesh } from "./geometry.js";

export * from "./avatar.js";
export type { ContactFields } from "./decode_contact.js";
export type { FootStance, RecordedFoot } from "./decode_feet.js";
export type { PersonTouch, RecordedPerson } from "./decode_person.js";
export type { Check, RecordedStay, RecordedTouch, Strength } from "./decode_touch.js";
export type * from "./geometry.js";

export type Kind = "replay" | "world" | "log" | "inspection" | "live";

export interface ViewDocument {
  readonly kind: Kind;
  readonly title: string;
  readonly tool: string;
  readonly settings: readonly Setting[];
  readonly summary: readonly SummaryLine[];
  readonly notes: readonly string[];
  readonly scene: Scene;
  readonly avatars: readonly Avatar[];
  /** Null where the document has none: then every contact stands for itself. */
  readonly touches: readonly RecordedTouch[] | null;
  /** Who is in triggers, by begin. */
  readonly stays: readonly RecordedStay[];
  /** Seconds; null where no frames are known. */
  readonly frameTime: number | null;
  /** Of a replay: how feet rest. */
  readonly feet: readonly RecordedFoot[];
  /** Of a replay or a world with bounds: what the persons touched, not the model; null where nobody asked. */
  readonly person: RecordedPerson | null;
  /** Of inspections: what the program says about unit, axis and place. */
  readonly checks: readonly Check[];
  /** Where live events come from; null where the document is no live one. */
  readonly events: string | null;
}

export interface Setting {
  readonly name: string;
  readonly value: string;
}

export interface SummaryLine extends Setting {
  readonly note: string;
}

export interface Scene extends PlacedMesh {
  readonly name: string;
  /** By shown triangle; null where simplification made new ones. */
  readonly triangleIds: Uint32Array | null;
  readonly objects: readonly SceneObject[];
  readonly trianglesInFile: number;
  readonly reduction: "none" | "clipped" | "simplified";
  /** Of the whole file, in the world; null for an empty scene. */
  readonly bounds: Bounds | null;
}

/** Triangles `first` to `first + count - 1` of the scene. */
export interface SceneObject {
  readonly name: string;
  readonly first: number;
  readonly count: number;
}
