// What a stream touches now: a flash and a line at the moment of a touch, and who touches what.

import type { Touch } from "../contacts/touch.js";
import type { Model } from "../model.js";
import { chooseTouch } from "../panels/choosing.js";
import { button, card, element } from "../panels/dom.js";
import { seconds } from "../panels/words.js";
import type { Store } from "../state.js";

/** How long the line stays, milliseconds. */
const lineMs = 2500;
/** A touch that was seen this shortly ago still counts as now, seconds: steps come one by one. */
const nowS = 0.25;
const listed = 6;

export class TouchesNow {
  readonly node: HTMLElement;
  private readonly bodies = element("ul", { class: "bodies" });
  private readonly latest = element("div", { class: "steps" });
  private readonly flash = element("div", { class: "flash" });
  private readonly line = element("p", { class: "event" });
  private timer = 0;

  constructor(
    private readonly model: Model,
    private readonly store: Store,
    view: HTMLElement,
  ) {
    this.line.hidden = true;
    this.flash.addEventListener("animationend", () => this.flash.classList.remove("now"));
    view.append(this.flash, this.line);
    this.node = card("Bodies", this.bodies, element("h3", { text: "Latest touches" }), this.latest);
    this.showBodies();
  }

  /** At the moment of a touch, before anything is drawn. */
  begun(touches: readonly Touch[]): void {
    const touch = touches[touches.length - 1];
    if (touch === undefined) return;
    this.line.textContent = `${wordsOf(touch)} · ${seconds(touch.begin - this.model.timeZero)}`;
    this.line.hidden = false;
    // A flash under way begins anew.
    this.flash.classList.remove("now");
    void this.flash.offsetWidth;
    this.flash.classList.add("now");
    window.clearTimeout(this.timer);
    this.timer = window.setTimeout(() => (this.line.hidden = true), lineMs);
    for (const one of touches) {
      const words = `${wordsOf(one)} at ${seconds(one.begin - this.model.timeZero)}`;
      this.latest.prepend(button(words, `Show it: ${words}`, () => chooseTouch(this.store, this.model, one), "link"));
    }
    while (this.latest.childElementCount > listed) this.latest.lastElementChild?.remove();
  }

  showBodies(): void {
    const { avatars, clips, touches } = this.model;
    this.bodies.replaceChildren(...avatars.map(({ id, name }, avatar) => {
      const end = clips[avatar].end;
      const now = touches.filter((touch) => touch.avatar === avatar && touch.end >= end - nowS);
      const links = [...new Set(now.filter(({ isUndecided }) => !isUndecided).map(wordsOf))];
      const free = now.length === 0 ? "touches nothing" : "not known to touch anything";
      const words = !clips[avatar].hasPose ? "no pose yet" : links.length === 0 ? free : links.slice(0, 3).join(", ") + (links.length > 3 ? ` and ${links.length - 3} more` : "");
      const item = element("li", {}, element("span", { class: "dot" }), element("strong", { text: avatars.length > 1 ? `${id}: ${name}` : name }), element("span", { class: "quiet", text: words }));
      item.dataset["state"] = links.length > 0 ? "touches" : now.length > 0 ? "undecided" : "free";
      return item;
    }));
  }
}

function wordsOf(touch: Touch): string {
  return touch.object === "" ? touch.linkName : `${touch.linkName} × ${touch.object}`;
}
