// The edge between the view and the timeline: drag it, or use the arrow keys.

import { element } from "../panels/dom.js";

/** Of the window's height, at first and at most. */
const openingShare = 0.15, mostShare = 0.6;
const fewestRows = 2, firstRowsAtLeast = 4;

export class Splitter {
  readonly node = element("div", { class: "splitter", label: "Height of the timeline", title: "Drag: more or fewer rows" });
  private rows = firstRowsAtLeast;

  constructor(
    private readonly target: HTMLElement,
    private readonly rowHeight: number,
    private readonly rowCount: () => number,
  ) {
    this.node.setAttribute("role", "separator");
    this.node.tabIndex = 0;
    let from: { y: number; rows: number } | null = null;
    this.node.addEventListener("pointerdown", (event) => {
      this.node.setPointerCapture(event.pointerId);
      from = { y: event.clientY, rows: this.rows };
    });
    this.node.addEventListener("pointermove", (event) => {
      if (from !== null) this.show(from.rows + (from.y - event.clientY) / rowHeight);
    });
    this.node.addEventListener("pointerup", () => (from = null));
    this.node.addEventListener("keydown", (event) => {
      const by = event.key === "ArrowUp" ? 1 : event.key === "ArrowDown" ? -1 : 0;
      if (by === 0) return;
      event.preventDefault();
      this.show(this.rows + by);
    });
  }

  /** As many rows as there are, if the window has room for them. */
  fit(): void {
    const room = Math.max(firstRowsAtLeast, Math.floor((openingShare * window.innerHeight) / this.rowHeight));
    this.show(Math.min(Math.max(fewestRows, this.rowCount()), room));
  }

  /** Whole rows: none is cut in half. */
  private show(rows: number): void {
    const most = Math.floor((mostShare * window.innerHeight) / this.rowHeight);
    this.rows = Math.min(most, Math.max(fewestRows, Math.round(rows)));
    this.target.style.height = `${this.rows * this.rowHeight}px`;
  }
}
