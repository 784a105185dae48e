// How long answers take, over time: p50 and p99 as the service counts them.

import uPlot from "uplot";
import type { StatusEvent } from "../data/events.js";
import { card, element, explained } from "../panels/dom.js";
import { microseconds } from "../panels/words.js";
import { palettes } from "../scene3d/palette.js";
import type { Store } from "../state.js";

/** Statuses, one a second. */
const kept = 180;
const height = 130;
/** Seconds: a plot of a moment says nothing. */
const leastSpan = 20;

export class LatencyPlot {
  readonly node: HTMLElement;
  private readonly host = element("div", { class: "plot" });
  private plot: uPlot | null = null;
  private readonly seconds: number[] = [];
  private readonly p50: number[] = [];
  private readonly p99: number[] = [];
  private latest: StatusEvent | null = null;

  constructor(private readonly store: Store) {
    this.host.setAttribute("role", "img");
    this.host.setAttribute("aria-label", "p50 and p99 of an answer over the last three minutes");
    const words = element("p", { class: "quiet" }, explained("p50"), element("span", { text: " and " }), explained("p99"), element("span", { text: " from pose to answer, over time" }));
    this.node = card("Latency", words, this.host);
    this.node.hidden = true;
    new ResizeObserver(() => this.plot?.setSize({ width: this.host.clientWidth, height })).observe(this.host);
    store.subscribe((changes) => {
      if (changes.has("theme") && this.plot !== null) this.make();
    });
  }

  add(status: StatusEvent): void {
    const { answer_p50_us: p50, answer_p99_us: p99 } = status;
    if (status === this.latest || p50 === undefined || p99 === undefined) return;
    this.latest = status;
    this.seconds.push(performance.now() / 1000);
    this.p50.push(p50);
    this.p99.push(p99);
    for (const list of [this.seconds, this.p50, this.p99]) if (list.length > kept) list.shift();
    this.node.hidden = false;
    if (this.plot === null) this.make();
    else this.plot.setData(this.data());
  }

  private data(): uPlot.AlignedData {
    const now = this.seconds[this.seconds.length - 1] ?? 0;
    return [this.seconds.map((second) => second - now), [...this.p50], [...this.p99]];
  }

  private make(): void {
    this.plot?.destroy();
    const palette = palettes[this.store.state.theme];
    const axis = { stroke: palette.faint, grid: { stroke: palette.grid, width: 0.5 }, ticks: { show: false }, font: "11px system-ui, sans-serif" };
    const line = (label: string, stroke: string): uPlot.Series => ({ label, stroke, width: 2, points: { show: false } });
    this.plot = new uPlot({
      width: Math.max(200, this.host.clientWidth),
      height,
      cursor: { show: false },
      legend: { show: true, live: false },
      scales: { x: { time: false, range: (_, first) => [Math.min(-leastSpan, first ?? 0), 0] }, y: { range: (_, __, most) => [0, Math.max(1, most) * 1.1] } },
      axes: [
        { ...axis, values: (_, splits) => splits.map((second) => `${second.toFixed(0)} s`), size: 24 },
        { ...axis, values: (_, splits) => splits.map((value) => microseconds(value)), size: 58 },
      ],
      series: [{}, line("p50", palette.avatar), line("p99", palette.verdicts.contact)],
    }, this.data(), this.host);
  }
}
