// The page that one reaches into, from disk: the native program's answers, a hand that stays before a
// thin board, files of one's own, hands of WebXR (emulated by iwer), and what it says where something
// is missing.

import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { Browsing, noWebGL, patience, ready, settled } from "./browsing.mjs";
import { coloursOf, countAround, isAvatarColour, isContactColour, pixelsOf } from "./pixels.mjs";
import { resultsIn, run } from "./programs.mjs";
import { Skipped } from "./setting.mjs";

/** Of the page's own board of 4 mm, which faces x: its front, seen from where the hand begins. */
const boardX = -0.698, boardBack = -0.702;

export async function* casesOf(context) {
  const page = new OpenedPage(context);
  yield ["opens from disk, and draws", () => page.open()];
  if (page.visit === null) return;
  yield ["a hand that is dragged through a board of 4 mm stays before it", () => page.reach()];
  yield ["between two poses it says what is met first, and shows why the rest is clear", () => page.step()];
  yield ["files of one's own: the native program's contacts", () => page.files()];
  yield ["what it cannot use it refuses in words, and goes on", () => page.refusals()];
  yield ["a dancer stands in the room, on a phone and on a tablet", () => page.sizes()];
  yield ["nothing was complained of or asked for", () => page.visit.end()];
  yield ["tracked hands of WebXR are solid", () => page.webxr()];
  yield ["without WebGL the words are there", () => page.withoutWebGL()];
}

class OpenedPage {
  visit = null;

  constructor({ setting, folder, browsing }) {
    Object.assign(this, { setting, folder, browsing });
  }

  async open() {
    if (!existsSync(this.setting.page)) throw new Skipped(`there is no ${this.setting.page} (./run page builds it)`);
    const visit = await this.browsing.openFile(this.setting.page);
    assert.equal(await error(visit.page), null);
    this.pixels = await pixelsOf(this.setting);
    const image = await this.pixels.view(visit.page);
    assert.ok(coloursOf(image) > 40, "nothing is drawn");
    const at = await placeOnCanvas(visit.page, 0);
    assert.ok(countAround(image, at, 25, isAvatarColour) > 100, "the hand is not where it says");
    assert.equal(await visit.page.isHidden("#enter"), true, "a button for VR where there is none");
    await this.pixels.whole(visit.page, join(this.setting.shots, "page.png"));
    this.visit = visit;
  }

  /** With a real pointer; the camera looks along -z, so that a drag to the left leads through the board. */
  async reach() {
    const { page } = this.visit;
    const [x, y] = await placeOnPage(page, 0);
    await page.mouse.move(x, y);
    await page.mouse.down();
    for (let i = 1; i <= 12; ++i) await page.mouse.move(x - 40 * i, y, { steps: 2 });
    const led = await page.evaluate(() => window.foretouch.pose().tracked.translations[0]);
    assert.ok(led < boardBack, `the pointer led it to ${led}`);
    await settled(page);
    const { tick } = await page.evaluate(() => window.foretouch.said());
    assert.equal(tick.isCertified, true);
    assert.ok(["held", "sliding", "around"].includes(tick.state), tick.state);
    const places = await page.evaluate(() => window.foretouch.links().map((_, link) => window.foretouch.linkPlace(link)[0]));
    assert.ok(Math.min(...places) > boardX, `a link is at ${Math.min(...places)}`);
    const image = await this.pixels.whole(page, join(this.setting.shots, "page-reach.png"));
    assert.ok(countIn(image, isContactColour) > 50, "no contact is drawn");
    await page.mouse.up();
    assert.match(await page.textContent("#headline"), /surface keeps it|proven way around/);
    await page.click("text=Again");
    await settled(page);
    return `${tick.state}, ${Math.round(1e3 * tick.deviation)} mm from where it is led`;
  }

