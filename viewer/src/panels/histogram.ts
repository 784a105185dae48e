// How long steps took, as a histogram over a logarithmic axis.

import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import { palettes } from "../scene3d/palette.js";
import type { Store } from "../state.js";
import { card, element } from "./dom.js";
import { microseconds, plural } from "./words.js";

const binsPerDecade = 10;
const height = 150;

export class Histogram {
  readonly node: HTMLElement;
  private readonly host = element("div", { class: "plot" });
  private plot: uPlot | null = null;
  private readonly bins: uPlot.AlignedData;

  /** `latencies` in microseconds, at least one above zero. */
  constructor(
    latencies: readonly number[],
    private readonly store: Store,
  ) {
    const sorted = latencies.filter((value) => value > 0).sort((a, b) => a - b);
    this.bins = binned(sorted);
    const at = (share: number): string => microseconds(sorted[Math.ceil(share * sorted.length) - 1]);
    const words = `Half of ${plural(sorted.length, "step")} took at most ${at(0.5)}, 99 in 100 at most ${at(0.99)}, the longest ${microseconds(sorted[sorted.length - 1])}.`;
    this.host.setAttribute("role", "img");
    this.host.setAttribute("aria-label", `Histogram of the time a step took. ${words}`);
    this.node = card("Time a step took", element("p", { class: "quiet", text: words }), this.host);
    new ResizeObserver(() => this.plot?.setSize({ width: this.host.clientWidth, height })).observe(this.host);
  }

  /** To be called once it is on the page, and again when the theme changes. */
  draw(): void {
    this.plot?.destroy();
    const palette = palettes[this.store.state.theme];
    const axis = { stroke: palette.faint, grid: { stroke: palette.grid, width: 0.5 }, ticks: { show: false }, font: "11px system-ui, sans-serif" };
    const bars = uPlot.paths.bars;
    this.plot = new uPlot({
      width: Math.max(200, this.host.clientWidth),
      height,
      legend: { show: false },
      cursor: { show: false },
      scales: { x: { time: false }, y: { range: (_, __, max) => [0, Math.max(1, max) * 1.08] } },
      axes: [
        { ...axis, splits: decades(this.bins[0]), values: (_, splits) => splits.map((v) => microseconds(10 ** v)), space: 40, size: 26 },
        { ...axis, size: 44 },
      ],
      series: [{}, {
        fill: palette.avatar,
        stroke: palette.avatar,
        width: 0,
        points: { show: false },
        ...(bars === undefined ? {} : { paths: bars({ size: [0.86, 100], align: 0 }) }),
      }],
    }, this.bins, this.host);
  }
}

/** Centres of the bins as powers of ten, and how many lie in each. */
function binned(sorted: readonly number[]): uPlot.AlignedData {
  const bin = (value: number): number => Math.floor(Math.log10(value) * binsPerDecade);
  const first = bin(sorted[0]) - 1, last = bin(sorted[sorted.length - 1]) + 1;
  const counts = new Array<number>(last - first + 1).fill(0);
  for (const value of sorted) ++counts[bin(value) - first];
  return [counts.map((_, i) => (first + i + 0.5) / binsPerDecade), counts];
}

/** At whole powers of ten, or at halves where there are few. */
function decades(centres: ArrayLike<number>): (self: uPlot) => number[] {
  return () => {
    const low = centres[0], high = centres[centres.length - 1];
    const step = high - low > 2 ? 1 : 0.5;
    const splits: number[] = [];
    for (let v = Math.ceil(low / step) * step; v <= high; v += step) splits.push(v);
    return splits;
  };
}
