// The timeline: a row a link or an object, a bar a touch from its begin to its end. Click goes
// there, drag moves, the wheel zooms at the pointer; above it the whole clip.

import type { Touch } from "../contacts/touch.js";
import { lastAtMost } from "../motion/clip.js";
import type { Model } from "../model.js";
import { chooseTouch } from "../panels/choosing.js";
import { element, setText } from "../panels/dom.js";
import { plural } from "../panels/words.js";
import { palettes } from "../scene3d/palette.js";
import type { Change, Store } from "../state.js";
import { DeviationPlot } from "./deviation.js";
import { Gestures } from "./gestures.js";
import { drawLanes, rowHeight } from "./lanes.js";
import { Overview } from "./overview.js";
import type { Grouping, Row, Window } from "./rows.js";
import { moved, nearestTouch, rowsOf, ticks, zoomed } from "./rows.js";
import { sized } from "./sized.js";
import { Splitter } from "./splitter.js";
import { timelineBar } from "./timeline_bar.js";
import { linesOfRow, linesOfTouch, Tip } from "./tip.js";

const axisHeight = 26;
const maxGutter = 150, gutterShare = 0.26;
/** Beside a bar, CSS pixels. */
const reach = 8;
const zoomStep = 0.6;
/** How often the window of a stream moves without new contacts, milliseconds. */
const liveWindowMs = 250;
/** Room for what a stream has not brought yet. */
const rowsOfLive = 6;

export class Timeline {
  readonly node = element("section", { class: "timeline", label: "Timeline of touches" });
  private readonly axis = element("canvas", { class: "axis" });
  private readonly canvas = element("canvas", { class: "bars" });
  /** Of the first solid avatar; null where there is none. */
  private readonly deviation: DeviationPlot | null;
  private readonly scroll = element("div", { class: "scroll" }, this.canvas);
  /** Over both canvases, which stay as they are while only time goes on. */
  private readonly playhead = element("div", { class: "playhead" });
  private readonly hint = element("p", { class: "hint" });
  private readonly tip = new Tip();
  private readonly overview: Overview;
  private rows: Row[] = [];
  private readonly folded = new Set<string>();
  private grouping: Grouping = "limb";
  private window: Window;
  /** Of the canvases, CSS pixels: asked for once a drawing, for each asking lays the page out anew. */
  private width = 0;
  private isAsked = false;
  private isNew = true;
  /** Until when a live window stays where it is, milliseconds. */
  private stillUntil = 0;

  constructor(
    private readonly model: Model,
    private readonly store: Store,
  ) {
    this.window = this.whole();
    this.overview = new Overview(
      (middle) => this.move(middle - (this.window.t0 + this.window.t1) / 2),
      (factor, anchor) => this.zoom(factor, anchor),
    );
    const splitter = new Splitter(this.scroll, rowHeight, () => Math.max(this.rows.length, model.isLive ? rowsOfLive : 0));
    const solid = model.avatars.find((avatar) => avatar.solid !== null)?.solid ?? null;
    this.deviation = solid === null ? null : new DeviationPlot(solid);
    const tracks = element("div", { class: "tracks" }, this.axis, ...(this.deviation === null ? [] : [this.deviation.canvas]), this.scroll, this.playhead);
    this.node.append(splitter.node, this.makeBar(), this.overview.node, tracks);
    document.body.append(this.tip.node);
    this.listen(this.axis, true);
    this.listen(this.canvas, false);
    this.listenToDeviation();
    this.refreshRows();
    splitter.fit();
    new ResizeObserver(() => this.draw()).observe(this.node);
  }

  update(changes: ReadonlySet<Change>): void {
    if (changes.has("contacts") || changes.has("search") || changes.has("showsGround")) this.refreshRows();
    const before = this.window;
    if (this.model.isLive) this.followStream(changes.has("contacts"));
    else if (changes.has("time")) this.followTime();
    if (changes.has("touch")) this.showRow();
    const isTimeAlone = changes.size === 1 && changes.has("time") && this.window === before;
    if (isTimeAlone) this.movePlayhead();
    else this.draw();
  }

  private refreshRows(): void {
    this.rows = rowsOf(this.shownTouches(), this.model.avatars, this.grouping, this.folded, this.model.document.person?.bounds);
  }

  private shownTouches(): readonly Touch[] {
    const { search, showsGround } = this.store.state;
    return this.model.shownTouches(search, showsGround);
  }

