// Inspections: puts the body elsewhere, and gives the option that does.

import type { Model } from "../model.js";
import { placeOption } from "../motion/placing.js";
import type { Store } from "../state.js";
import { button, card, copyFrom, element } from "./dom.js";

export class PlaceCard {
  readonly node: HTMLElement;
  private readonly option = element("code", { class: "option" });
  private readonly found = element("div", { class: "found" });
  private readonly hint = element("p", { class: "quiet" });

  constructor(
    private readonly model: Model,
    private readonly store: Store,
    flyTo: () => void,
  ) {
    const copy = button("Copy", "Copy the option", () => void copyFrom(copy, this.option.textContent ?? ""));
    this.found.append(this.option, copy, button("Clear", "Forget this place", () => store.set({ place: null })));
    this.node = card("Somewhere else?", this.hint, this.found,
      element("div", { class: "group" }, button("Fly to the body", "Look at the body (F)", flyTo)));
    this.update();
  }

  update(): void {
    const { place } = this.store.state, now = placeOption(this.model.place);
    this.found.hidden = place === null;
    if (place !== null) this.option.textContent = placeOption(place);
    this.hint.textContent = place === null
      ? `It stands where ${now} puts it. Click a floor: its feet, as they are at the instant shown, would stand there.`
      : "Click again to turn it that way. Give this option in place of the old one:";
  }
}
