// The stream: server-sent events become steps, contacts and counters. What is malformed is counted
// and told, and does not stop the rest.

import type { Contact } from "../contacts/contact.js";
import { contactOf } from "../contacts/contact.js";
import { joinedPerson } from "../contacts/person.js";
import type { ShownStep, StatusEvent, StepEvent } from "../data/events.js";
import type { Touch } from "../contacts/touch.js";
import { decodeDocument } from "../data/decode.js";
import { decodeStatus, decodeStep, UnknownAvatar } from "../data/events.js";
import type { Model } from "../model.js";
import type { LocalPose } from "../motion/chain.js";
import type { Span } from "../motion/clip.js";
import type { Store } from "../state.js";
import { LiveClip } from "./live_clip.js";
import { servedDocument } from "./served.js";

export type Connection = "connecting" | "connected" | "reconnecting";

export interface FeedState {
  readonly connection: Connection;
  readonly status: StatusEvent;
  readonly steps: number;
  readonly skipped: number;
  readonly lost: number;
  /** That came, whether still kept or not. */
  readonly contacts: number;
  readonly latest: Contact | null;
  readonly lastQueryUs: number;
  readonly lastAddedUs: number;
  /** Of solid avatars: what each showed last, by its index. */
  readonly shown: ReadonlyMap<number, ShownStep>;
  /** Of the last malformed event; "" where there was none. */
  readonly complaint: string;
}

const retryMs = 2000;
/** The document is not asked for more often than this, milliseconds. */
const askAgainMs = 1000;

export class Feed {
  state: FeedState = {
    connection: "connecting", status: {}, steps: 0, skipped: 0, lost: 0, contacts: 0, latest: null,
    lastQueryUs: 0, lastAddedUs: 0, shown: new Map(), complaint: "",
  };
  private contacts: Contact[] = [];
  private source: EventSource | null = null;
  private isAsking = false;

  constructor(
    private readonly address: string,
    private readonly model: Model,
    private readonly store: Store,
    private readonly onState: () => void,
    private readonly onTouch: (begun: readonly Touch[]) => void,
  ) {}

  start(): void {
    const source = new EventSource(this.address);
    this.source = source;
    source.addEventListener("open", () => this.set({ connection: "connected" }));
    source.addEventListener("step", (event) => this.guarded(() => this.takeStep(decodeStep(String(event.data), this.model.avatars))));
    source.addEventListener("status", (event) => this.guarded(() => this.set({ status: decodeStatus(String(event.data)) })));
    source.addEventListener("error", () => this.retry());
  }

  /** For people: of one of several avatars, its number. */
  nameOf(avatar: number): string {
    const { avatars } = this.model;
    return avatars.length > 1 ? `body ${avatars[avatar].id}` : "body";
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
      if (error instanceof UnknownAvatar) void this.meet(error);
      else this.complain(error);
    }
  }

  /** An avatar has joined: the document has it by now. Its steps until then are not shown. */
  private async meet(stranger: UnknownAvatar): Promise<void> {
    if (this.isAsking) return;
    this.isAsking = true;
    try {
      const { avatars } = decodeDocument(await servedDocument());
      if (this.model.join(avatars)) this.store.listChanged("avatars");
      else this.complain(stranger);
    } catch (error) {
      this.complain(error);
    }
    window.setTimeout(() => (this.isAsking = false), askAgainMs);
  }

  private complain(error: unknown): void {
    this.set({ complaint: error instanceof Error ? error.message : String(error) });
  }

  private takeStep(event: StepEvent): void {
    const clip = this.model.clips[event.avatar];
    if (!(clip instanceof LiveClip)) return;
    // A first pose has no step before it: it is held for no time at all.
    const span = { t0: event.t0, t1: Math.max(event.t1, event.t0 + 1e-6) };
    const tracked = this.model.tracked[event.avatar];
    if (tracked instanceof LiveClip) takePoses(tracked, event, span, event);
    const step = takePoses(clip, event, span, event.shown ?? event);
    const links = this.model.avatars[event.avatar].links;
    const fresh = event.contacts.map((fields) => contactOf(event.avatar, links[fields.link].name, span, { ...fields, step }));
    this.count(event, fresh);
    this.keep(fresh);
    this.keepPerson(event);
  }

  /** In words first: a drawing is never waited for. */
  private count(event: StepEvent, fresh: readonly Contact[]): void {
    const { steps, skipped, lost, contacts, latest } = this.state;
    const met = fresh.filter(({ verdict }) => verdict !== "undecided");
    this.set({
      steps: steps + 1 + event.skipped,
      skipped: skipped + event.skipped,
      lost: lost + event.lost,
      contacts: contacts + met.length,
      latest: met[met.length - 1] ?? latest,
      lastQueryUs: event.queryUs,
      lastAddedUs: event.addedUs,
      shown: event.shown === null ? this.state.shown : new Map(this.state.shown).set(event.avatar, event.shown),
    });
  }

  /** Contacts go with the steps that they belong to. */
  private keep(fresh: readonly Contact[]): void {
    const kept = this.contacts.filter((one) => this.model.clips[one.avatar].spanOf(one.step) !== null);
    if (kept.length === this.contacts.length && fresh.length === 0) return;
    this.contacts = [...kept, ...fresh].sort((a, b) => a.at - b.at);
    this.model.replaceContacts([...this.contacts]);
    const isFresh = new Set(fresh);
    this.onTouch(this.model.touches.filter(({ rows, isUndecided }) => !isUndecided && isFresh.has(rows[0])));
    this.store.listChanged("contacts");
  }

  /** As long as the steps that they belong to. */
  private keepPerson({ person }: StepEvent): void {
    const known = this.model.person?.touches ?? [], kept = known.filter(({ avatar, end }) => end >= this.model.clips[avatar].start);
    if (person.length === 0 && kept.length === known.length) return;
    this.model.replacePerson(joinedPerson(kept, person));
    this.store.listChanged("contacts");
  }

  private set(changes: Partial<FeedState>): void {
    this.state = { ...this.state, ...changes };
    this.onState();
  }
}

/** The number of the step. */
function takePoses(clip: LiveClip, event: StepEvent, span: Span, { from, to }: { from: LocalPose; to: LocalPose }): number {
  if (event.skipped > 0) bridge(clip, event.t0, from);
  return clip.add({ ...span, from, to });
}

/** Steps that were answered but not sent: straight over them, rather than standing still. */
function bridge(clip: LiveClip, t1: number, to: LocalPose): void {
  const from = clip.latestPose;
  if (from !== null && t1 > clip.end) clip.add({ t0: clip.end, t1, from, to });
}
