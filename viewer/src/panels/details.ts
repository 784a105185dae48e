// Everything known about the chosen contact, or about the chosen link.

import { isSlide } from "../contacts/feet.js";
import { discreteCount } from "../contacts/discrete.js";
import type { Contact } from "../contacts/contact.js";
import { verdictNames } from "../contacts/contact.js";
import type { PersonTouch } from "../data/document.js";
import type { Model } from "../model.js";
import type { LinkChoice, Store } from "../state.js";
import type { Touch } from "../contacts/touch.js";
import { chooseContact } from "./choosing.js";
import { button, definitionTable, element } from "./dom.js";
import { count, framesOf, length, millimetres, plural, seconds, speed, tally, vector, whenOfPerson } from "./words.js";

/** How hard the two meet. */
function linesOfForce({ strength }: Touch): Line[] {
  if (strength === null) return [];
  const { speed: at, lower, upper, effectiveMass, impulse } = strength;
  const lines: Line[] = [];
  if (at !== null) lines.push(["approach", speed(at), lower === null || upper === null ? "" : `where they touch, proven between ${speed(lower)} and ${speed(upper)}`]);
  if (effectiveMass !== null) lines.push(["effective mass", `${effectiveMass.toPrecision(3)} kg`, "that meets the other along the normal"]);
  if (impulse !== null) lines.push(["impulse", `${impulse.toPrecision(3)} N s`, "that would take the approach away"]);
  return lines;
}

/** The first line: what it is, of whom, and with what. */
function who(swatch: string, linkName: string, rest: string): HTMLElement {
  return element("p", { class: "who" }, element("span", { class: `swatch ${swatch}` }), element("strong", { text: linkName }), element("span", { text: rest }));
}

function besides(object: string): string {
  return object === "" ? "" : ` × ${object}`;
}

/** Of one touch, in the list of its contacts. */
const maxRows = 40;

type Line = readonly [string, string, string?];

export class Details {
  readonly node = element("section", { class: "card details" });
  private readonly body = element("div");
  /** Whether what is said of a step is unfolded: it stays so. */
  private isStepOpen = false;

  constructor(
    private readonly model: Model,
    private readonly store: Store,
  ) {
    this.body.setAttribute("aria-live", "polite");
    this.node.append(element("h2", { text: "Contact" }), this.body);
    this.update();
  }

  update(): void {
    const { contact, touch, link } = this.store.state, { knowsTouches } = this.model;
    const title = this.node.querySelector("h2");
    const isLink = contact === null && touch === null && link !== null;
    if (title !== null) title.textContent = isLink ? "Link" : touch !== null && touch.person !== null ? "The person" : knowsTouches ? "Touch" : "Contact";
    this.body.replaceChildren(...this.content(contact, knowsTouches ? touch : null, link));
  }

  private content(contact: Contact | null, touch: Touch | null, link: LinkChoice | null): Node[] {
    if (touch !== null && touch.person !== null) return this.ofPerson(touch, touch.person);
    if (touch !== null) return this.ofTouch(touch, contact);
    if (contact !== null) return this.ofContact(contact);
    if (link !== null) return this.ofLink(link);
    const hint = this.model.touches.length === 0
      ? "No contact was found."
      : `Choose a ${this.model.knowsTouches ? "touch" : "contact"} in the view, on the timeline or in the table.`;
    return [element("p", { class: "quiet", text: hint })];
  }

  private ofTouch(touch: Touch, contact: Contact | null): Node[] {
    const zero = this.model.timeZero;
    const kind = touch.stance !== null && isSlide(touch.stance) ? "slide" : touch.isStay ? "trigger" : touch.isGround ? "ground" : touch.isUndecided ? "undecided" : touch.begins === "inside" ? "starts_in_contact" : "contact";
    const isFoot = touch.stance !== null;
    const parts: Node[] = [who(kind, touch.linkName, isFoot ? " on the ground" : touch.isStay && touch.object !== "" ? ` in ${touch.object}` : besides(touch.object))];
    if (touch.isUndecided) parts.push(element("p", { class: "badge", text: "Nothing is claimed in this time" }));
    if (touch.isMissed === true) parts.push(element("p", { class: "badge", text: "A check of the poses misses it" }));
    parts.push(definitionTable([
      ...this.linesOfBadness(touch),
      ["begins", seconds(touch.begin - zero), touch.begins === "inside" ? `it ${touch.isStay ? "was inside" : "touched"} already when somebody first looked` : ""],
      ["ends", seconds(touch.end - zero), touch.ends === "open" ? (touch.isStay ? "it is still inside" : "it still touches") : `after ${seconds(touch.end - touch.begin)}`],
      ...(touch.isGround && !isFoot ? [["ground", "yes", "it stands on what it touches"] as const] : []),
      ...linesOfForce(touch),
    ]));
    if (touch.rows.length > 0) parts.push(this.rowsOf(touch, contact));
    if (contact !== null) parts.push(this.stepOf(contact));
    return parts;
  }

