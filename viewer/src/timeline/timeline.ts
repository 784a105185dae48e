// The timeline: a row a link, a bar a contact from when it is met to the end of its step. Click
// goes there, drag moves, wheel and pinch zoom.

import type { Contact } from "../contacts/contact.js";
import { verdictNames } from "../contacts/contact.js";
import { lastAtMost } from "../motion/clip.js";
import type { Model } from "../model.js";
import { choose } from "../panels/choosing.js";
import { button, element } from "../panels/dom.js";
import { plural, seconds } from "../panels/words.js";
import { palettes } from "../scene3d/palette.js";
import type { Change, Store } from "../state.js";
import { BarPainter } from "./bars.js";
import { Gestures } from "./gestures.js";
import type { Row, Window } from "./rows.js";
import { moved, nearestContact, rowsOf, ticks, zoomed } from "./rows.js";

const rowHeight = 22, barHeight = 12, axisHeight = 26;
const maxGutter = 132, gutterShare = 0.26;
/** Beside a bar, CSS pixels. */
const reach = 8;
const zoomStep = 0.6;
/** How often the window of a stream moves without new contacts, milliseconds. */
const liveWindowMs = 250;

export class Timeline {
  readonly node = element("section", { class: "timeline", label: "Timeline of contacts" });
  private readonly axis = element("canvas", { class: "axis" });
  private readonly canvas = element("canvas", { class: "bars" });
  private readonly scroll = element("div", { class: "scroll" }, this.canvas);
  /** Over both canvases, which stay as they are while only time goes on. */
  private readonly playhead = element("div", { class: "playhead" });
  private readonly hint = element("p", { class: "hint" });
  private rows: Row[] = [];
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
    this.rows = rowsOf(model.contacts, model.avatars);
    this.node.append(this.makeBar(), element("div", { class: "tracks" }, this.axis, this.scroll, this.playhead));
    for (const canvas of [this.axis, this.canvas]) {
      canvas.setAttribute("role", "img");
      new Gestures(canvas, {
        click: (x, y) => this.click(x, canvas === this.axis ? -1 : y),
        drag: (dx) => this.move(-dx * this.secondsPerPixel()),
        zoom: (factor, x) => this.zoom(factor, this.timeAt(x)),
        hover: (x, y) => this.hover(x, canvas === this.axis ? -1 : y),
      }, canvas === this.axis);
    }
    new ResizeObserver(() => this.draw()).observe(this.node);
  }

  update(changes: ReadonlySet<Change>): void {
    if (changes.has("contacts")) this.rows = rowsOf(this.model.contacts, this.model.avatars);
    const before = this.window;
    if (this.model.isLive) this.followStream(changes.has("contacts"));
    else if (changes.has("time")) this.followTime();
    if (changes.has("contact")) this.showRow();
    const isTimeAlone = changes.size === 1 && changes.has("time") && this.window === before;
    if (isTimeAlone) this.movePlayhead();
    else this.draw();
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
  showRow(): void {
    const { contact } = this.store.state;
    const row = this.rows.findIndex((one) => one.link === contact?.link && one.avatar === contact.avatar);
    const top = row * rowHeight, { scrollTop, clientHeight } = this.scroll;
    const isSeen = top >= scrollTop && top + rowHeight <= scrollTop + clientHeight;
    if (row >= 0 && !isSeen) this.scroll.scrollTop = top - (clientHeight - rowHeight) / 2;
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
    const legend = element("span", { class: "verdicts" });
    for (const verdict of ["contact", "starts_in_contact", "undecided"] as const) {
      const count = this.model.contacts.filter((contact) => contact.verdict === verdict).length;
      if (count === 0 && !this.model.isLive) continue;
      const text = this.model.isLive ? verdictNames[verdict] : `${count} ${verdictNames[verdict]}`;
      legend.append(element("span", { class: `swatch ${verdict}` }), element("span", { text }));
    }
    return element("div", { class: "timeline-bar" }, element("h2", { text: "Contacts over time" }), legend, this.hint,
      element("div", { class: "group" },
        button("−", "Show more time", () => this.zoom(1 / zoomStep, middle())),
        button("+", "Show less time", () => this.zoom(zoomStep, middle())),
        button("Fit", "Show the whole clip", () => this.show(this.whole())),
      ),
    );
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

  private contactAt(x: number, y: number): Contact | null {
    const row = this.rows[Math.floor(y / rowHeight)];
    if (y < 0 || row === undefined || x < this.gutter()) return null;
    return nearestContact(row, this.timeAt(x), reach * this.secondsPerPixel());
  }

  private click(x: number, y: number): void {
    const contact = this.contactAt(x, y);
    if (contact !== null) return choose(this.store, contact);
    const row = this.rows[Math.floor(y / rowHeight)];
    if (y >= 0 && row !== undefined && x < this.gutter()) {
      return this.store.set({ link: { avatar: row.avatar, link: row.link }, contact: null });
    }
    const { start, end } = this.model;
    const time = Math.min(end, Math.max(start, this.timeAt(x)));
    this.store.set({ time, contact: null, isPlaying: false, follows: false });
  }

  private hover(x: number, y: number): void {
    const contact = this.contactAt(x, y);
    this.canvas.style.cursor = contact === null ? "default" : "pointer";
    this.canvas.title = contact === null ? "" : `${contact.linkName}: ${verdictNames[contact.verdict]} at ${seconds(contact.at - this.model.timeZero)}`;
  }

  private draw(): void {
    if (this.isAsked) return;
    this.isAsked = true;
    requestAnimationFrame(() => {
      this.isAsked = false;
      this.width = this.axis.clientWidth;
      this.drawAxis();
      this.drawRows();
      this.movePlayhead();
      if (this.isNew) this.showRow();
      this.isNew = false;
      const words = plural(this.rows.length, "link");
      this.hint.textContent = words;
      this.canvas.setAttribute("aria-label", `Timeline of contacts: ${words}. The table of contacts has them in words.`);
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
    const height = Math.max(1, this.rows.length) * rowHeight;
    const context = sized(this.canvas, height);
    if (context === null) return;
    const { theme, showsDiscrete, contact: chosen } = this.store.state;
    const palette = palettes[theme], painter = new BarPainter(context, palette);
    context.font = "12px system-ui, sans-serif";
    context.textBaseline = "middle";
    this.rows.forEach((row, index) => {
      const y = index * rowHeight;
      context.fillStyle = palette.grid;
      context.globalAlpha = 0.5;
      context.fillRect(0, y + rowHeight - 1, this.width, 1);
      context.globalAlpha = 1;
      this.drawName(context, row, y, row.link === chosen?.link && row.avatar === chosen.avatar ? palette.ink : palette.faint);
      this.drawBars(context, painter, row, y, showsDiscrete, chosen, palette.ink);
    });
    if (this.rows.length === 0) {
      context.fillStyle = palette.faint;
      context.fillText("no contacts", this.gutter(), rowHeight / 2);
    }
  }

  private drawName(context: CanvasRenderingContext2D, row: Row, y: number, colour: string): void {
    context.save();
    context.beginPath();
    context.rect(0, y, this.gutter() - 8, rowHeight);
    context.clip();
    context.fillStyle = colour;
    context.fillText(row.name, 2, y + rowHeight / 2);
    context.restore();
  }

  private drawBars(
    context: CanvasRenderingContext2D, painter: BarPainter, row: Row, y: number,
    showsDiscrete: boolean, chosen: Contact | null, ink: string,
  ): void {
    context.save();
    context.beginPath();
    context.rect(this.gutter() - 1, y, this.width, rowHeight);
    context.clip();
    const top = y + (rowHeight - barHeight) / 2;
    for (const contact of row.contacts) {
      if (contact.span.t1 < this.window.t0 || contact.at > this.window.t1) continue;
      const x0 = this.xOf(contact.at), x1 = this.xOf(contact.span.t1);
      painter.bar(contact, x0, x1, top, barHeight, showsDiscrete && contact.missedByPoses === true);
      if (contact !== chosen) continue;
      context.strokeStyle = ink;
      context.lineWidth = 2;
      context.strokeRect(x0 - 2, top - 3, Math.max(3, x1 - x0) + 4, barHeight + 6);
    }
    context.restore();
  }

  private movePlayhead(): void {
    const x = this.xOf(this.store.state.time);
    this.playhead.hidden = x < this.gutter() - 1 || x > this.width + 1;
    this.playhead.style.transform = `translateX(${(x - 0.75).toFixed(2)}px)`;
  }
}

/** The canvas cleared and as sharp as the screen; null where it cannot be drawn on. */
function sized(canvas: HTMLCanvasElement, height: number): CanvasRenderingContext2D | null {
  const ratio = window.devicePixelRatio, width = canvas.clientWidth;
  canvas.style.height = `${height}px`;
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(height * ratio);
  const context = canvas.getContext("2d");
  context?.scale(ratio, ratio);
  return context;
}
