// The touches as a table: what the timeline and the view show, in words, and as a file.

import type { Touch } from "../contacts/touch.js";
import { whose } from "../contacts/touch.js";
import type { Model } from "../model.js";
import type { Store } from "../state.js";
import { chooseTouch } from "./choosing.js";
import { csvOf, type Cells } from "./csv.js";
import { button, element, explained, offerFile } from "./dom.js";
import { count, framesOf, length, seconds, speed } from "./words.js";

const rowsPerPage = 50;
const columns = ["begin", "frames", "lasts", "link", "object", "deep", "begins", "at poses"], forceColumns = ["approach", "impulse"];

export class TouchTable {
  readonly node = element("details", { class: "card touch-table" });
  private readonly body = element("tbody");
  private readonly place = element("span", { class: "quiet" });
  private readonly hasForces: boolean;
  private page = 0;

  constructor(
    private readonly model: Model,
    private readonly store: Store,
  ) {
    const word = model.knowsTouches ? "touches" : "contacts";
    this.hasForces = model.touches.some(({ strength }) => strength !== null);
    const head = element("tr", {}, ...[...columns, ...(this.hasForces ? forceColumns : [])].map((name) => element("th", {}, explained(name))));
    head.querySelectorAll("th").forEach((cell) => (cell.scope = "col"));
    const table = element("table", { class: "rows", label: `All ${word}` }, element("thead", {}, head), this.body);
    const pages = element("div", { class: "pages" },
      button("‹", `Earlier ${word}`, () => this.turn(-1)), this.place, button("›", `Later ${word}`, () => this.turn(1)),
      button("CSV", "Save the table as a file", () => this.save()),
    );
    this.node.append(element("summary", { text: `Table of ${word}` }), element("div", { class: "scroll" }, table), pages);
    this.node.addEventListener("toggle", () => this.update());
  }

  update(): void {
    if (!this.node.open) return;
    const { touch } = this.store.state;
    const chosen = touch === null ? -1 : this.touches().indexOf(touch);
    if (chosen >= 0) this.page = Math.floor(chosen / rowsPerPage);
    this.fill();
  }

  private touches(): readonly Touch[] {
    return this.model.shownTouches(this.store.state.search, this.store.state.showsGround).filter((touch) => whose(touch) === "link");
  }

  private turn(pages: number): void {
    this.page += pages;
    this.fill();
  }

  private fill(): void {
    const touches = this.touches();
    this.page = Math.max(0, Math.min(Math.floor(Math.max(0, touches.length - 1) / rowsPerPage), this.page));
    const first = this.page * rowsPerPage, last = Math.min(first + rowsPerPage, touches.length);
    this.place.textContent = touches.length === 0 ? "none" : `${count(first + 1)} to ${count(last)} of ${count(touches.length)}`;
    this.body.replaceChildren(...touches.slice(first, last).map((touch) => this.row(touch)));
  }

  private row(touch: Touch): HTMLTableRowElement {
    const at = seconds(touch.begin - this.model.timeZero);
    const jump = button(at, `Show the ${this.model.knowsTouches ? "touch" : "contact"} of ${touch.linkName} at ${at}`, () => chooseTouch(this.store, this.model, touch), "link");
    const row = element("tr", {}, element("td", {}, jump), ...this.texts(touch).map((text) => element("td", { text })));
    if (touch === this.store.state.touch) row.setAttribute("aria-selected", "true");
    return row;
  }

  private texts(touch: Touch): string[] {
    const lasts = `${seconds(touch.end - touch.begin)}${touch.ends === "open" ? " +" : ""}`;
    const begins = touch.isUndecided ? "undecided" : touch.isStay ? (touch.begins === "inside" ? "inside the trigger" : "enters the trigger") : touch.begins === "inside" ? "inside" : "contact";
    const atPoses = touch.isMissed === null ? "" : touch.isMissed ? "missed" : "seen";
    const deep = touch.depth === null || touch.depth === 0 ? "" : length(touch.depth), frames = this.model.frameAt(touch.begin) === null ? "" : framesOf(this.model, touch);
    return [frames, lasts, touch.linkName, touch.object, deep, touch.isGround ? `${begins}, ground` : begins, atPoses, ...(this.hasForces ? forcesOf(touch) : [])];
  }

  /** In seconds and metres, with a dot, in full. */
  private save(): void {
    const zero = this.model.timeZero;
    const head = ["begin_s", "end_s", "avatar", "link", "object", "begins", "ends", "ground", "missed", "separation_m", "depth_m", "from_frame", "to_frame", "x_m", "y_m", "z_m", "trigger", "approach_m_s", "effective_mass_kg", "impulse_N_s"];
    const lines = this.touches().map((touch): Cells => {
      const row = touch.rows[0], point = row?.point ?? [null, null, null];
      return [
        touch.begin - zero, touch.end - zero, this.model.avatars[touch.avatar].name, touch.linkName, touch.object,
        touch.isUndecided ? "undecided" : touch.begins, touch.ends, touch.isGround, touch.isMissed, row?.separation ?? null, touch.depth, this.model.frameAt(touch.begin), this.model.frameAt(touch.end), ...point,
        touch.isStay, touch.strength?.speed ?? null, touch.strength?.effectiveMass ?? null, touch.strength?.impulse ?? null,
      ];
    });
    offerFile(`${this.model.document.title}.csv`, new Blob([csvOf([head, ...lines])], { type: "text/csv" }));
  }
}

function forcesOf({ strength }: Touch): string[] {
  if (strength === null) return ["", ""];
  return [strength.speed === null ? "" : speed(strength.speed), strength.impulse === null ? "" : `${strength.impulse.toPrecision(3)} N s`];
}
