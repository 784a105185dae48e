// What a check of the poses sees (left) and what happened (right), side by side: the same sight in
// both, and a divider between them that can be dragged.

import { element } from "../panels/dom.js";
import type { Part } from "./stage.js";

/** Of the width, with the arrow keys. */
const nudge = 0.05;
const least = 0.1;

export class Wipe {
  private share = 0.5;
  private readonly handle = element("div", { class: "wipe-handle", label: "Where the check ends and the truth begins" });
  private readonly node = element("div", { class: "wipe" },
    element("span", { class: "wipe-side check", text: "What a check of the poses sees" }),
    this.handle,
    element("span", { class: "wipe-side truth", text: "What happened" }));

  constructor(
    host: HTMLElement,
    private readonly onMove: () => void,
  ) {
    this.handle.setAttribute("role", "slider");
    this.handle.tabIndex = 0;
    this.handle.title = "Drag: left of it is what a check of the poses sees, right of it what happened";
    this.handle.addEventListener("pointerdown", (event) => this.handle.setPointerCapture(event.pointerId));
    this.handle.addEventListener("pointermove", (event) => {
      if (!this.handle.hasPointerCapture(event.pointerId)) return;
      const { left, width } = host.getBoundingClientRect();
      this.moveTo((event.clientX - left) / Math.max(1, width));
    });
    this.handle.addEventListener("keydown", (event) => {
      const by = event.key === "ArrowLeft" ? -nudge : event.key === "ArrowRight" ? nudge : 0;
      if (by === 0) return;
      event.preventDefault();
      event.stopPropagation();
      this.moveTo(this.share + by);
    });
    host.append(this.node);
    this.moveTo(this.share);
    this.hide();
  }

  show(): void {
    this.node.hidden = false;
  }

  hide(): void {
    this.node.hidden = true;
  }

  /** The two parts of a picture, each with what puts it on the stage. */
  parts(check: () => void, truth: () => void): Part[] {
    return [{ from: 0, to: this.share, prepare: check }, { from: this.share, to: 1, prepare: truth }];
  }

  private moveTo(share: number): void {
    this.share = Math.min(1 - least, Math.max(least, share));
    this.node.style.setProperty("--share", `${(100 * this.share).toFixed(2)}%`);
    this.handle.setAttribute("aria-valuenow", String(Math.round(100 * this.share)));
    this.onMove();
  }
}
