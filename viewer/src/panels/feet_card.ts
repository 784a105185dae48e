// Which foot slides, how deep it is in, and when: a sentence a foot, and the worst first.

import { byBadness, isDeep, isSlide, stands, told } from "../contacts/feet.js";
import type { Touch } from "../contacts/touch.js";
import type { FootStance } from "../data/document.js";
import type { Model } from "../model.js";
import type { Store } from "../state.js";
import { chooseTouch } from "./choosing.js";
import { button, element } from "./dom.js";
import { count, framesOf, millimetres, plural } from "./words.js";

/** In the list; the timeline has all. */
const maxRows = 12;
const least = millimetres(told);
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

  /** As the headline has it: what only passes does not stand. */
  private sentence(stances: readonly Touch[]): string {
    const touches = stances.flatMap(({ stance }) => (stance === null || stance.kind === "hovers" ? [] : [stance]));
    if (touches.length === 0) return "touches nothing";
    const standing = touches.filter(stands), passing = touches.filter((stance) => !stands(stance) && isDeep(stance));
    const worst = (of: readonly FootStance[], one: string, many: string, size: (stance: FootStance) => number): string =>
      `${of.length} ${of.length === 1 ? one : many}, at most ${millimetres(Math.max(...of.map(size)))}`;
    const slides = touches.filter(isSlide), sinks = standing.filter(isDeep), depth = (stance: FootStance): number => stance.depth;
    return [
      plural(touches.length, "touch", "touches"),
      slides.length === 0 ? `none slides ${least}` : worst(slides, "slides", "slide", ({ slide }) => slide),
      sinks.length === 0 ? `none stands ${least} deep` : worst(sinks, "stands too deep", "stand too deep", depth),
      ...(passing.length === 0 ? [] : [worst(passing, "passes too deep", "pass too deep", depth)]),
    ].join("; ");
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
