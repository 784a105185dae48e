// The view document, decoded: format "foretouch-view" version 1. Metres, seconds, right-handed
// world with +Y up, quaternions w, x, y, z. Everything here has been checked by decode.ts, so that
// nothing behind it has to: indices are in range, numbers finite, quaternions unit. What happened
// (contacts, touches, feet, persons, stays) has the types that its decoders give it.

import type { ContactFields } from "./decode_contact.js";
import type { RecordedFoot } from "./decode_feet.js";
import type { RecordedPerson } from "./decode_person.js";
import type { Check, RecordedStay, RecordedTouch } from "./decode_touch.js";

export type { ContactFields } from "./decode_contact.js";
export type { FootStance, RecordedFoot } from "./decode_feet.js";
export type { PersonTouch, RecordedPerson } from "./decode_person.js";
export type { Check, RecordedStay, RecordedTouch, Strength } from "./decode_touch.js";

export type Vector = readonly [number, number, number];
export type Kind = "replay" | "world" | "log" | "inspection" | "live";
export type Verdict = "contact" | "starts_in_contact" | "undecided";

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

export interface Avatar {
  readonly id: number;
  readonly name: string;
  readonly links: readonly Link[];
  readonly lss: readonly Lss[];
  readonly meshes: readonly LinkMesh[];
  /** Of a solid avatar: what is shown. */
  readonly track: Track | null;
  /** Of a solid avatar: where its tracker says that it is. */
  readonly tracked: Track | null;
  readonly solid: Solid | null;
  /** Of a live view: its events say what a solid avatar shows. */
  readonly isLiveSolid: boolean;
  readonly contacts: readonly RecordedContact[];
  readonly swept: readonly SweptSurface[];
  /** When others carry it: its poses are then in the frame of a link of theirs. */
  readonly carried: readonly Carried[];
  /** Of a trigger, which nobody touches: its outline, two points (x, y, z) per line; else null. */
  readonly outline: Float32Array | null;
}

export interface Carried {
  /** Seconds; `until` null: to the end. */
  readonly from: number;
  readonly until: number | null;
  /** Who carries: an index into the document's avatars, and one of its links. */
  readonly avatar: number;
  readonly link: number;
  /** How many links that one has. */
  readonly links: number;
}

/** Of a solid avatar, tick by tick. */
export interface Solid {
  /** Increasing, seconds. */
  readonly times: Float64Array;
  /** Indices into `solidStates`. */
  readonly states: Uint16Array;
  /** How far any link is from where its tracker says, at most; metres. */
  readonly deviations: Float64Array;
}

/** By their numbers. */
export const solidStates = ["placing", "equal", "following", "sliding", "held", "around", "snapped"] as const;
export type SolidState = (typeof solidStates)[number];

/** Parents come before their children; -1 is the world. */
export interface Link {
  readonly name: string;
  readonly parent: number;
}

/** A line swept sphere (a capsule) in its link's frame. */
export interface Lss {
  readonly link: number;
  readonly a: Vector;
  readonly b: Vector;
  readonly radius: number;
}

export interface LinkMesh {
  readonly link: number;
  readonly positions: Float32Array;
  readonly indices: Uint32Array;
}

/** What was asked: poses, and the steps from one to another. */
export interface Track {
  readonly poseTimes: Float64Array;
  /** Parent-relative, poses × links × 4, unit. */
  readonly rotations: Float64Array;
  /** Parent-relative offsets, links × 3; of links in `moving` not used. */
  readonly offsets: Float64Array;
  readonly moving: readonly number[];
  /** Poses × moving × 3. */
  readonly movingValues: Float64Array;
  /** Pose indices of the steps' two ends. */
  readonly from: Uint32Array;
  readonly to: Uint32Array;
  /** By step; null where nothing was measured. */
  readonly latencyUs: Float64Array | null;
  /** What a check at the poses alone sees; null where nobody looked. */
  readonly touching: TouchingAtPoses | null;
}

/** At pose i: links[first[i]] to links[first[i + 1] - 1]. */
export interface TouchingAtPoses {
  readonly first: Uint32Array;
  readonly links: Uint16Array;
}

export interface RecordedContact extends ContactFields {
  readonly step: number;
}

/** Contains every point that the link's LSS reach during the step, at most `error` metres off. */
export interface SweptSurface extends PlacedMesh {
  readonly step: number;
  readonly link: number;
  readonly error: number;
}
