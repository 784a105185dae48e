// The view document, decoded: format "foretouch-view" version 1. Metres, seconds, right-handed
// world with +Y up, quaternions w, x, y, z. Everything here has been checked by decode.ts, so that
// nothing behind it has to: indices are in range, numbers finite, quaternions unit.

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

/** A contact as the results have it; null for fields its verdict does not have. */
export interface ContactFields {
  readonly link: number;
  readonly verdict: Verdict;
  readonly reason: string | null;
  readonly toi: number | null;
  readonly time: number | null;
  readonly freeUntil: number | null;
  readonly separation: number | null;
  readonly penetration: number | null;
  readonly point: Vector | null;
  readonly onLink: Vector | null;
  readonly normal: Vector | null;
  readonly triangle: number | null;
  readonly object: string | null;
  /** Of two bodies: the other one, an index into the document's avatars, and its link; else null. */
  readonly otherAvatar: number | null;
  readonly otherLink: number | null;
  readonly missedByPoses: boolean | null;
  /** Of a solid avatar: how hard the tracked pose presses, metres; and how fast the link slips, m/s. */
  readonly push: number | null;
  readonly slip: number | null;
}

export interface RecordedContact extends ContactFields {
  readonly step: number;
}

/** How hard two meet: metres a second along the normal, kilograms, newton seconds; null where it is not known. */
export interface Strength {
  /** Above zero while they approach; if they touch, it is proven to be between the next two. */
  readonly speed: number | null;
  readonly lower: number | null;
  readonly upper: number | null;
  /** That meets the other along the normal; null where nothing of the two has a mass. */
  readonly effectiveMass: number | null;
  /** That would take the approach away. */
  readonly impulse: number | null;
}

/** A link and an object (or another link, of the same avatar or of another one) from first contact to where it ends. */
export interface RecordedTouch {
  readonly avatar: number;
  readonly link: number;
  /** Of own links: the other one's name. */
  readonly object: string;
  /** The other link; null where it touches the scene. */
  readonly other: number | null;
  /** Whose that is: an index into the document's avatars; null where it is the avatar's own. */
  readonly otherAvatar: number | null;
  readonly begin: number;
  readonly end: number;
  /** "inside": it touched already when somebody first looked. */
  readonly begins: "contact" | "inside";
  /** "open": it still touches when nobody looks any more. */
  readonly ends: "left" | "open";
  readonly isGround: boolean;
  /** No pose that was asked for lies in it. */
  readonly isMissed: boolean;
  /** Indices into the avatar's contacts. */
  readonly rows: readonly number[];
  /** The deepest that any of its poses is in it, metres; null where none is. */
  readonly depth: number | null;
  /** Where it begins; null where nobody looked. */
  readonly strength: Strength | null;
  /** Why nothing is claimed of the two in this time, which is then no touch; null of touches. */
  readonly unresolved: string | null;
}

export interface RecordedFoot {
  /** The ankle, of the first avatar. */
  readonly link: number;
  readonly stances: readonly FootStance[];
}

/** A touch of a whole foot, or that it hovers. Metres and seconds. */
export interface FootStance {
  readonly kind: "touches" | "under" | "hovers";
  readonly begin: number;
  readonly end: number;
  /** The clip begins, or ends, in it. */
  readonly beganBefore: boolean;
  readonly goesOn: boolean;
  readonly slide: number;
  /** The part that slides most, and the deepest: "heel"; "" of what hovers. */
  readonly slides: string;
  readonly depth: number;
  readonly deepest: string;
  readonly depthAt: number;
  readonly hover: number;
  /** On the ground; empty where it does not slide. */
  readonly trace: readonly Vector[];
}

export interface RecordedPerson {
  /** The file of the bounds, and the motion between two poses that they are about. */
  readonly bounds: string;
  readonly between: string;
  /** Of the poses that were asked; null where each person has a rate of their own. */
  readonly rateHz: number | null;
  readonly touches: readonly PersonTouch[];
}

/** What the person touched, whatever they did within the bounds. Seconds. */
export interface PersonTouch {
  /** Whose; indices into the document's avatars, and into their links. */
  readonly avatar: number;
  readonly link: number;
  /** Of the scene, or of another body; the other one's name where it is an own link; "" where it is not known. */
  readonly object: string;
  readonly isOwn: boolean;
  /** Nothing is touched before, and nothing after. */
  readonly begin: number;
  readonly end: number;
  /** By when it had begun, and until when it had not ended; null of what is only possible. */
  readonly certain: { readonly from: number; readonly to: number } | null;
  /** The clip begins, or ends, in it. */
  readonly beganBefore: boolean;
  readonly goesOn: boolean;
  /** The farthest that person and model may be apart in it, metres; null where it is not known. */
  readonly growth: number | null;
}

/** Somebody is in a trigger, or nothing is known of that. */
export interface RecordedStay {
  /** Indices into the document's avatars. */
  readonly trigger: number;
  readonly avatar: number;
  /** Whose entering it begins with. */
  readonly link: number;
  readonly begin: number;
  readonly end: number;
  readonly begins: "enter" | "inside";
  readonly ends: "left" | "open";
  readonly isUnresolved: boolean;
}

/** One verdict of an inspection, and what to try where it is no good one. */
export interface Check {
  readonly name: string;
  readonly state: "good" | "doubt" | "bad";
  readonly text: string;
  /** An option to copy; "" for none. */
  readonly remedy: string;
}

/** Contains every point that the link's LSS reach during the step, at most `error` metres off. */
export interface SweptSurface extends PlacedMesh {
  readonly step: number;
  readonly link: number;
  readonly error: number;
}
