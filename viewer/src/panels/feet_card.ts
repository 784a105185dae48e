// Which foot slides, how deep it is in, and when: a sentence a foot, and the worst first.

import { byBadness, isDeep, isSlide, told } from "../contacts/feet.js";
import type { Touch } from "../contacts/touch.js";
import type { FootStance } from "../data/document.js";
import type { Model } from "../model.js";
import type { Store } from "../state.js";
import { chooseTouch } from "./choosing.js";
import { button, element } from "./dom.js";
import { count, framesOf, millimetres, plural } from "./words.js";

/** In the list; the timeline has all. */
const maxRows = 12;
const columns = ["frames", "foot", "slides", "deep"];

export class FeetCard {
  readonly node = element("section", { class: "card feet" });
  private readonly body = element("tbody");
  private readonly worst: readonly Touch[];

  /** Null where nobody looked for feet. */
  static of(model: Model, store: Store): FeetCard | null {
    return model.document.feet.length === 0 ? null : new FeetCard(model, store);
  }

  private constructor(
    private readonly model: Model,
    private readonly store: Store,
  ) {
    this.worst = byBadness(model.stances).slice(0, maxRows);
    const head = element("tr", {}, ...columns.map((text) => element("th", { text })));
    head.querySelectorAll("th").forEach((cell) => (cell.scope = "col"));
    const table = element("table", { class: "rows", label: "How feet rest, the worst first" }, element("thead", {}, head), this.body);
    this.node.append(element("h2", { text: "Feet, the worst first" }), ...this.sentences(), element("div", { class: "scroll" }, table));
    const rest = model.stances.length - maxRows;
    const more = rest > 0 ? `${count(rest)} more are on the timeline. ` : "";
    this.node.append(element("p", { class: "quiet", text: `${more}A foot touches from when its heel, ball or toe does until none of them does.` }));
    this.update();
  }

  update(): void {
    this.body.replaceChildren(...this.worst.flatMap((touch) => (touch.stance === null ? [] : [this.row(touch, touch.stance)])));
  }

  private sentences(): HTMLElement[] {
    const { feet, avatars } = this.model.document;
    return feet.map(({ link }) => {
      const of = this.model.stances.filter((touch) => touch.link === link);
      return element("p", { text: `${avatars[0].links[link].name}: ${this.sentence(of)}.` });
    });
  }

  private sentence(stances: readonly Touch[]): string {
    const touches = stances.filter(({ stance }) => stance !== null && stance.kind !== "hovers");
    const slides = touches.filter(({ stance }) => stance !== null && isSlide(stance)).length;
    const sinks = touches.filter(({ stance }) => stance !== null && isDeep(stance)).length;
    if (touches.length === 0) return "touches nothing";
    const most = (of: (stance: FootStance) => number): string => millimetres(touches.reduce((a, { stance }) => (stance === null ? a : Math.max(a, of(stance))), 0));
    const least = millimetres(told);
    const parts = [plural(touches.length, "touch", "touches")];
    parts.push(slides === 0 ? `none slides ${least}` : `${slides} ${slides === 1 ? "slides" : "slide"}, at most ${most(({ slide }) => slide)}`);
    parts.push(sinks === 0 ? `none sinks in ${least}` : `${sinks} ${sinks === 1 ? "sinks" : "sink"} in, at most ${most(({ depth }) => depth)}`);
    return parts.join("; ");
  }

  private row(touch: Touch, stance: FootStance): HTMLTableRowElement {
    const frames = framesOf(this.model, touch);
    const jump = button(frames, `Show ${touch.linkName}, ${frames}`, () => chooseTouch(this.store, this.model, touch), "link");
    const slides = isSlide(stance) ? millimetres(stance.slide) : "", deep = isDeep(stance) ? millimetres(stance.depth) : "";
    const cells = [touch.linkName, ...(stance.kind === "hovers" ? [`hovers, ${millimetres(stance.hover)}`] : [slides, deep])].map((text) => element("td", { text }));
    if (stance.kind === "hovers") cells[1].colSpan = 2;
    const row = element("tr", {}, element("td", {}, jump), ...cells);
    if (touch === this.store.state.touch) row.setAttribute("aria-selected", "true");
    return row;
  }
}
