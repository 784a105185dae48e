// Numbers as the page prints them: "0.3481", "650 µm", "−0.400, 0.005, −0.917".

import assert from "node:assert/strict";

/** In metres and seconds. */
const units = { "": 1, s: 1, ms: 1e-3, "µs": 1e-6, m: 1, mm: 1e-3, "µm": 1e-6 };
const pattern = /^([-−]?)(\d+)(?:\.(\d+))?(?:e([-+]\d+))?$/;

/** The printed values, and half a unit of their last digit: how far off rounding may be. */
export function shownNumbers(text) {
  const [, list, unit] = /^(.*?)(?: ([a-zµ]+))?$/u.exec(text);
  const factor = units[unit ?? ""];
  assert.ok(factor !== undefined, `a unit that nobody knows: ${text}`);
  return list.split(", ").map((word) => shownNumber(word, factor));
}

function shownNumber(word, factor) {
  const parts = pattern.exec(word);
  assert.ok(parts !== null, `not a number: ${word}`);
  const [, sign, whole, fraction = "", exponent = "0"] = parts;
  const scale = factor * 10 ** Number(exponent);
  const value = (sign === "" ? 1 : -1) * Number(`${whole}.${fraction || "0"}`) * scale;
  return { value, slack: 0.5 * 10 ** -fraction.length * scale };
}

/** That a text shows these numbers, to the digits that it prints. */
export function expectShown(text, numbers, what) {
  const shown = shownNumbers(text);
  assert.equal(shown.length, numbers.length, `${what}: ${text}`);
  shown.forEach(({ value, slack }, i) => {
    const isSame = Math.abs(value - numbers[i]) <= slack * (1 + 1e-9) + Number.EPSILON * Math.abs(numbers[i]);
    assert.ok(isSame, `${what}: shown is ${text}, the results have ${numbers}`);
  });
}
