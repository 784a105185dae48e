// What the 3D view shows right now, in words above it: the story of the contact, who is who, and
// how much a discrete check sees.

import type { Contact } from "../contacts/contact.js";
import { discreteCount } from "../contacts/discrete.js";
import type { Model } from "../model.js";
import type { Store } from "../state.js";
import { element, setText } from "./dom.js";
import { story } from "./words.js";

export class Caption {
  readonly node = element("div", { class: "caption" });
  readonly legend = element("ul", { class: "legend", label: "Colours in the view" });
  private readonly text = element("p", { class: "story" });
  private readonly gap = element("p", {
    class: "story",
    text: "Not answered: no step covers this instant. The avatar holds its last pose.",
  });
  private readonly banner = element("p", { class: "banner" });

  private shownLegend = "";

  constructor(
    private readonly model: Model,
    private readonly store: Store,
  ) {
    this.banner.setAttribute("role", "status");
    this.node.append(this.banner, this.text, this.gap);
    this.update();
  }

  update(): void {
    const { contact, showsDiscrete, time } = this.store.state;
    const clip = this.model.clips[contact?.avatar ?? 0];
    const isAnswered = clip === undefined || clip.start === clip.end || clip.instantAt(time).step >= 0;
    this.gap.hidden = isAnswered || this.model.isLive;
    this.text.hidden = contact === null;
    if (contact !== null) setText(this.text, story(contact, this.model.timeZero));
    const discrete = discreteCount(this.model.contacts);
    this.banner.hidden = !showsDiscrete || discrete === null;
    if (discrete !== null) {
      const all = `A check at the poses alone sees ${discrete.seen} of ${discrete.all} contacts.`;
      setText(this.banner, `${all}${fateOf(contact)}`);
    }
    const entries = this.entries(), key = entries.join();
    if (key === this.shownLegend) return;
    this.shownLegend = key;
    this.legend.replaceChildren(...entries.map(([kind, text]) =>
      element("li", {}, element("span", { class: `key ${kind}` }), element("span", { text })),
    ));
  }

  private entries(): [string, string][] {
    const { state } = this.store;
    const hasGhosts = state.showsGhosts && !state.isPlaying && !state.follows;
    const entries: [string, string][] = [];
    if (this.model.avatars.length > 0) entries.push(["avatar", state.contact !== null && !state.showsDiscrete ? "avatar at the contact" : "avatar"]);
    if (this.model.contacts.length > 0 || this.model.isLive) entries.push(["touching", "link in contact"]);
    if (state.contact !== null && hasGhosts) entries.push(["before", "pose before"], ["asked", "pose asked for"]);
    const isElsewhere = state.contact !== null && (state.showsDiscrete || state.time !== state.contact.at);
    if (hasGhosts && isElsewhere) entries.push(["at-contact", "pose at the contact"]);
    const sweeps = this.model.avatars.some((avatar) => avatar.swept.length > 0);
    if (state.showsSwept && sweeps) entries.push(["swept", "swept volume, certified"]);
    return entries;
  }
}

/** Whether the chosen contact is among those that a check at the poses sees. */
function fateOf(contact: Contact | null): string {
  if (contact === null || contact.missedByPoses === null) return "";
  return contact.missedByPoses ? " It misses the chosen one." : " It sees the chosen one.";
}
