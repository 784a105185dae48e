// The page of a world: what `foretouch world replay --report` writes of the bundled stage.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { coloursOf, countAround, isTriggerColour, pixelsOf } from "./pixels.mjs";
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
  yield ["bars begin and end where the events say, as hard as they say", () => stage.bars()];
  yield ["who is in a trigger is told, and its outline drawn", () => stage.triggers()];
  yield ["a narrow page has room for all of it", () => stage.narrow()];
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
    this.page = page;
    this.events = join(this.folder, "stage-events.jsonl");
    await run(program, ["world", "replay", stage, "-o", this.results, "--events", this.events, "--report", page]);
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
    const met = linesOf(this.results)
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

  /** Each interval of the events file is a bar, to the last digit. */
  async bars() {
    const lines = linesOf(this.events), intervals = lines.flatMap(({ interval }) => interval ?? []);
    const begun = new Map(lines.filter(({ event, trigger }) => trigger === undefined && (event === "enter" || event === "starts_inside"))
      .map((event) => [`${namesOf(event)} ${event.utime} ${event.fraction}`, event]));
    const shown = await this.visit.page.evaluate(() =>
      Array.from({ length: window.foretouch.state().touches }, (_, i) => window.foretouch.touch(i)));
    const keyOf = (begin, end) => `${begin} ${end}`;
    const told = intervals.map(({ from, to }) => keyOf(from.time, to.time)).sort();
    assert.deepEqual(shown.map(({ begin, end }) => keyOf(begin, end)).sort(), told);
    const strengths = intervals.map((one) => {
      const { approach, effective_mass } = begun.get(`${namesOf(one)} ${one.from.utime} ${one.from.fraction}`);
      return `${one.from.time} ${approach.speed} ${approach.lower} ${approach.upper} ${effective_mass}`;
    });
    assert.deepEqual(shown.map(({ begin, strength }) =>
      `${begin} ${strength.speed} ${strength.lower} ${strength.upper} ${strength.effectiveMass}`).sort(), strengths.sort());
    const hardest = shown.reduce((most, one, i) => (one.strength.impulse > shown[most].strength.impulse ? i : most), 0);
    await this.visit.page.evaluate((i) => window.foretouch.selectTouch(i), hardest);
    const { speed, impulse } = shown[hardest].strength, words = await this.visit.page.textContent(".details");
    assert.ok(words.includes(`${impulse.toPrecision(3)} N s`) && words.includes(`${speed.toPrecision(3)} m/s`), words);
    return `${intervals.length} intervals; the hardest takes ${impulse.toPrecision(3)} N s`;
  }

  async triggers() {
    const { page } = this.visit, stays = linesOf(this.events).flatMap(({ stay }) => stay ?? []);
    assert.ok(stays.length >= 10, `${stays.length}`);
    const { avatars } = this.document;
    const keyOf = (trigger, who, begin, end) => `${trigger}: ${who} ${begin} ${end}`;
    assert.deepEqual(
      this.document.stays.map(({ trigger, avatar, begin, end }) => keyOf(avatars[trigger].name, avatars[avatar].name, begin, end)),
      stays.map(({ trigger, who, from, to }) => keyOf(trigger, who.body, from.time, to.time)));
    await page.fill("input[type=search]", "doorway");
    await page.evaluate(() => (document.querySelector(".touch-table").open = true));
    await page.waitForFunction(() => document.querySelector(".touch-table tbody").textContent.includes("the trigger"));
    await page.fill("input[type=search]", "");
    const pixels = await pixelsOf(this.setting), image = await pixels.view(page);
    const corners = [[-0.4, 2.1, -0.8], [0.6, 2.1, -0.8], [-0.4, 2.1, -0.4], [0.6, 2.1, -0.4], [0.6, 1, -0.8], [0.6, 1, -0.4], [-0.4, 1, -0.8], [-0.4, 1, -0.4]];
    const places = await page.evaluate((points) => points.map((point) => window.foretouch.screenOf(point)), corners);
    const isInside = (place) => place !== null && place[0] > 3 && place[1] > 3 && place[0] < image.width - 3 && place[1] < image.height - 3;
    const seen = places.filter(isInside), drawn = seen.filter((place) => countAround(image, place, 3, isTriggerColour) > 0);
    assert.ok(seen.length >= 2, `${seen.length} points of the doorway's edges are in sight`);
    assert.ok(drawn.length >= seen.length / 2, `${drawn.length} of ${seen.length} are drawn`);
    return `${stays.length} stays; ${drawn.length} of ${seen.length} points of an outline drawn`;
  }

  async narrow() {
    const { page } = this.visit, size = page.viewportSize();
    await page.setViewportSize({ width: 420, height: 900 });
    const pixels = await pixelsOf(this.setting);
    await pixels.whole(page, join(this.setting.shots, "stage-narrow.png"));
    const [wide, inner] = await page.evaluate(() => [document.documentElement.scrollWidth, window.innerWidth]);
    assert.ok(wide <= inner, `${wide} pixels in a page of ${inner}`);
    await page.setViewportSize(size);
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

function linesOf(path) {
  return readFileSync(path, "utf8").trim().split("\n").map((line) => JSON.parse(line));
}

/** Which two it is about. */
function namesOf({ a, b }) {
  return [a, b].map(({ body, link, object }) => `${body ?? ""} ${link ?? ""} ${body === undefined ? object : ""}`).join(", ");
}

/** Of a world point to an LSS's axis under a transform: rotation row by row, then the origin. */
function distanceToAxis(t, { a, b }, point) {
  const inLink = [0, 1, 2].map((column) => [0, 1, 2].reduce((sum, row) => sum + t[3 * row + column] * (point[row] - t[9 + row]), 0));
  const axis = b.map((value, i) => value - a[i]), from = inLink.map((value, i) => value - a[i]);
  const square = axis.reduce((sum, value) => sum + value * value, 0);
  const share = square === 0 ? 0 : Math.min(1, Math.max(0, axis.reduce((sum, value, i) => sum + value * from[i], 0) / square));
  return Math.hypot(...from.map((value, i) => value - share * axis[i]));
}
