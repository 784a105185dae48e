// State of the connection, and counters of the service and of this page.

import type { StatusName } from "../data/events.js";
import { card, definitionTable, element } from "../panels/dom.js";
import { count, microseconds } from "../panels/words.js";
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
  private isAsked = false;

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
    if (this.isAsked) return;
    this.isAsked = true;
    window.setTimeout(() => {
      this.isAsked = false;
      this.fill(feed);
    }, refreshMs);
  }

  private fill(feed: Feed): void {
    const { status, steps, skipped, lastQueryUs, lastAddedUs, complaint } = feed.state;
    const lines: [string, string, string?][] = counters.flatMap((name): [string, string][] => {
      const value = status[name];
      return value === undefined ? [] : [[name, count(value)]];
    });
    const percentiles = (name: "query" | "answer"): void => {
      const p50 = status[`${name}_p50_us`], p99 = status[`${name}_p99_us`];
      if (p50 !== undefined && p99 !== undefined) lines.push([`${name}, half below`, microseconds(p50), `99 in 100 below ${microseconds(p99)}`]);
    };
    percentiles("query");
    percentiles("answer");
    lines.push(["last query", microseconds(lastQueryUs), `${microseconds(lastAddedUs)} added by the stream`]);
    lines.push(["steps", count(steps), skipped > 0 ? `${count(skipped)} of them not sent to this page` : ""]);
    this.body.replaceChildren(definitionTable(lines));
    if (complaint !== "") this.body.append(element("p", { class: "complaint", text: `Not shown: ${complaint}` }));
  }
}