  async step() {
    const { page } = this.visit;
    await page.click("button:text-is('Step')");
    await this.#lead(page, [-1.1, 1.15, -0.4]);
    let said = await page.evaluate(() => window.foretouch.said());
    const first = said.contacts.filter(({ verdict }) => verdict === "contact").sort((a, b) => a.toi - b.toi)[0];
    assert.ok(first !== undefined, "nothing is met");
    assert.ok(first.toi > 0 && first.toi < 1);
    assert.ok(Math.abs(first.pointScene[0] - boardX) < 1e-6, `met at ${first.pointScene}`);
    assert.match(await headline(page), /meets board of 4 mm at t = 0\.\d+/);
    await page.evaluate((t) => window.foretouch.seek(t), first.toi);
    const image = await this.pixels.whole(page, join(this.setting.shots, "page-step.png"));
    assert.ok(countIn(image, isContactColour) > 50, "no contact is drawn");
    // Beside the board: clear, and planes that show why.
    await this.#lead(page, [-0.25, 1.1, -0.3]);
    await page.evaluate(() => window.foretouch.seek(0.5));
    said = await page.evaluate(() => window.foretouch.said());
    assert.deepEqual(said.contacts, []);
    assert.match(await headline(page), /touches nothing: proven/);
    await this.#lead(page, [0.55, 0.83, -0.85]);
    await page.evaluate(() => window.foretouch.seek(0.98));
    said = await page.evaluate(() => window.foretouch.said());
    for (const { normal } of said.planes) assert.ok(Math.abs(Math.hypot(...normal) - 1) < 1e-9);
    await this.pixels.whole(page, join(this.setting.shots, "page-planes.png"));
    return `first contact at t = ${first.toi.toFixed(4)}; ${said.planes.length} planes at a clear pose above the table`;
  }

  /** The bundled hand on the bundled desk, frame by frame. */
  async files() {
    const { page } = this.visit, { program, examples } = this.setting;
    const output = join(this.folder, "page.jsonl"), at = (name) => join(examples, name);
    await run(program, ["avatar", "bvh", at("hand.bvh"), "--output", join(this.folder, "page.avatar.json")]);
    await run(program, ["replay", "--scene", at("desk.obj"), "--avatar", join(this.folder, "page.avatar.json"), "--motion", at("hand.bvh"), "--output", output]);
    const { contacts } = resultsIn(output);
    await page.setInputFiles("#file", [at("desk.obj"), at("hand.bvh")]);
    await page.waitForFunction(() => window.foretouch.links().includes("ForeArm"), null, { timeout: patience });
    await settled(page);
    assert.equal(await error(page), null);
    const links = await page.evaluate(() => window.foretouch.links());
    let compared = 0;
    for (let step = 0; step < 276; step += 5) {
      const ours = await page.evaluate(async (frame) => {
        await window.foretouch.seekFrame(frame);
        return window.foretouch.said().contacts;
      }, step);
      const theirs = contacts.filter((one) => one.step === step);
      assert.deepEqual(new Set(ours.map(({ link }) => links[link])), new Set(theirs.map(({ link }) => link)), `step ${step}`);
      for (const their of theirs) {
        const our = ours.find(({ link }) => links[link] === their.link);
        assert.equal(our.verdict, their.verdict);
        assert.ok(Math.abs(our.toi - their.toi) < 0.02, `step ${step}: ${our.toi} beside ${their.toi}`);
        ++compared;
      }
    }
    assert.ok(compared > 20, `${compared} contacts`);
    await this.pixels.whole(page, join(this.setting.shots, "page-files.png"));
    return `${compared} contacts of 56 steps`;
  }

  async refusals() {
    const { page } = this.visit;
    const refused = async (name, make, words) => {
      const said = await page.evaluate(async ([name, size, text]) => {
        await window.foretouch.take([new File([size > 0 ? new Uint8Array(size) : text], name)]);
        return window.foretouch.state().error;
      }, [name, make.size ?? 0, make.text ?? ""]);
      assert.match(said ?? "", words);
      // Shown, too.
      await page.waitForFunction((text) => document.querySelector(".play-refusal")?.textContent === text, said, { timeout: patience });
    };
    await refused("huge.glb", { size: 101e6 }, /huge\.glb: expected at most 100 MB, found 101/);
    await refused("corrupt.glb", { text: "glTF but not really" }, /corrupt\.glb: expected glTF/);
    await refused("empty.obj", { text: "v 0 0 0\n" }, /empty\.obj: expected triangles/);
    await refused("far.obj", { text: "v 1e9 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n" }, /1e\+?0?7/);
    await refused("clip.bvh", { text: "HIERARCHY\nROOT\n" }, /clip:\d/);
    await refused("avatar.json", { text: "{}" }, /avatar/);
    await refused("movie.mp4", { text: "x" }, /expected a scene/);
    // And goes on.
    await page.click("text=Hand");
    await page.waitForFunction(() => window.foretouch.links().includes("Wrist"), null, { timeout: patience });
    assert.equal(await error(page), null);
  }

