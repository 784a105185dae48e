// State of the connection, and counters of the service and of this page.

import type { Contact } from "../contacts/contact.js";
import type { StatusName } from "../data/events.js";
import { card, definitionTable, element } from "../panels/dom.js";
import { count, length, microseconds } from "../panels/words.js";
import type { ShownStep } from "../data/events.js";
import type { Feed } from "./feed.js";

const connectionWords = {
  connecting: "Connecting …",
  connected: "Connected",
  reconnecting: "Connection lost, trying again …",
};
const counters: readonly StatusName[] = ["answered", "rejected", "lost", "gaps", "waiting", "viewers"];
/** Writing more often than this is not read. */
const refreshMs = 250;

export class LiveCard {
  readonly node: HTMLElement;
  private readonly connection = element("p", { class: "connection" });
  private readonly body = element("div");
  private timer: number | null = null;
  private stillUntil = 0;
  private contactsShown = 0;

  constructor() {
    this.connection.setAttribute("role", "status");
    this.node = card("Stream", this.connection, this.body);
  }

  update(feed: Feed): void {
    const { connection } = feed.state;
    if (this.connection.dataset["state"] !== connection) {
      this.connection.dataset["state"] = connection;
      this.connection.textContent = connectionWords[connection];
    }
    // New contacts are told at once, figures alone now and then.
    const isUrgent = feed.state.contacts !== this.contactsShown;
    if (isUrgent || performance.now() >= this.stillUntil) return this.fill(feed);
    this.timer ??= window.setTimeout(() => this.fill(feed), refreshMs);
  }

  private fill(feed: Feed): void {
    window.clearTimeout(this.timer ?? undefined);
    this.timer = null;
    this.stillUntil = performance.now() + refreshMs;
    this.contactsShown = feed.state.contacts;
    const { status, steps, skipped, contacts, latest, lastQueryUs, lastAddedUs, complaint } = feed.state;
    const lines: [string, string, string?][] = [["contacts", count(contacts), latest === null ? "" : `the latest: ${nameOf(latest)}`]];
    for (const [avatar, shown] of feed.state.shown) lines.unshift([`shown ${feed.nameOf(avatar)}`, shown.state, wordsOfShown(shown)]);
    for (const name of counters) {
      const value = status[name];
      if (value !== undefined) lines.push([name, count(value)]);
    }
    for (const name of ["query", "answer"] as const) {
      for (const share of ["p50", "p99"] as const) {
        const value = status[`${name}_${share}_us`];
        if (value !== undefined) lines.push([`${name} ${share}`, microseconds(value)]);
      }
    }
    lines.push(["last query", microseconds(lastQueryUs), `${microseconds(lastAddedUs)} added by the stream`]);
    lines.push(["steps", count(steps), skipped > 0 ? `${count(skipped)} of them were not sent, so that this page keeps up` : ""]);
    this.body.replaceChildren(definitionTable(lines));
    if (complaint !== "") this.body.append(element("p", { class: "complaint", text: `Not shown: ${complaint}` }));
  }
}

function wordsOfShown({ state, limit, isCertified, deviation, snapIn }: ShownStep): string {
  const far = state === "equal" ? "where it is tracked" : state === "placing" ? "no free place yet" : `${length(deviation)} from where it is tracked`;
  const why = limit === "none" ? "" : `, ${limit}`;
  const proof = isCertified || state === "placing" ? "" : ", not certified";
  return `${far}${why}${proof}${snapIn === null ? "" : `, snaps in ${snapIn.toFixed(2)} s`}`;
}

function nameOf({ linkName, object }: Contact): string {
  return object === null ? linkName : `${linkName} × ${object}`;
}
