// The page of a world: what `foretouch world replay --report` writes of the bundled stage.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { coloursOf, pixelsOf } from "./pixels.mjs";
import { run } from "./programs.mjs";
import { documentIn } from "./view_document.mjs";

/** Between where the page has a link and where the library met it, metres: the page has the same motion. */
const closest = 1e-6;

export async function* casesOf(context) {
  const stage = new OpenedStage(context);
  yield ["the stage opens from disk, and draws", () => stage.open()];
  if (stage.visit === null) return;
  yield ["every body is where it was met, also in a hand", () => stage.surfaces()];
  yield ["touches of two bodies name both", () => stage.touches()];
  yield ["a world that nobody asked says so", () => stage.view()];
  yield ["nothing was complained of or asked for", () => stage.visit.end()];
}

class OpenedStage {
  visit = null;

  constructor({ setting, folder, browsing }) {
    Object.assign(this, { setting, folder, browsing });
  }

  async open() {
    const { program, examples, shots } = this.setting, stage = join(examples, "stage.toml");
    this.results = join(this.folder, "stage.jsonl");
    const page = join(this.folder, "stage.html");
    await run(program, ["world", "replay", stage, "-o", this.results, "--report", page]);
    this.document = documentIn(page);
    const visit = await this.browsing.openFile(page);
    const state = await visit.page.evaluate(() => window.foretouch.state());
    assert.equal(state.error, null);
    assert.equal(state.touches, this.document.touches.length);
    const pixels = await pixelsOf(this.setting);
    const colours = coloursOf(await pixels.view(visit.page));
    assert.ok(colours > 60, `only ${colours} colours: nothing is drawn`);
    await pixels.whole(visit.page, join(shots, "stage.png"));
    this.visit = visit;
  }

  /** Witness points of the results lie on the surfaces of the page's links at that instant. */
  async surfaces() {
    const { avatars } = this.document;
    const numberOf = new Map(avatars.map(({ name }, i) => [name, i]));
    const met = readFileSync(this.results, "utf8").trim().split("\n").map((line) => JSON.parse(line))
      .flatMap(({ contacts }) => contacts ?? []).filter(({ verdict }) => verdict === "contact")
      .flatMap(({ a, b, time }) => [a, b].map((side) => ({ ...side, time }))).filter(({ lss }) => lss !== undefined);
    const asked = met.map(({ body, link, lss, point, time }) => {
      const avatar = numberOf.get(body), { links, lss: all } = avatars[avatar];
      const index = link === undefined ? 0 : links.findIndex(({ name }) => name === link);
      return { body, avatar, link: index, lss: all.filter((one) => one.link === index)[lss], point, time };
    });
    const transforms = await this.visit.page.evaluate(
      (sides) => sides.map(({ avatar, link, time }) => window.foretouch.transformAt(avatar, link, time)), asked);
    let worst = 0;
    asked.forEach(({ lss, point }, i) => {
      worst = Math.max(worst, Math.abs(distanceToAxis(transforms[i], lss, point) - lss.radius));
    });
    assert.ok(worst < closest, `${worst} m off`);
    const inHand = asked.filter(({ body, time }) => body === "ball" && time < 5.5).length;
    assert.ok(inHand > 0, "the ball is met in the hand");
    return `${asked.length} places, ${inHand} of them of the ball in the hand; at most ${worst.toExponential(1)} m off`;
  }

  async touches() {
    const { avatars, touches } = this.document;
    const state = await this.visit.page.evaluate(() => window.foretouch.state());
    let ofBodies = 0;
    for (let i = 0; i < state.touches; ++i) {
      const touch = await this.visit.page.evaluate((index) => window.foretouch.touch(index), i);
      if (touch.otherAvatar === null) continue;
      ++ofBodies;
      assert.notEqual(touch.otherAvatar, touch.avatar);
      assert.ok(touch.object.startsWith(avatars[touch.otherAvatar].name), touch.object);
      assert.ok(touch.rows.length > 0);
    }
    assert.equal(ofBodies, touches.filter(({ other_avatar }) => other_avatar !== undefined).length);
    assert.ok(ofBodies >= 20, `${ofBodies}`);
  }

  async view() {
    const page = join(this.folder, "stage-view.html");
    await run(this.setting.program, ["world", "view", join(this.setting.examples, "stage.toml"), "-o", page]);
    const visit = await this.browsing.openFile(page);
    assert.match(await visit.page.textContent("#headline"), /not asked/);
    assert.ok(!(await visit.page.textContent("body")).includes("No contact"), "no contact is no answer here");
    await visit.end();
  }
}

/** Of a world point to an LSS's axis under a transform: rotation row by row, then the origin. */
function distanceToAxis(t, { a, b }, point) {
  const inLink = [0, 1, 2].map((column) => [0, 1, 2].reduce((sum, row) => sum + t[3 * row + column] * (point[row] - t[9 + row]), 0));
  const axis = b.map((value, i) => value - a[i]), from = inLink.map((value, i) => value - a[i]);
  const square = axis.reduce((sum, value) => sum + value * value, 0);
  const share = square === 0 ? 0 : Math.min(1, Math.max(0, axis.reduce((sum, value, i) => sum + value * from[i], 0) / square));
  return Math.hypot(...from.map((value, i) => value - share * axis[i]));
}
