// One avatar of the view document, with what it was asked and what it met. Metres, seconds,
// quaternions w, x, y, z.

import type { ContactFields } from "./decode_contact.js";
import type { PlacedMesh, Vector } from "./geometry.js";

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