  /** The window of a stream grows with it: at once where there are new contacts, else now and then. */
  private followStream(isUrgent: boolean): void {
    const now = performance.now();
    if (isUrgent || now >= this.stillUntil) {
      this.window = this.whole();
      this.stillUntil = now + liveWindowMs;
    }
  }

  /** Scrolls to the row of what is chosen. */
  private showRow(): void {
    const { touch } = this.store.state;
    const row = touch === null ? -1 : this.rows.findIndex((one) => !one.isHeading && one.touches.includes(touch));
    const top = row * rowHeight, { scrollTop, clientHeight } = this.scroll;
    const isSeen = top >= scrollTop && top + rowHeight <= scrollTop + clientHeight;
    if (row >= 0 && !isSeen) this.scroll.scrollTop = rowHeight * Math.round((top - (clientHeight - rowHeight) / 2) / rowHeight);
  }

  private whole(): Window {
    const { start, end } = this.model;
    return { t0: start, t1: end > start ? end : start + 1 };
  }

  /** The time shown stays within the window. */
  private followTime(): void {
    const { time } = this.store.state, { t0, t1 } = this.window;
    if (time >= t0 && time <= t1) return;
    this.window = moved(this.window, time - (t0 + 0.15 * (t1 - t0)), this.whole());
  }

  private makeBar(): HTMLElement {
    const middle = (): number => this.store.state.time;
    return timelineBar(this.model, this.store, {
      in: () => this.zoom(zoomStep, middle()),
      out: () => this.zoom(1 / zoomStep, middle()),
      all: () => this.show(this.whole()),
      group: (grouping) => {
        this.grouping = grouping;
        this.refreshRows();
        this.draw();
      },
    }, this.hint);
  }

  private listen(canvas: HTMLCanvasElement, isAxis: boolean): void {
    canvas.setAttribute("role", "img");
    new Gestures(canvas, {
      click: (x, y) => this.click(x, isAxis ? -1 : y),
      drag: (dx, x) => (isAxis ? this.seek(x) : this.move(-dx * this.secondsPerPixel())),
      zoom: (factor, x) => this.zoom(factor, this.timeAt(x)),
      hover: (x, y) => this.hover(canvas, x, y, isAxis),
      leave: () => this.tip.hide(),
      scrolls: (x) => !isAxis && x < this.gutter(),
    });
  }

  private listenToDeviation(): void {
    const { deviation } = this;
    if (deviation === null) return;
    new Gestures(deviation.canvas, {
      click: (x) => this.seek(x),
      drag: (_, x) => this.seek(x),
      zoom: (factor, x) => this.zoom(factor, this.timeAt(x)),
      hover: (x, y) => {
        const { left, top } = deviation.canvas.getBoundingClientRect();
        this.tip.show(x < this.gutter() ? [] : deviation.linesAt(this.timeAt(x), this.model.timeZero), left + x, top + y);
      },
      leave: () => this.tip.hide(),
      scrolls: () => false,
    });
  }

  private show(window: Window): void {
    this.window = window;
    this.draw();
  }

  private zoom(factor: number, anchor: number): void {
    this.show(zoomed(this.window, factor, anchor, this.whole()));
  }

  private move(by: number): void {
    this.show(moved(this.window, by, this.whole()));
  }

  private gutter(): number {
    return Math.min(maxGutter, Math.round(this.width * gutterShare));
  }

  private secondsPerPixel(): number {
    return (this.window.t1 - this.window.t0) / Math.max(1, this.width - this.gutter() - reach);
  }

  private timeAt(x: number): number {
    return this.window.t0 + (x - this.gutter()) * this.secondsPerPixel();
  }

  private xOf(time: number): number {
    return this.gutter() + (time - this.window.t0) / this.secondsPerPixel();
  }

  private touchAt(x: number, y: number): Touch | null {
    const row = this.rows[Math.floor(y / rowHeight)];
    if (y < 0 || row === undefined || x < this.gutter()) return null;
    return nearestTouch(row, this.timeAt(x), reach * this.secondsPerPixel());
  }

  private click(x: number, y: number): void {
    const row = y < 0 ? undefined : this.rows[Math.floor(y / rowHeight)];
    if (row !== undefined && x < this.gutter()) return this.clickName(row);
    const touch = this.touchAt(x, y);
    if (touch !== null) chooseTouch(this.store, this.model, touch);
    else this.seek(x);
  }

