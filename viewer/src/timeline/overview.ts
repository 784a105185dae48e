// The whole clip in a strip: how much touches when, and what part of it the timeline shows.

import type { Touch } from "../contacts/touch.js";
import { whose } from "../contacts/touch.js";
import { element } from "../panels/dom.js";
import type { Palette } from "../scene3d/palette.js";
import { Gestures } from "./gestures.js";
import type { Window } from "./rows.js";
import { densityOf } from "./rows.js";
import { sized } from "./sized.js";

const height = 26;
/** CSS pixels. */
const binWidth = 2;

export interface Strip {
  readonly touches: readonly Touch[];
  readonly whole: Window;
  readonly window: Window;
  readonly gutter: number;
  readonly width: number;
}

export class Overview {
  private readonly canvas = element("canvas", { class: "overview", title: "The whole clip: drag to move what is shown below" });
  /** Over the canvas, which stays as it is while only time goes on. */
  private readonly now = element("div", { class: "now" });
  readonly node = element("div", { class: "whole" }, this.canvas, this.now);
  private strip: Strip | null = null;

  constructor(moveTo: (middle: number) => void, zoom: (factor: number, anchor: number) => void) {
    this.canvas.setAttribute("role", "img");
    this.canvas.setAttribute("aria-label", "How much touches over the whole clip");
    new Gestures(this.canvas, {
      click: (x) => moveTo(this.timeAt(x)),
      drag: (_, x) => moveTo(this.timeAt(x)),
      zoom: (factor, x) => zoom(factor, this.timeAt(x)),
      hover: () => {},
      leave: () => {},
      scrolls: () => false,
    });
  }

  draw(strip: Strip, palette: Palette): void {
    this.strip = strip;
    const context = sized(this.canvas, height);
    if (context === null) return;
    const { whole, window, gutter, width } = strip;
    const span = Math.max(1, width - gutter), xOf = (time: number): number => gutter + ((time - whole.t0) / (whole.t1 - whole.t0)) * span;
    const bins = Math.max(1, Math.floor(span / binWidth)), links = strip.touches.filter((touch) => whose(touch) === "link");
    const all = densityOf(links, whole, bins), ground = densityOf(links.filter(({ isGround }) => isGround), whole, bins);
    const most = all.reduce((a, b) => Math.max(a, b), 1);
    // As the bars below: the ground at the foot of each column, in its colour.
    all.forEach((value, bin) => {
      const tall = value === 0 ? 0 : 2 + (height - 5) * (value / most), low = value === 0 ? 0 : tall * (ground[bin] / value);
      context.fillStyle = palette.ground;
      context.fillRect(gutter + bin * binWidth, height - 1 - low, binWidth, low);
      context.fillStyle = palette.verdicts.contact;
      context.fillRect(gutter + bin * binWidth, height - 1 - tall, binWidth, tall - low);
    });
    context.fillStyle = palette.grid;
    context.fillRect(gutter, height - 1, span, 1);
    if (window.t1 - window.t0 < 0.999 * (whole.t1 - whole.t0)) {
      context.strokeStyle = context.fillStyle = palette.ink;
      const x0 = xOf(window.t0), x1 = Math.max(x0 + 3, xOf(window.t1));
      context.globalAlpha = 0.12;
      context.fillRect(x0, 0, x1 - x0, height);
      context.globalAlpha = 1;
      context.strokeRect(x0 + 0.5, 0.5, x1 - x0 - 1, height - 1);
    }
  }

  showTime(time: number): void {
    if (this.strip === null) return;
    const { whole, gutter, width } = this.strip;
    const x = gutter + ((time - whole.t0) / (whole.t1 - whole.t0)) * Math.max(1, width - gutter);
    this.now.style.transform = `translateX(${(x - 0.75).toFixed(2)}px)`;
  }

  private timeAt(x: number): number {
    const { strip } = this;
    if (strip === null) return 0;
    const share = (x - strip.gutter) / Math.max(1, strip.width - strip.gutter);
    return strip.whole.t0 + Math.min(1, Math.max(0, share)) * (strip.whole.t1 - strip.whole.t0);
  }
}
