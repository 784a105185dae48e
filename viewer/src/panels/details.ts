// Everything known about the chosen contact, or about the chosen link.

import { discreteCount } from "../contacts/discrete.js";
import type { Contact } from "../contacts/contact.js";
import { verdictNames } from "../contacts/contact.js";
import type { Model } from "../model.js";
import type { LinkChoice, Store } from "../state.js";
import { definitionTable, element } from "./dom.js";
import { length, seconds, tally, vector } from "./words.js";

type Line = readonly [string, string, string?];

export class Details {
  readonly node = element("section", { class: "card details" });
  private readonly body = element("div");

  constructor(
    private readonly model: Model,
    private readonly store: Store,
  ) {
    this.body.setAttribute("aria-live", "polite");
    this.node.append(element("h2", { text: "Contact" }), this.body);
    this.update();
  }

  update(): void {
    const { contact, link } = this.store.state;
    const title = this.node.querySelector("h2");
    if (title !== null) title.textContent = contact === null && link !== null ? "Link" : "Contact";
    this.body.replaceChildren(...this.content(contact, link));
  }

  private content(contact: Contact | null, link: LinkChoice | null): Node[] {
    if (contact !== null) return this.ofContact(contact);
    if (link !== null) return this.ofLink(link);
    const hint = this.model.contacts.length === 0
      ? "No contact was found."
      : "Choose a contact in the view, on the timeline or in the table.";
    return [element("p", { class: "quiet", text: hint })];
  }

  private ofContact(contact: Contact): Node[] {
    const heading = element("p", { class: "who" },
      element("span", { class: `swatch ${contact.verdict}` }),
      element("strong", { text: contact.linkName }),
      element("span", { text: contact.object === null ? "" : ` × ${contact.object}` }),
    );
    const badge = element("p", { class: "badge", text: "A discrete check misses it" });
    const parts: Node[] = [heading];
    if (contact.missedByPoses === true) parts.push(badge);
    parts.push(definitionTable(this.linesOf(contact)));
    return parts;
  }

  private linesOf(contact: Contact): Line[] {
    const zero = this.model.timeZero;
    const lines: (Line | null)[] = [
      this.model.avatars.length > 1 ? ["avatar", this.model.avatars[contact.avatar].name] : null,
      ["verdict", verdictNames[contact.verdict], contact.reason ?? ""],
      contact.toi === null ? null : ["time of impact", contact.toi.toFixed(4), "0 to 1 within the step"],
      ["time", seconds(contact.at - zero)],
      ["step", `${contact.step}: ${seconds(contact.span.t0 - zero)} to ${seconds(contact.span.t1 - zero)}`],
      contact.freeUntil === null ? null : ["free until", contact.freeUntil.toFixed(4), "0 to 1 within the step"],
      contact.separation === null ? null : ["separation", length(contact.separation), "at the time of impact"],
      contact.penetration === null ? null : ["penetration", length(contact.penetration)],
      contact.normal === null ? null : ["normal", vector(contact.normal, 3), "from the scene to the link"],
      contact.point === null ? null : ["on the scene", `${vector(contact.point)} m`],
      contact.onLink === null ? null : ["on the link", `${vector(contact.onLink)} m`],
      contact.triangle === null || contact.triangle < 0 ? null : ["triangle", String(contact.triangle)],
    ];
    return lines.filter((line): line is Line => line !== null);
  }

  private ofLink({ avatar, link }: LinkChoice): Node[] {
    const one = this.model.avatars[avatar];
    const contacts = this.model.contacts.filter((c) => c.avatar === avatar && c.link === link);
    const discrete = discreteCount(contacts);
    const parent = one.links[link].parent;
    const radii = one.lss.filter((lss) => lss.link === link).map((lss) => length(lss.radius));
    const lines: Line[] = [
      ["avatar", one.name],
      ["moves with", parent < 0 ? "the world" : one.links[parent].name],
      ["LSS", radii.length === 0 ? "none" : `${radii.length}, radius ${radii.slice(0, 4).join(", ")}`],
      ["contacts", tally(contacts)],
    ];
    if (discrete !== null) lines.push(["seen at poses", `${discrete.seen} of ${discrete.all}`]);
    return [element("p", { class: "who" }, element("strong", { text: one.links[link].name })), definitionTable(lines)];
  }
}
