// The strip of a solid avatar: its state tick by tick, and how far it is from where it is tracked.

import type { Solid, SolidState } from "../data/document.js";
import { solidStates } from "../data/document.js";
import { lastAtMost } from "../motion/clip.js";
import { element } from "../panels/dom.js";
import { length, seconds } from "../panels/words.js";
import type { Palette } from "../scene3d/palette.js";
import type { Window } from "./rows.js";
import { sized } from "./sized.js";

const height = 40, band = 7;

export interface DeviationStrip {
  readonly window: Window;
  readonly width: number;
  readonly gutter: number;
  xOf(time: number): number;
}

export class DeviationPlot {
  readonly canvas = element("canvas", { class: "deviation" });
  private readonly most: number;

  constructor(private readonly solid: Solid) {
    this.most = solid.deviations.reduce((a, b) => Math.max(a, b), 1e-3);
    this.canvas.setAttribute("role", "img");
    this.canvas.setAttribute("aria-label", `State, and deviation from the tracked pose: at most ${length(this.most)}`);
  }

  draw(strip: DeviationStrip, palette: Palette): void {
    const context = sized(this.canvas, height);
    if (context === null) return;
    const { times, states, deviations } = this.solid, { window, gutter, width } = strip;
    context.font = "12px system-ui, sans-serif";
    context.textBaseline = "middle";
    context.fillStyle = palette.faint;
    context.fillText("deviation", 2, height / 2 - 6);
    context.fillText(`to ${length(this.most)}`, 2, height / 2 + 8);
    context.save();
    context.beginPath();
    context.rect(gutter - 1, 0, width, height);
    context.clip();
    // A tick is the way to its instant: it ends there.
    const room = height - band - 6, first = Math.max(1, lastAtMost(times, window.t0)), last = Math.min(times.length - 1, lastAtMost(times, window.t1) + 1);
    let drawnTo = -Infinity, tall = 0;
    for (let i = first; i <= last; ++i) {
      const x0 = strip.xOf(times[i - 1]), x1 = strip.xOf(times[i]);
      tall = Math.max(tall, deviations[i]);
      if (x1 < drawnTo + 0.5 && i < last) continue;
      // On whole pixels: what is drawn side by side shows no gaps.
      const from = Math.round(Math.max(drawnTo, x0)), wide = Math.max(1, Math.round(x1) - from);
      context.fillStyle = colourOf(solidStates[states[i]], palette);
      context.fillRect(from, height - band - 1, wide, band);
      context.fillStyle = palette.tracked;
      context.fillRect(from, 3 + room * (1 - tall / this.most), wide, room * (tall / this.most));
      drawnTo = x1;
      tall = 0;
    }
    context.restore();
    context.fillStyle = palette.grid;
    context.fillRect(gutter, height - 1, width - gutter, 1);
  }

  /** What there is at a time, in words. */
  linesAt(time: number, zero: number): string[] {
    const { times, states, deviations } = this.solid;
    const tick = Math.min(times.length - 1, lastAtMost(times, time) + 1);
    if (tick < 0) return [];
    return [`${solidStates[states[tick]]} at ${seconds(times[tick] - zero)}`, `${length(deviations[tick])} from where it is tracked`];
  }
}

function colourOf(state: SolidState, palette: Palette): string {
  switch (state) {
    case "equal": return palette.avatarHeld;
    case "following": return palette.avatar;
    case "sliding": return palette.verdicts.undecided;
    case "held": return palette.verdicts.contact;
    case "around": return palette.asked;
    case "placing":
    case "snapped": return palette.verdicts.starts_in_contact;
  }
}
