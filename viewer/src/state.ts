// What the page shows right now. Views subscribe and are told which parts changed; several changes
// in one go are told once.

import type { Contact } from "./contacts/contact.js";
import type { Touch } from "./contacts/touch.js";
import type { Vector } from "./data/document.js";
import type { Place } from "./motion/placing.js";

export type Theme = "light" | "dark";
export type Shape = "lss" | "mesh";

export interface LinkChoice {
  readonly avatar: number;
  readonly link: number;
}

/** What the ray through the last click met at the shown instant. Metres, world. */
export interface RayHit {
  /** Of the clip, seconds. */
  readonly time: number;
  readonly origin: Vector;
  /** Unit. */
  readonly direction: Vector;
  /** The nearest link, as "Anna's LeftHand"; null: none. */
  readonly link: string | null;
  readonly linkDistance: number;
  /** The first object of the scene; null: none. */
  readonly object: string | null;
  readonly objectDistance: number;
}

export interface ViewState {
  /** Seconds of the clip. */
  time: number;
  isPlaying: boolean;
  speed: number;
  touch: Touch | null;
  /** A row of the touch; null where the document carries none of them. */
  contact: Contact | null;
  link: LinkChoice | null;
  /** Null where nothing was met, or something else is chosen. */
  ray: RayHit | null;
  /** Beside what happened, what a check of the poses alone sees. */
  showsDiscrete: boolean;
  showsGhosts: boolean;
  showsSwept: boolean;
  cutsAway: boolean;
  /** Whether the camera goes along with the avatar while time runs. */
  tracks: boolean;
  shape: Shape;
  theme: Theme;
  /** Live only: whether time follows the stream. */
  follows: boolean;
  /** What is looked for: touches whose names have all these words. */
  search: string;
  showsGround: boolean;
  /** Inspections: where the body would stand; null where nobody has clicked. */
  place: Place | null;
  /** Inspections: why the last click put the body nowhere; null where it did. */
  refusal: string | null;
}

export type Change = keyof ViewState | "contacts" | "avatars";
type Listener = (changes: ReadonlySet<Change>) => void;

export class Store {
  private readonly listeners: Listener[] = [];
  private depth = 0;
  private pending = new Set<Change>();

  constructor(readonly state: Readonly<ViewState>) {}

  subscribe(listener: Listener): void {
    this.listeners.push(listener);
  }

  set(changes: Partial<ViewState>): void {
    const state = this.state as ViewState;
    this.batch(() => {
      for (const key of Object.keys(changes) as (keyof ViewState)[]) {
        if (Object.is(state[key], changes[key])) continue;
        Object.assign(state, { [key]: changes[key] });
        this.pending.add(key);
      }
    });
  }

  /** The list itself has changed (live). */
  listChanged(list: "contacts" | "avatars"): void {
    this.batch(() => this.pending.add(list));
  }

  private batch(change: () => void): void {
    ++this.depth;
    change();
    --this.depth;
    if (this.depth > 0 || this.pending.size === 0) return;
    const changes = this.pending;
    this.pending = new Set();
    for (const listener of this.listeners) listener(changes);
  }
}
