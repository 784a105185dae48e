// What a person surely and perhaps touched, through foretouch.js: closed forms of a ball and a wall,
// the bounds of a file and of a preset, refusals in words.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { bracketVerdicts, Foretouch, ForetouchError } from "../foretouch.js";

const ft = await Foretouch.load(readFileSync(new URL("../foretouch.wasm", import.meta.url)));
const radius = 0.1, seconds = 0.1;
const ball = ft.avatar([{ name: "LeftHand", parent: null, offset: [0, 0, 0], lss: [{ a: [0, 0, 0], b: [0, 0, 0], radius }] }]);
const wall = ft.scene({ positions: [0, -5, -5, 0, 5, -5, 0, 5, 5, 0, -5, 5], indices: [0, 1, 2, 0, 2, 3] });
const at = (x) => ({ rotations: Float64Array.of(1, 0, 0, 0), translations: Float64Array.of(x, 0.3, 0.1) });
const query = ft.brackets(wall, ball);

test("a touch is bracketed by the grown and the shrunk ball", () => {
  const from = 0.3, to = 0.04, acceleration = 20, error = 0.002, most = (acceleration * seconds ** 2) / 8;
  const first = (sign) => {
    for (let t = 0; t <= 1; t += 1e-5) if (from + t * (to - from) - radius <= sign * (error + 4 * most * t * (1 - t))) return t;
    return 2;
  };
  const [bracket] = query.answer({ from: at(from), to: at(to), seconds }, { acceleration, error });
  assert.equal(bracket.verdict, "certain");
  assert.ok(Math.abs(bracket.possibleFrom - first(1)) < 1e-3, `${bracket.possibleFrom}`);
  assert.ok(Math.abs(bracket.certainFrom - first(-1)) < 1e-3, `${bracket.certainFrom}`);
  assert.ok(Math.abs(bracket.growth - most - error) < 1e-9);
  assert.equal(bracket.object, 0);
});

test("verdicts: unclaimed, excluded, possible, and certain of who passed through", () => {
  const verdict = (from, to, bound) => query.answer({ from: at(from), to: at(to), seconds }, bound)[0].verdict;
  assert.equal(verdict(3, 3, {}), "unclaimed");
  assert.equal(verdict(3, 3, [{ acceleration: 1 }]), "excluded");
  assert.equal(verdict(0.11, 0.11, { acceleration: 20 }), "possible");
  assert.equal(verdict(0.5, -0.5, { acceleration: 200 }), "certain");
  assert.equal(bracketVerdicts.length, 4);
});

test("across a gap the speed counts, and ahead what comes", () => {
  const gap = (speed) => query.answerGap({ from: at(0.5), to: at(0.5), seconds: 1 }, { speed })[0].verdict;
  assert.deepEqual([gap(0.7), gap(0.9)], ["excluded", "possible"]);
  const [soon] = query.lookAhead({ from: at(0.6), to: at(0.5), seconds }, 1, { aheadAcceleration: 4 });
  assert.equal(soon.verdict, "possible");
  // 0.4 m at 1 m/s, and 2 t^2.
  assert.ok(Math.abs(soon.possibleFrom - (Math.sqrt(1 + 8 * 0.4) - 1) / 4) < 2e-3, `${soon.possibleFrom}`);
});

test("bounds come from a file's text, or from a preset", () => {
  const file = JSON.stringify({ format: "foretouch-bounds", version: 1, bounds: [{ part: "hand", model: "cubic", rate_hz: 30, acceleration_m_s2: 12.5 }] });
  const [hand] = ft.bounds(file, ball, { between: "cubic", rateHz: 30 });
  assert.deepEqual([hand.acceleration, hand.error, hand.speed], [12.5, 0, Infinity]);
  const [worker] = ft.bounds("preset:sara-shield", ball, { between: "constant-rate", rateHz: 30 });
  assert.deepEqual([worker.acceleration, worker.speed, worker.aheadSpeed], [100, 2, 0.1]);
  assert.equal(query.answer({ from: at(0.3), to: at(0.04), seconds: 1 / 30 }, [worker])[0].verdict, "certain");
});

test("what cannot be used is refused by name", () => {
  const refused = (call, pattern) => assert.throws(call, (error) => error instanceof ForetouchError && pattern.test(error.message) ? true : assert.fail(String(error)));
  const step = { from: at(1), to: at(1), seconds };
  refused(() => query.answer(step, { acceleration: -1 }), /bounds.*at least 0/);
  refused(() => query.answer(step, [{}, {}]), /bounds.*one per link/);
  refused(() => query.answer(step, { speeed: 1 }), /bounds\[0\].*'speeed'/);
  refused(() => query.answer({ ...step, between: "cubik" }, {}), /between.*constant-rate/);
  refused(() => query.answer({ ...step, seconds: 0 }, {}), /seconds/);
  refused(() => ft.bounds("preset:none", ball, { between: "cubic", rateHz: 30 }), /preset:sara-shield/);
  refused(() => ft.bounds("{}", ball, { between: "cubic", rateHz: 30 }), /foretouch-bounds/);
});
