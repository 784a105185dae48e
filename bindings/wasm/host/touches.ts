// What touches what, in the host's things.

import type { Point } from "../machine.js";
import type { EventKind, LeaveCause, Reason } from "../world.js";

/** `gap`: the page was away, or the world begins anew; nothing is known of the time between. */
export type TouchCause = LeaveCause | "gap";

/** A touch as it is reported to one body. Metres and seconds, in the host's world. */
export interface Touch<O> {
  /** "enter", "leave"; "starts_inside": it touches where it is known first; "unresolved_from", "unresolved_to": nothing is claimed. */
  readonly kind: EventKind;
  /** For a leave. */
  readonly cause: TouchCause;
  /** For what is unresolved. */
  readonly reason: Reason;
  /** On the clock of update(): an enter is never later than it is, a leave never earlier. */
  readonly time: number;
  /** Its own bone or joint; null: all of it. */
  readonly link: string | null;
  /** What it touches: a mesh, or what the other body was added as; null: everything it is asked about. */
  readonly object: O | null;
  readonly otherLink: string | null;
  /** On its own surface. */
  readonly point: Point;
  /** Unit, from the other to it; zero if none is reported. */
  readonly normal: Point;
  /** Above zero while the two approach. */
  readonly approachSpeed: number;
  /** It rests on a body that was silent, and was taken to hold still. */
  readonly isAssumed: boolean;
}

/** A place where a surface holds or pushes a solid body. */
export interface Press<O> {
  readonly link: string | null;
  readonly object: O | null;
  readonly point: Point;
  /** Unit, from the surface to the link. */
  readonly normal: Point;
  /** How hard the tracked pose presses, in metres: times a stiffness (N/m) it is a force. */
  readonly push: number;
  readonly slipSpeed: number;
  readonly gap: number;
}
