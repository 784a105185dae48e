// One contact of a report held against the line of the results file: the numbers that the page has,
// and what it prints of them.

import assert from "node:assert/strict";
import { expectShown } from "./shown_numbers.mjs";

/** By the names of the results file and of the page. */
const exactFields = [
  ["link", "linkName"], ["object", "object"], ["verdict", "verdict"], ["toi", "toi"], ["time", "time"], ["step", "step"],
  ["separation", "separation"], ["penetration", "penetration"], ["point", "point"], ["on_link", "onLink"], ["normal", "normal"],
  ["triangle", "triangle"], ["free_until", "freeUntil"], ["reason", "reason"],
];
/** Lines of the page's card that show numbers, and of which field. */
const printedFields = {
  "time of impact": "toi", time: "time", separation: "separation", penetration: "penetration", normal: "normal",
  "on the scene": "point", "on the link": "on_link", triangle: "triangle", "free until": "free_until",
};
const verdictWords = { contact: "contact", starts_in_contact: "starts in contact", undecided: "undecided" };

/** Selects every contact, one by one, and reads what the page has, shows and prints. */
export async function readEveryContact(page) {
  return page.evaluate(() => {
    const { foretouch } = window;
    const textOf = (cell) => cell.firstChild?.textContent ?? "";
    const card = document.querySelector(".details");
    return Array.from({ length: foretouch.state().contacts }, (_, i) => {
      foretouch.selectContact(i);
      const lines = [...card.querySelectorAll("tr")].map((row) => [textOf(row.querySelector("th")), textOf(row.querySelector("td"))]);
      return {
        held: foretouch.contact(i),
        selected: foretouch.selected(),
        time: foretouch.state().time,
        who: card.querySelector(".who").textContent,
        lines: Object.fromEntries(lines),
      };
    });
  });
}

export function expectSameContact(shown, result) {
  const { held, lines, who } = shown, name = `${result.link}, step ${result.step}`;
  for (const [theirs, ours] of exactFields) {
    assert.deepEqual(held[ours] ?? null, result[theirs] ?? null, `${name}: ${theirs}`);
  }
  assert.equal(shown.time, held.at, `${name}: the page goes to the contact's time`);
  if (result.time !== undefined) assert.equal(held.at, Math.min(result.time, result.t1), name);
  assert.equal(who, result.object === undefined ? result.link : `${result.link} × ${result.object}`);
  assert.equal(lines.verdict, verdictWords[result.verdict], name);
  for (const [line, field] of Object.entries(printedFields)) expectLine(lines[line], result, field, name);
  const [step, from, to] = /^(\d+): (.*) to (.*)$/.exec(lines.step).slice(1);
  assert.equal(Number(step), result.step);
  expectShown(from, [result.t0], `${name}: begin of the step`);
  expectShown(to, [result.t1], `${name}: end of the step`);
}

function expectLine(text, result, field, name) {
  if (field === "time" && result.time === undefined) return;  // an undecided one has the time until which it is free
  assert.equal(text !== undefined, result[field] !== undefined, `${name}: ${field} is shown where the results have it`);
  if (text !== undefined) expectShown(text, [result[field]].flat(), `${name}: ${field}`);
}
