// Everything that the view can draw, by name; what is not drawn right now is grey.

import type { Touch } from "../contacts/touch.js";
import type { Model } from "../model.js";
import type { Store } from "../state.js";
import { element } from "./dom.js";
import { meaningOf } from "./glossary.js";

interface Entry {
  /** Of the style. */
  readonly key: string;
  readonly name: string;
  readonly meaning: string;
  readonly isDrawn: boolean;
}

function isVeiled({ person }: Touch): boolean {
  return person !== null && person.growth !== null;
}

export class Legend {
  readonly node = element("ul", { class: "legend", label: "What is drawn in the view" });
  private shown = "";

  constructor(
    private readonly model: Model,
    private readonly store: Store,
  ) {
    this.update();
  }

  update(): void {
    const entries = this.entries(), key = entries.map(({ name, isDrawn }) => `${name}${isDrawn}`).join();
    if (key === this.shown) return;
    this.shown = key;
    this.node.replaceChildren(...entries.map(({ key, name, meaning, isDrawn }) =>
      element("li", { class: isDrawn ? "" : "off", title: isDrawn ? meaning : `${meaning} (not drawn now)` },
        element("span", { class: `key ${key}` }), element("span", { text: name })),
    ));
  }

  private entries(): Entry[] {
    const { model } = this, { state } = this.store;
    const isInspection = model.document.kind === "inspection";
    if (isInspection) return [...this.bodies(), this.entry("asked", "where a click puts it", "The body at the place to copy.", state.place !== null)];
    const isOfPerson = state.touch !== null && state.touch.person !== null;
    const isStill = !isOfPerson && !state.isPlaying && !state.follows && !state.showsDiscrete;
    const hasStep = state.contact !== null || isStill;
    const hasSwept = model.avatars.some((avatar) => avatar.swept.length > 0);
    const isElsewhere = state.contact !== null && state.time !== state.contact.at;
    return [
      ...this.bodies(),
      this.entry("touching", "link in contact", "A link that touches something at this instant.", true),
      ...(model.isSolid ? [this.entry("tracked", "tracked body", "Where the tracker says that the body is, as far as surfaces keep the shown one from it.", state.showsGhosts)] : []),
      ...(model.isLive || model.isSolid ? [] : [
        this.entry("before", "pose before", meaningOf("pose before"), state.showsGhosts && hasStep && isStill),
        this.entry("asked", "pose asked for", meaningOf("pose asked for"), (state.showsGhosts && hasStep && isStill) || (state.showsDiscrete && !state.isPlaying)),
        this.entry("at-contact", "pose at the contact", "The body where it first touches.", state.showsGhosts && isElsewhere && isStill),
      ]),
      ...(model.bodies.length < model.avatars.length ? [this.entry("trigger", "trigger", meaningOf("trigger"), true)] : []),
      ...(model.personTouches.some(isVeiled) ? [this.entry("veil", "the person's link", "The chosen link, as thick as it is with the person's in it: they are at most that far apart.", isOfPerson && isVeiled(state.touch))] : []),
      ...(hasSwept ? [this.entry("swept", "swept volume", meaningOf("swept volume"), state.showsSwept && state.contact !== null)] : []),
      this.entry("mark contact", "contact", "Where a link first touches in a step; small and pale: at another instant.", true),
      this.entry("mark starts_in_contact", "starts in contact", meaningOf("starts in contact"), true),
      this.entry("normal", "normal", `${meaningOf("normal")}${model.touches.some(({ strength }) => strength !== null) ? " Where a touch begins: the longer, the faster the two approach." : ""}`, true),
    ];
  }

  private bodies(): Entry[] {
    const name = this.model.isSolid ? "shown body" : "body";
    return this.model.avatars.length === 0 ? [] : [this.entry("avatar", name, "The body at the instant that the clock shows.", true)];
  }

  private entry(key: string, name: string, meaning: string, isDrawn: boolean): Entry {
    return { key, name, meaning, isDrawn };
  }
}
