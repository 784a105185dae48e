// Words beside the pointer: what a bar or a name on the timeline stands for.

import type { Touch } from "../contacts/touch.js";
import { element } from "../panels/dom.js";
import { forceOf, length, linesOfPerson, linesOfStance, plural, seconds } from "../panels/words.js";
import type { Row } from "./rows.js";

/** From the pointer, CSS pixels. */
const offset = 14;

export class Tip {
  readonly node = element("div", { class: "tip" });

  constructor() {
    this.node.setAttribute("role", "tooltip");
    this.node.hidden = true;
  }

  /** Beside a place of the window; nothing where there are no lines. */
  show(lines: readonly string[], x: number, y: number): void {
    this.node.hidden = lines.length === 0;
    if (lines.length === 0) return;
    this.node.replaceChildren(...lines.map((text, i) => element(i === 0 ? "strong" : "span", { text })));
    const { offsetWidth, offsetHeight } = this.node;
    const left = Math.min(x + offset, window.innerWidth - offsetWidth - offset);
    const top = Math.max(offset, y - offsetHeight - offset);
    this.node.style.transform = `translate(${Math.max(offset, left)}px, ${top}px)`;
  }

  hide(): void {
    this.show([], 0, 0);
  }
}

export function linesOfTouch(touch: Touch, timeZero: number, knowsTouches: boolean): string[] {
  const from = seconds(touch.begin - timeZero), to = seconds(touch.end - timeZero);
  const lines = [`${touch.linkName}${touch.object === "" ? "" : ` × ${touch.object}`}`];
  if (touch.stance !== null) return [...lines, `${from} to ${to}`, ...linesOfStance(touch.stance)];
  if (touch.person !== null) return [...lines, ...linesOfPerson(touch.person, timeZero)];
  if (touch.isStay) return [...lines, ...linesOfStay(touch, from, to)];
  if (touch.isUndecided && touch.rows.length === 0) return [...lines, `${from} to ${to}: nothing is claimed of the two`];
  if (touch.isUndecided) return [...lines, `free until ${from}; until ${to} not decided`];
  lines.push(`${from} to ${touch.ends === "open" ? `${to}, and still touching` : to}`);
  if (touch.begins === "inside") lines.push(knowsTouches ? "it touched already when somebody first looked" : "the step starts in contact");
  if ((touch.depth ?? 0) > 0) lines.push(`${length(touch.depth ?? 0)} deep`);
  if (touch.isGround) lines.push("stands on the ground");
  if (touch.strength !== null) lines.push(...forceOf(touch.strength));
  if (touch.isMissed === true) lines.push("a check of the poses alone misses it");
  return lines;
}

function linesOfStay(touch: Touch, from: string, to: string): string[] {
  if (touch.isUndecided) return [`${from} to ${to}: it is not known who is in it`];
  const lines = [`inside from ${from} to ${touch.ends === "open" ? `${to}, and still there` : to}`];
  return touch.begins === "inside" ? [...lines, "it was there already when somebody first looked"] : lines;
}

export function linesOfRow(row: Row, word: string): string[] {
  if (row.touches.length === 0) return [row.fullName, "touches nothing"];
  if (row.touches[0].stance !== null) return [row.fullName, "how this foot stands, slides, sinks in and hovers"];
  if (row.touches[0].person !== null) return [row.fullName, "what the person touched: solid where it is certain, light where it is possible"];
  if (row.touches[0].isStay) return [row.fullName, `a trigger: somebody is in it ${plural(row.touches.length, "time")}`];
  const missed = row.touches.filter((touch) => touch.isMissed === true).length;
  return [row.fullName, `${plural(row.touches.length, word, word === "touch" ? "touches" : "contacts")}${missed > 0 ? `, ${missed} missed by a check of the poses` : ""}`];
}
