// What the page shows right now. Views subscribe and are told which parts changed; several changes
// in one go are told once.

import type { Contact } from "./contacts/contact.js";

export type Theme = "light" | "dark";
export type Shape = "lss" | "mesh";

export interface LinkChoice {
  readonly avatar: number;
  readonly link: number;
}

export interface ViewState {
  /** Seconds of the clip. */
  time: number;
  isPlaying: boolean;
  speed: number;
  contact: Contact | null;
  link: LinkChoice | null;
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