  async sizes() {
    for (const [name, width, height] of [["phone", 390, 844], ["tablet", 820, 1180]]) {
      const visit = await this.browsing.openFile(this.setting.page, { width, height, theme: "dark" });
      await visit.page.click("text=Dancer");
      await visit.page.waitForFunction(() => window.foretouch.links().includes("Hips"), null, { timeout: patience });
      const image = await this.pixels.whole(visit.page, join(this.setting.shots, `page-${name}.png`));
      assert.ok(countIn(image, isAvatarColour) > 300, "no dancer is drawn");
      const { scrollWidth, view } = await visit.page.evaluate(() => ({ scrollWidth: document.documentElement.scrollWidth, view: document.getElementById("view").clientHeight }));
      assert.ok(scrollWidth <= width, `${scrollWidth} pixels wide`);
      assert.ok(view > 200, `the view is ${view} pixels high`);
      await visit.end();
    }
  }

  async webxr() {
    const iwer = join(this.setting.viewer, "node_modules/iwer/build/iwer.min.js");
    if (!existsSync(iwer)) throw new Skipped(`iwer is not in ${this.setting.viewer}/node_modules (npm ci there)`);
    const context = await this.browsing.browser.newContext({ viewport: { width: 1000, height: 700 } }), page = await context.newPage();
    page.setDefaultTimeout(patience);
    const complaints = [];
    page.on("pageerror", (error) => complaints.push(error.message));
    await page.addInitScript(readFileSync(iwer, "utf8"));
    await page.addInitScript(() => {
      const device = new IWER.XRDevice(IWER.metaQuest3);
      device.installRuntime({ polyfillLayers: false, forceInstall: true });
      device.primaryInputMode = "hand";
      window.headset = device;
    });
    await page.goto(`file://${this.setting.page}`);
    await ready(page);
    await page.waitForSelector("#enter:not([hidden])");
    await page.evaluate(() => {
      window.headset.position.set(0, 1.6, 0.3);
      window.headset.hands.left.position.set(-0.45, 1.2, -0.45);
      window.headset.hands.right.position.set(0.1, 1.2, -0.3);
    });
    await page.click("#enter");
    await page.waitForFunction(() => window.foretouch.reached()?.ticks[0] !== null && window.foretouch.reached()?.ticks[1] !== null);
    // The left hand jumps half a metre, through the board; the right one stays free.
    const begun = await page.evaluate(() => {
      window.headset.hands.left.position.set(-1.0, 1.2, -0.45);
      return window.foretouch.reached().frames;
    });
    await page.waitForFunction(() => window.foretouch.reached().ticks[0].deviation > 0.05);
    await page.waitForFunction((begun) => window.foretouch.reached().frames > begun + 100, begun);
    const way = await page.evaluate(() => {
      const { ways, ticks, frames, areCertified } = window.foretouch.reached();
      return { places: ways[0], areCertified, frames, state: ticks[0].state, right: ticks[1].state, numbers: ticks[1].shown.translations.length };
    });
    await page.screenshot({ path: join(this.setting.shots, "page-vr.png") });
    assert.equal(way.areCertified, true);
    assert.ok(way.places.length > 3, `${way.places.length} pieces`);
    assert.equal(way.right, "equal");
    assert.equal(way.numbers, 75);
    // The wrist comes to the other side of the board beside it, or not at all.
    for (let i = 1; i < way.places.length; ++i) {
      const [[x0, y0, z0], [x1, y1, z1]] = [way.places[i - 1], way.places[i]], u = (boardX - x0) / (x1 - x0);
      if (!(u >= 0 && u <= 1)) continue;
      const y = y0 + u * (y1 - y0), z = z0 + u * (z1 - z0);
      assert.ok(y < 0.8 || y > 1.5 || z < -0.95 || z > -0.05, `through the board at y ${y}, z ${z}`);
    }
    const room = await this.#handsInTheRoom(page);
    assert.deepEqual(complaints, []);
    await context.close();
    return `${way.frames} frames, ${way.places.length} pieces; in the end ${way.state}; in the bundled room ${room}`;
  }

