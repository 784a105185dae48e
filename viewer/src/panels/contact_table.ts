// The contacts as a table: what the timeline and the view show, in words.

import type { Contact } from "../contacts/contact.js";
import { verdictNames } from "../contacts/contact.js";
import type { Model } from "../model.js";
import type { Store } from "../state.js";
import { button, element } from "./dom.js";
import { choose } from "./choosing.js";
import { count, length, seconds } from "./words.js";

const rowsPerPage = 50;
const columns = ["time", "link", "object", "verdict", "separation", "at poses"];

export class ContactTable {
  readonly node = element("details", { class: "card contact-table" });
  private readonly body = element("tbody");
  private readonly place = element("span", { class: "quiet" });
  private page = 0;

  constructor(
    private readonly model: Model,
    private readonly store: Store,
  ) {
    const head = element("tr", {}, ...columns.map((name) => element("th", { text: name })));
    head.querySelectorAll("th").forEach((cell) => (cell.scope = "col"));
    const table = element("table", { class: "rows", label: "All contacts" }, element("thead", {}, head), this.body);
    const pages = element("div", { class: "pages" },
      button("‹", "Earlier contacts", () => this.turn(-1)), this.place, button("›", "Later contacts", () => this.turn(1)),
    );
    this.node.append(element("summary", { text: "Table of contacts" }), element("div", { class: "scroll" }, table), pages);
    this.node.addEventListener("toggle", () => this.update());
  }

  update(): void {
    if (!this.node.open) return;
    const { contacts } = this.model;
    const chosen = this.store.state.contact === null ? -1 : contacts.indexOf(this.store.state.contact);
    if (chosen >= 0) this.page = Math.floor(chosen / rowsPerPage);
    const first = this.page * rowsPerPage, last = Math.min(first + rowsPerPage, contacts.length);
    this.place.textContent = contacts.length === 0 ? "none" : `${count(first + 1)} to ${count(last)} of ${count(contacts.length)}`;
    this.body.replaceChildren(...contacts.slice(first, last).map((contact) => this.row(contact)));
  }

  private turn(pages: number): void {
    const last = Math.floor(Math.max(0, this.model.contacts.length - 1) / rowsPerPage);
    this.page = Math.min(last, Math.max(0, this.page + pages));
    const first = this.page * rowsPerPage;
    this.body.replaceChildren(...this.model.contacts.slice(first, first + rowsPerPage).map((c) => this.row(c)));
    this.place.textContent = `from ${count(first + 1)} of ${count(this.model.contacts.length)}`;
  }

  private row(contact: Contact): HTMLTableRowElement {
    const at = seconds(contact.at - this.model.timeZero);
    const jump = button(at, `Show the contact of ${contact.linkName} at ${at}`, () => choose(this.store, contact), "link");
    const atPoses = contact.missedByPoses === null ? "" : contact.missedByPoses ? "missed" : "seen";
    const texts = [
      contact.linkName, contact.object ?? "", verdictNames[contact.verdict],
      contact.separation === null ? "" : length(contact.separation), atPoses,
    ];
    const row = element("tr", {}, element("td", {}, jump), ...texts.map((text) => element("td", { text })));
    if (contact === this.store.state.contact) row.setAttribute("aria-selected", "true");
    return row;
  }
}
