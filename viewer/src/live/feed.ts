// The stream: server-sent events become steps, contacts and counters. What is malformed is counted
// and told, and does not stop the rest.

import type { Contact } from "../contacts/contact.js";
import { contactOf } from "../contacts/contact.js";
import type { StatusEvent, StepEvent } from "../data/events.js";
import { decodeStatus, decodeStep } from "../data/events.js";
import type { Model } from "../model.js";
import type { Store } from "../state.js";
import { LiveClip } from "./live_clip.js";

export type Connection = "connecting" | "connected" | "reconnecting";

export interface FeedState {
  readonly connection: Connection;
  readonly status: StatusEvent;
  readonly steps: number;
  readonly skipped: number;
  readonly lost: number;
  readonly lastQueryUs: number;
  readonly lastAddedUs: number;
  /** Of the last malformed event; "" where there was none. */
  readonly complaint: string;
}

const retryMs = 2000;

export class Feed {
  state: FeedState = {
    connection: "connecting", status: {}, steps: 0, skipped: 0, lost: 0, lastQueryUs: 0, lastAddedUs: 0, complaint: "",
  };
  private contacts: Contact[] = [];
  private source: EventSource | null = null;

  constructor(
    private readonly address: string,
    private readonly model: Model,
    private readonly store: Store,
    private readonly onState: () => void,
  ) {}

  start(): void {
    const source = new EventSource(this.address);
    this.source = source;
    source.addEventListener("open", () => this.set({ connection: "connected" }));
    source.addEventListener("step", (event) => this.guarded(() => this.takeStep(decodeStep(String(event.data), this.model.avatars))));
    source.addEventListener("status", (event) => this.guarded(() => this.set({ status: decodeStatus(String(event.data)) })));
    source.addEventListener("error", () => this.retry());
  }

  /** The browser reconnects by itself, unless the server refused: then we do. */
  private retry(): void {
    this.set({ connection: "reconnecting" });
    if (this.source?.readyState !== EventSource.CLOSED) return;
    window.setTimeout(() => this.start(), retryMs);
  }

  private guarded(take: () => void): void {
    try {
      take();
    } catch (error) {
      this.set({ complaint: error instanceof Error ? error.message : String(error) });
    }
  }

  private takeStep(event: StepEvent): void {
    const clip = this.model.clips[event.avatar];
    if (!(clip instanceof LiveClip)) return;
    // A first pose has no step before it: it is held for no time at all.
    const span = { t0: event.t0, t1: Math.max(event.t1, event.t0 + 1e-6) };
    if (event.skipped > 0) bridge(clip, event);
    const step = clip.add({ ...span, from: event.from, to: event.to });
    const links = this.model.avatars[event.avatar].links;
    for (const fields of event.contacts) {
      this.contacts.push(contactOf(event.avatar, links[fields.link].name, span, { ...fields, step }));
    }
    const kept = this.contacts.filter((one) => this.model.clips[one.avatar].spanOf(one.step) !== null);
    if (kept.length !== this.contacts.length || event.contacts.length > 0) {
      this.contacts = kept.sort((a, b) => a.at - b.at);
      this.model.replaceContacts([...this.contacts]);
      this.store.contactsChanged();
    }
    const { steps, skipped, lost } = this.state;
    this.set({
      steps: steps + 1 + event.skipped,
      skipped: skipped + event.skipped,
      lost: lost + event.lost,
      lastQueryUs: event.queryUs,
      lastAddedUs: event.addedUs,
    });
  }

  private set(changes: Partial<FeedState>): void {
    this.state = { ...this.state, ...changes };
    this.onState();
  }
}

/** Steps that were answered but not sent: straight over them, rather than standing still. */
function bridge(clip: LiveClip, event: StepEvent): void {
  const from = clip.latestPose;
  if (from !== null && event.t0 > clip.end) clip.add({ t0: clip.end, t1: event.t0, from, to: event.from });
}