  /** Both hands wander through 105,914 triangles; what the library's part of a frame takes is told, not judged. */
  async #handsInTheRoom(page) {
    await page.setInputFiles("#file", join(this.setting.examples, "room.obj"));
    await page.waitForFunction(() => document.getElementById("panels").textContent.includes("105,914"), null, { timeout: patience });
    const begun = await page.evaluate(() => window.foretouch.reached().microseconds.length);
    const { count, times, areCertified } = await page.evaluate((begun) => new Promise((done) => {
      const move = () => {
        const { microseconds, areCertified } = window.foretouch.reached(), angle = (microseconds.length - begun) / 15;
        window.headset.hands.left.position.set(-0.6 + 0.4 * Math.cos(angle), 1.25 + 0.15 * Math.sin(2 * angle), 0.4 * Math.sin(angle));
        window.headset.hands.right.position.set(0.4 + 0.4 * Math.cos(angle), 1.2 + 0.15 * Math.cos(2 * angle), 0.3 - 0.4 * Math.sin(angle));
        if (microseconds.length < begun + 200) requestAnimationFrame(move);
        else done({ count: microseconds.length - begun, times: microseconds.slice(begun), areCertified });
      };
      move();
    }), begun);
    assert.ok(count >= 200);
    assert.equal(areCertified, true);
    const sorted = times.sort((a, b) => a - b);
    return `${count} frames of both, median ${(sorted[Math.floor(count / 2)] / 1e3).toFixed(1)} ms, 99 in 100 ${(sorted[Math.floor(0.99 * count)] / 1e3).toFixed(1)} ms`;
  }

  async withoutWebGL() {
    const browsing = await Browsing.start(this.setting, noWebGL);
    try {
      const visit = await browsing.visit({ isOwn: (url) => url.startsWith("file:") });
      await visit.page.goto(`file://${this.setting.page}`);
      await ready(visit.page);
      assert.match(await visit.page.textContent("#view"), /no WebGL/);
      await visit.page.evaluate(() => window.foretouch.setMode("step"));
      await this.#lead(visit.page, [-1.1, 1.15, -0.4]);
      assert.match(await headline(visit.page), /meets board of 4 mm/);
    } finally {
      await browsing.end();
    }
  }

  /** Leads the whole body: its root to a place. */
  async #lead(page, place) {
    await page.evaluate(async (place) => {
      const { from, tracked } = window.foretouch.pose();
      const translations = Float64Array.from(tracked.translations);
      translations.set(place);
      await window.foretouch.lead({ rotations: from.rotations, translations });
    }, place);
    await settled(page);
  }
}

const error = (page) => page.evaluate(() => window.foretouch.state().error);

/** The words follow with the next frame. */
async function headline(page) {
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  return page.textContent("#headline");
}

async function placeOnCanvas(page, link) {
  return page.evaluate((link) => window.foretouch.screenOf(window.foretouch.linkPlace(link)), link);
}

async function placeOnPage(page, link) {
  const { x, y } = await page.locator("#view canvas").first().boundingBox(), [px, py] = await placeOnCanvas(page, link);
  return [x + px, y + py];
}

function countIn(image, isWanted) {
  let found = 0;
  for (let y = 0; y < image.height; ++y) for (let x = 0; x < image.width; ++x) if (isWanted(image.at(x, y))) ++found;
  return found;
}