  /** What is true of the person, whatever they did within the bounds. */
  private ofPerson(touch: Touch, person: PersonTouch): Node[] {
    const [began, ended] = whenOfPerson(person, this.model.timeZero), isCertain = ended !== undefined;
    const { bounds = "", between = "", rateHz = null } = this.model.document.person ?? {};
    const lines: Line[] = [
      isCertain ? ["certain", "surely touched"] : ["possible", "may have touched"],
      [isCertain ? "began" : "when", began, person.beganBefore ? "the clip begins in it" : ""],
      ...(isCertain ? [["ended", ended, person.goesOn ? "the clip ends in it" : ""] as const] : []),
      ...this.linesOfBadness(touch),
      ...(person.growth === null ? [] : [["apart", length(person.growth), "at most: the person, and the model that is shown"] as const]),
      ["bounds", bounds, rateHz === null ? between : `${between}, ${Number(rateHz.toFixed(2))} poses a second`],
    ];
    return [who(isCertain ? "person" : "perhaps", touch.linkName, besides(touch.object)), definitionTable(lines)];
  }

  /** What a person looks for first: how deep, how far it slides, which frames. */
  private linesOfBadness(touch: Touch): Line[] {
    const { stance, depth } = touch, frame = this.model.frameAt(touch.begin);
    const lines: Line[] = [];
    if (stance !== null && stance.kind === "hovers") lines.push(["above", millimetres(stance.hover), "the ground, on the average"]);
    else if (stance !== null) {
      const at = this.model.frameAt(stance.depthAt);
      lines.push(["slides", millimetres(stance.slide), `its ${stance.slides}`]);
      lines.push(["deep", millimetres(stance.depth), stance.depth > 0 && at !== null ? `its ${stance.deepest}, at frame ${at}` : ""]);
    } else if (depth !== null && depth > 0) lines.push(["deep", length(depth), touch.rows.length > 1 ? "at most, at a pose" : "at a pose"]);
    if (frame !== null) lines.push(["frames", framesOf(this.model, touch), "of the clip, from 0; the nearest"]);
    return lines;
  }

  /** What the engine says of one step: below, for who looks closer. */
  private stepOf(contact: Contact): HTMLElement {
    const fold = element("details", {}, element("summary", { text: `The contact in step ${count(contact.step)}` }), definitionTable(this.linesOf(contact)));
    fold.open = this.isStepOpen;
    fold.addEventListener("toggle", () => (this.isStepOpen = fold.open));
    return fold;
  }

  /** The contacts of a touch, step by step. */
  private rowsOf(touch: Touch, chosen: Contact | null): HTMLElement {
    const zero = this.model.timeZero;
    const fold = element("details", {}, element("summary", { text: `Step by step: ${plural(touch.rows.length, "contact")}` }));
    const list = element("div", { class: "steps" }, ...touch.rows.slice(0, maxRows).map((row) => {
      const at = seconds(row.at - zero);
      const jump = button(at, `Show step ${row.step}: ${verdictNames[row.verdict]} at ${at}`, () => chooseContact(this.store, this.model, row), "link");
      if (row === chosen) jump.setAttribute("aria-current", "true");
      return jump;
    }));
    if (touch.rows.length > maxRows) list.append(element("span", { class: "quiet", text: `and ${count(touch.rows.length - maxRows)} more` }));
    fold.append(list);
    return fold;
  }

  private ofContact(contact: Contact): Node[] {
    const heading = who(contact.verdict, contact.linkName, besides(contact.object ?? ""));
    const badge = element("p", { class: "badge", text: "A check of the poses misses it" });
    const parts: Node[] = [heading];
    if (contact.missedByPoses === true) parts.push(badge);
    parts.push(definitionTable(this.linesOf(contact)));
    return parts;
  }

  private linesOf(contact: Contact): Line[] {
    const zero = this.model.timeZero, other = contact.otherAvatar === null ? "scene" : "other body";
    const lines: (Line | null)[] = [
      this.model.avatars.length > 1 ? ["avatar", this.model.avatars[contact.avatar].name] : null,
      ["verdict", verdictNames[contact.verdict], contact.reason ?? ""],
      contact.toi === null ? null : ["time of impact", contact.toi.toFixed(4), "0 to 1 within the step"],
      ["time", seconds(contact.at - zero)],
      ["step", `${contact.step}: ${seconds(contact.span.t0 - zero)} to ${seconds(contact.span.t1 - zero)}`],
      contact.freeUntil === null ? null : ["free until", contact.freeUntil.toFixed(4), "0 to 1 within the step"],
      contact.separation === null ? null : ["separation", length(contact.separation), "at the time of impact"],
      contact.penetration === null ? null : ["penetration", length(contact.penetration)],
      contact.push === null ? null : ["push", length(contact.push), "how hard the tracked pose presses; times a stiffness it is a force"],
      contact.slip === null ? null : ["slips by", `${length(contact.slip)} a second`, "along the surface"],
      contact.normal === null ? null : ["normal", vector(contact.normal, 3), `from the ${other} to the link`],
      contact.point === null ? null : [`on the ${other}`, `${vector(contact.point)} m`],
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
    if (this.model.knowsTouches) {
      const touches = this.model.touches.filter((touch) => touch.avatar === avatar && touch.link === link);
      lines.push(["touches", count(touches.length)]);
    }
    if (discrete !== null) lines.push(["seen at poses", `${discrete.seen} of ${discrete.all}`]);
    return [element("p", { class: "who" }, element("strong", { text: one.links[link].name })), definitionTable(lines)];
  }
}