  private seek(x: number): void {
    const { start, end } = this.model;
    const time = Math.min(end, Math.max(start, this.timeAt(x)));
    this.store.set({ time, contact: null, touch: null, isPlaying: false, follows: false });
  }

  private clickName(row: Row): void {
    if (row.link >= 0) return this.store.set({ link: { avatar: row.avatar, link: row.link }, contact: null, touch: null });
    if (!row.isHeading) return;
    if (!this.folded.delete(row.group)) this.folded.add(row.group);
    this.refreshRows();
    this.draw();
  }

  private hover(canvas: HTMLCanvasElement, x: number, y: number, isAxis: boolean): void {
    const row = isAxis ? undefined : this.rows[Math.floor(y / rowHeight)];
    const touch = isAxis ? null : this.touchAt(x, y);
    const isName = row !== undefined && x < this.gutter();
    canvas.style.cursor = touch !== null || isName ? "pointer" : "default";
    const word = this.model.knowsTouches ? "touch" : "contact";
    const lines = isName ? linesOfRow(row, word) : touch === null ? [] : linesOfTouch(touch, this.model.timeZero, this.model.knowsTouches);
    const { left, top } = canvas.getBoundingClientRect();
    this.tip.show(lines, left + x, top + y);
  }

  private draw(): void {
    if (this.isAsked) return;
    this.isAsked = true;
    requestAnimationFrame(() => {
      this.isAsked = false;
      this.width = this.canvas.clientWidth;
      this.drawAxis();
      this.drawRows();
      this.movePlayhead();
      if (this.isNew) this.showRow();
      this.isNew = false;
      const words = plural(new Set(this.rows.flatMap((row) => (row.isHeading ? [] : [row.fullName]))).size, this.grouping === "object" ? "object" : "link");
      setText(this.hint, words);
      this.canvas.setAttribute("aria-label", `Timeline: ${words}. The table has them in words.`);
      this.axis.setAttribute("aria-label", "Time axis");
    });
  }

  private drawAxis(): void {
    const context = sized(this.axis, axisHeight);
    if (context === null) return;
    const palette = palettes[this.store.state.theme], zero = this.model.timeZero;
    const relative = { t0: this.window.t0 - zero, t1: this.window.t1 - zero };
    const { times, digits } = ticks(relative, (this.width - this.gutter()) / 80);
    context.font = "11px system-ui, sans-serif";
    context.fillStyle = palette.faint;
    context.textAlign = "center";
    for (const time of times) context.fillText(`${time.toFixed(digits)} s`, this.xOf(time + zero), 12);
    this.drawPoses(context, palette.faint);
  }

  /** A tick a pose, where they can be told apart. */
  private drawPoses(context: CanvasRenderingContext2D, colour: string): void {
    const times = this.model.avatars[this.store.state.contact?.avatar ?? 0]?.track?.poseTimes;
    if (times === undefined) return;
    const first = Math.max(0, lastAtMost(times, this.window.t0)), last = lastAtMost(times, this.window.t1);
    if (last - first > (this.width - this.gutter()) / 5) return;
    context.fillStyle = colour;
    for (let i = first; i <= last; ++i) {
      const x = this.xOf(times[i]);
      if (x >= this.gutter()) context.fillRect(x - 0.5, axisHeight - 7, 1, 7);
    }
  }

  private drawRows(): void {
    const context = sized(this.canvas, Math.max(1, this.rows.length) * rowHeight);
    if (context === null) return;
    const { theme, showsDiscrete, touch } = this.store.state;
    drawLanes(context, palettes[theme], {
      rows: this.rows, window: this.window, width: this.width, gutter: this.gutter(), chosen: touch, showsDiscrete,
      folded: this.folded, xOf: (time) => this.xOf(time),
    });
    this.deviation?.draw({ window: this.window, width: this.width, gutter: this.gutter(), xOf: (time) => this.xOf(time) }, palettes[theme]);
    this.overview.draw({
      touches: this.shownTouches(), whole: this.whole(), window: this.window,
      gutter: this.gutter(), width: this.width - reach,
    }, palettes[theme]);
  }

  private movePlayhead(): void {
    const x = this.xOf(this.store.state.time);
    this.overview.showTime(this.store.state.time);
    this.playhead.hidden = x < this.gutter() - 1 || x > this.width + 1;
    this.playhead.style.transform = `translateX(${(x - 0.75).toFixed(2)}px)`;
  }
}
