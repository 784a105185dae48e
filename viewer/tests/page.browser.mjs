// The built page in a real browser: opened from disk without a network, and as a live view.
//   node tests/page.browser.mjs [FOLDER FOR SCREENSHOTS]      CHROMIUM names another browser

import assert from "node:assert/strict";
import { mkdirSync, mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";
import { inspection, pageWith, replay, withPerson, withTouches } from "./fixture.mjs";
import { serveLive } from "./live_server.mjs";
import { decodePng } from "./png.mjs";

const template = readFileSync(new URL("../dist/viewer.html", import.meta.url), "utf8");
const shots = process.argv[2] ?? null;
if (shots !== null) mkdirSync(shots, { recursive: true });
const folder = mkdtempSync(join(tmpdir(), "foretouch-viewer-"));
const software = ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"];
const launch = (args = software) => chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args });

let browser = await launch();
let files = 0;

async function open(text, { width = 1400, height = 900, theme = "light", expectsErrors = false, fragment = "" } = {}) {
  const path = join(folder, `${++files}.html`);
  writeFileSync(path, pageWith(template, text));
  const page = await browser.newPage({ viewport: { width, height }, colorScheme: theme, offline: true });
  const complaints = listen(page);
  await page.goto(pathToFileURL(path).href + fragment);
  await page.evaluate(() => window.foretouch.ready);
  await settled(page);
  if (!expectsErrors) assert.deepEqual(complaints, []);
  return { page, complaints };
}

function listen(page) {
  const complaints = [];
  page.on("console", (message) => {
    // What the software renderer says about reading its own pixels is no error of the page.
    if (["error", "warning"].includes(message.type()) && !message.text().includes("GPU stall")) complaints.push(message.text());
  });
  page.on("pageerror", (error) => complaints.push(error.message));
  page.on("request", (request) => {
    if (!/^(file|data|blob):/.test(request.url()) && !request.url().startsWith("http://127.0.0.1")) complaints.push(`asked for ${request.url()}`);
  });
  return complaints;
}

/** Until no more frames are drawn. */
async function settled(page) {
  let before = -1;
  for (let i = 0; i < 60; ++i) {
    const { frames, isAtRest } = await page.evaluate(() => window.foretouch.state());
    if (frames === before && isAtRest) return;
    before = frames;
    await page.waitForTimeout(400);
  }
}

async function shoot(page, name) {
  await settled(page);
  const image = await page.screenshot(shots === null ? {} : { path: join(shots, `${name}.png`) });
  return decodePng(image);
}

const isBlue = ([r, g, b]) => b > r + 30 && b > g;
const isOrange = ([r, g, b]) => r > 140 && r > g + 50 && g > b;

/** How many pixels of a square around a point of the world are of a colour. */
async function countAround(page, image, point, reach, isWanted) {
  const { x, y } = await page.locator("#view canvas").first().boundingBox();
  const at = await page.evaluate((p) => window.foretouch.screenOf(p), point);
  assert.ok(at !== null, "the point is before the camera");
  let found = 0;
  for (let dy = -reach; dy <= reach; ++dy) for (let dx = -reach; dx <= reach; ++dx) {
    const px = Math.round(x + at[0] + dx), py = Math.round(y + at[1] + dy);
    if (px >= 0 && py >= 0 && px < image.width && py < image.height && isWanted(image.at(px, py))) ++found;
  }
  return found;
}

const document = replay();
const text = JSON.stringify(document);
const tests = {
  async "a report draws the avatar and the contact where they are"() {
    const { page } = await open(text);
    const image = await shoot(page, "replay-light");
    const colours = new Set();
    for (let y = 100; y < 700; y += 7) for (let x = 10; x < 1000; x += 7) colours.add([...image.at(x, y)].join());
    assert.ok(colours.size > 40, `${colours.size} colours`);
    const { time } = await page.evaluate(() => window.foretouch.state());
    const hips = await page.evaluate((t) => window.foretouch.transformAt(0, 0, t).slice(9), time);
    assert.ok((await countAround(page, image, hips, 6, isBlue)) > 100, "the hips are blue");
    assert.ok((await countAround(page, image, [hips[0], hips[1] + 3, hips[2]], 2, isBlue)) === 0, "the air is not");
    const index = await page.evaluate(() => window.foretouch.selected());
    const chosen = document.avatars[0].contacts.map((c) => ({ ...c, time: c.time ?? Infinity })).sort((a, b) => a.time - b.time)[index];
    assert.equal(chosen.missed_by_poses, true);
    assert.ok((await countAround(page, image, chosen.point, 8, isOrange)) > 30, "the marker is orange");
    await page.close();
  },

  async "scrubbing moves the avatar, continuously"() {
    const { page } = await open(text);
    const at = (time) => page.evaluate((t) => (window.foretouch.seek(t), window.foretouch.transformAt(0, 9, t)), time);
    const [a, b, c] = [await at(1.0), await at(1.05), await at(1.1)];
    const straight = a.slice(9).map((value, i) => (value + c[9 + i]) / 2);
    const off = Math.hypot(...b.slice(9).map((value, i) => value - straight[i]));
    assert.ok(off > 1e-4 && off < 0.1, `between poses the hand goes along an arc: ${off}`);
    await page.evaluate(() => window.foretouch.seek(0.5));
    const before = await shoot(page, "seek");
    const hips = (await page.evaluate(() => window.foretouch.transformAt(0, 0, 0.5))).slice(9);
    assert.ok((await countAround(page, before, hips, 6, isBlue)) > 100, "the body is where the time says");
    await page.close();
  },

  async "nothing is drawn while nothing changes"() {
    const { page } = await open(text);
    const frames = () => page.evaluate(() => window.foretouch.state().frames);
    const before = await frames();
    await page.waitForTimeout(1500);
    assert.equal(await frames(), before);
    await page.keyboard.press(" ");
    await page.waitForTimeout(700);
    assert.ok((await frames()) > before, "playing draws");
    await page.close();
  },

  async "keys choose, toggle and explain"() {
    const { page } = await open(text);
    await page.evaluate(() => window.foretouch.selectContact(0));
    await page.keyboard.press("]");
    assert.equal(await page.evaluate(() => window.foretouch.selected()), 1);
    await page.keyboard.press("[");
    assert.equal(await page.evaluate(() => window.foretouch.selected()), 0);
    await page.keyboard.press("g");
    assert.equal(await page.evaluate(() => window.foretouch.state().showsGhosts), false);
    await shoot(page, "swept");
    await page.keyboard.press("s");
    assert.equal(await page.evaluate(() => window.foretouch.state().showsSwept), false);
    await page.keyboard.press("?");
    assert.ok(await page.getByText("previous, next touch").isVisible());
    await page.keyboard.press("Escape");
    await page.close();
  },

  async "a discrete check sees fewer, and says how many"() {
    const { page } = await open(text);
    await page.keyboard.press("d");
    const known = document.avatars[0].contacts.filter((c) => c.verdict === "contact");
    const seen = known.filter((c) => !c.missed_by_poses).length;
    assert.ok(await page.getByText(`sees ${seen} of ${known.length} contacts`).isVisible());
    await shoot(page, "discrete");
    await page.close();
  },

  async "the timeline and the table choose contacts"() {
    const { page } = await open(text);
    await page.getByText("Table of contacts").click();
    await page.getByRole("button", { name: /Show the contact of RightHand/ }).first().click();
    assert.equal(await page.evaluate(() => window.foretouch.selected()), 0);
    await page.keyboard.press("Escape");
    const box = await page.locator("canvas.bars").boundingBox();
    const gutter = Math.min(150, Math.round(box.width * 0.26));
    const first = document.avatars[0].contacts[0].time;
    await page.mouse.click(box.x + gutter + (first / 4) * (box.width - gutter - 8) + 2, box.y + box.height - 11);
    assert.equal(await page.evaluate(() => window.foretouch.selected()), 0);
    await page.close();
  },

  async "touches are walked, told and listed; their contacts are the rows of one"() {
    const touched = withTouches(document), { page } = await open(JSON.stringify(touched));
    const met = touched.touches.filter((touch) => !touch.ground);
    const missed = met.filter((touch) => touch.missed).length, ground = touched.touches.length - met.length;
    const besides = ground === 0 ? "" : `, and the ground ${ground === 1 ? "once" : ground === 2 ? "twice" : `${ground} times`} besides`;
    const headline = `The walker touches the room ${met.length} times${besides}. Checking the poses alone would miss ${missed} of ${ground === 0 ? "them" : `the ${met.length}`}.`;
    assert.equal(await page.locator("#headline").innerText(), headline);
    await page.evaluate(() => window.foretouch.selectTouch(0));
    for (let i = 1; i < touched.touches.length; ++i) {
      await page.keyboard.press("]");
      assert.equal(await page.evaluate(() => window.foretouch.selectedTouch()), i);
    }
    const long = touched.touches.findIndex((touch) => touch.rows.length > 1);
    await page.evaluate((i) => window.foretouch.selectTouch(i), long);
    const { rows } = await page.evaluate((i) => window.foretouch.touch(i), long);
    assert.equal(await page.evaluate(() => window.foretouch.selected()), rows[0]);
    await page.keyboard.press("}");
    assert.equal(await page.evaluate(() => window.foretouch.selected()), rows[0] + 1);
    await page.getByText("Table of touches").click();
    await page.locator(".touch-table tbody tr").nth(touched.touches.length - 1).waitFor();
    assert.equal(await page.locator(".touch-table tbody tr").count(), touched.touches.length);
    const download = page.waitForEvent("download");
    await page.getByRole("button", { name: "Save the table as a file" }).click();
    const csv = readFileSync(await (await download).path(), "utf8").trimEnd().split("\r\n");
    assert.equal(csv.length, touched.touches.length + 1);
    assert.ok(csv[1].startsWith(`${touched.touches[0].begin},`), csv[1]);
    await page.close();
  },

  async "what the person touched is chosen in a lane of its own, told, and counted apart"() {
    const touched = withTouches(document), { person } = withPerson(touched), { page } = await open(JSON.stringify({ ...touched, person }));
    const certain = person.touches.filter(({ verdict }) => verdict === "certain"), possible = person.touches.length - certain.length;
    assert.ok((await page.locator("#headline").innerText()).endsWith(` The person: ${certain.length} surely touched, ${possible} perhaps.`));
    const link = Math.min(...person.touches.map((touch) => touch.link)), [first, next] = person.touches.filter((touch) => touch.link === link);
    assert.ok(next === undefined || next.begins[0] > first.begins[0]);
    await page.locator("canvas.bars").evaluate((canvas) => (canvas.parentElement.scrollTop = 0));
    const box = await page.locator("canvas.bars").boundingBox(), gutter = Math.min(150, Math.round(box.width * 0.26));
    await page.mouse.click(box.x + gutter + (first.begins[0] / 4) * (box.width - gutter - 8) + 2, box.y + 22 + 11);
    const { time } = await page.evaluate(() => window.foretouch.state());
    assert.ok(Math.abs(time - Math.max(0, first.begins[0])) < 1e-9, `${time} is when it may begin`);
    const words = first.verdict === "certain" ? `surely touched ${first.object}: began between` : `may have touched ${first.object} between`;
    assert.ok((await page.locator("#caption").innerText()).startsWith(`${touched.avatars[0].links[link].name} ${words}`));
    assert.equal(await page.locator(".details h2").innerText(), "The person");
    assert.ok((await page.locator(".details").innerText()).includes("walker.bounds.json"));
    assert.equal(await page.evaluate(() => window.foretouch.selectedTouch()), -1, "it is no touch of the model");
    await shoot(page, "person");
    await page.keyboard.press("]");
    assert.match(await page.locator("#caption").innerText(), / (surely touched|may have touched) /);
    await page.close();
  },

  async "a search leaves what it names, on the timeline and for the keys"() {
    const { page } = await open(JSON.stringify(withTouches(document)));
    await page.keyboard.press("/");
    await page.keyboard.type("railing");
    await page.keyboard.press("Escape");
    await page.evaluate(() => window.foretouch.seek(0));
    for (let i = 0; i < 3; ++i) {
      await page.keyboard.press("]");
      assert.equal(await page.evaluate(() => window.foretouch.touch(window.foretouch.selectedTouch()).object), "railing");
    }
    await page.locator("input.search").fill("nobody at all");
    await page.locator("input.search").press("Escape");
    await page.keyboard.press("Escape");
    await page.keyboard.press("]");
    assert.equal(await page.evaluate(() => window.foretouch.selectedTouch()), -1);
    await page.close();
  },

  async "an instant has an address, which survives a reload"() {
    const touched = JSON.stringify(withTouches(document)), { page } = await open(touched);
    await page.evaluate(() => window.foretouch.selectTouch(3));
    const { begin } = await page.evaluate(() => window.foretouch.touch(3));
    await page.waitForFunction((t) => location.hash.includes(`t=${t}`), Number(begin.toFixed(6)));
    const fragment = await page.evaluate(() => location.hash);
    assert.match(fragment, /&link=RightHand&object=railing$/);
    await page.reload();
    await page.evaluate(() => window.foretouch.ready);
    assert.equal(await page.evaluate(() => window.foretouch.selectedTouch()), 3);
    await page.close();
    const other = await open(touched, { fragment: "#t=0.123456&link=Head" });
    assert.equal(await other.page.evaluate(() => window.foretouch.state().time), 0.123456);
    await other.page.evaluate((hash) => (location.hash = hash), fragment);
    await other.page.waitForFunction(() => window.foretouch.selectedTouch() === 3);
    await other.page.evaluate(() => (location.hash = "#t=<script>&link=%%%"));
    assert.equal(await other.page.evaluate(() => window.foretouch.selectedTouch()), 3, "nonsense goes nowhere");
    await other.page.close();
  },

  async "check and truth share the picture, and the divider moves"() {
    const { page } = await open(text);
    const whole = await shoot(page, "truth");
    await page.keyboard.press("d");
    const both = await shoot(page, "check-and-truth");
    const { x, y, width, height } = await page.locator("#view canvas").first().boundingBox();
    const handle = await page.locator(".wipe-handle").boundingBox();
    const divider = handle.x + handle.width / 2;
    const differing = (from, to) => {
      let found = 0;
      for (let py = Math.round(y + 40); py < y + height - 60; py += 5) for (let px = Math.round(from); px < to; px += 5) {
        const a = whole.at(px, py), b = both.at(px, py);
        if (Math.max(...[0, 1, 2].map((i) => Math.abs(a[i] - b[i]))) > 40) ++found;
      }
      return found;
    };
    assert.ok(differing(x, divider - 20) > 100, "left of it another picture");
    const { time } = await page.evaluate(() => window.foretouch.state());
    const hips = await page.evaluate((t) => window.foretouch.transformAt(0, 0, t).slice(9), time);
    assert.ok((await countAround(page, both, hips, 6, isBlue)) > 100, "the body of the truth is where the page says");
    const [px] = await page.evaluate((p) => window.foretouch.screenOf(p), hips);
    assert.ok(x + px > divider, "right of it");
    const middle = y + height / 2;
    await page.mouse.move(divider, middle);
    await page.mouse.down();
    await page.mouse.move(x + 0.7 * width, middle, { steps: 4 });
    await page.mouse.up();
    await settled(page);
    const moved = await page.locator(".wipe-handle").boundingBox();
    assert.ok(Math.abs(moved.x + moved.width / 2 - (x + 0.7 * width)) < 3);
    await page.close();
  },

  async "the surface that was asked is shown first"() {
    const value = structuredClone(document), cube = { positions: document.scene.positions, indices: document.scene.indices };
    value.avatars[0].meshes = [{ link: 0, ...cube }];
    const { page } = await open(JSON.stringify(value));
    assert.equal(await page.evaluate(() => window.foretouch.state().shape), "mesh");
    await page.keyboard.press("l");
    assert.equal(await page.evaluate(() => window.foretouch.state().shape), "lss");
    await page.close();
  },

  async "a picture is saved as a PNG, in full and with its sentence"() {
    const { page } = await open(text);
    const download = page.waitForEvent("download");
    await page.getByRole("button", { name: "Save the view as a PNG" }).click();
    const image = decodePng(readFileSync(await (await download).path()));
    const { width, height } = await page.locator("#view canvas").first().boundingBox();
    assert.ok(image.width >= width && image.height > height);
    const colours = new Set();
    for (let py = 60; py < image.height; py += 23) for (let px = 0; px < image.width; px += 23) colours.add([...image.at(px, py)].join());
    assert.ok(colours.size > 40, `${colours.size} colours`);
    await page.close();
  },

  async "a click on the floor gives the place that puts the feet there"() {
    const { page } = await open(JSON.stringify({ ...inspection(), settings: [{ name: "placed at", value: "0, 0, 0 m, turned by 0 degrees" }] }));
    assert.equal(await page.evaluate(() => window.foretouch.placeOption()), null);
    const click = async (point) => {
      const [px, py] = await page.evaluate((p) => window.foretouch.screenOf(p), point);
      const { x, y } = await page.locator("#view canvas").first().boundingBox();
      await page.mouse.click(x + px, y + py);
      const words = await page.evaluate(() => window.foretouch.placeOption());
      return /^--place (.*)$/.exec(words)[1].split(",").map(Number);
    };
    const hips = (await page.evaluate(() => window.foretouch.transformAt(0, 0, 0))).slice(9);
    const target = [0.4, 0, 1.4], [dx, dy, dz, yaw] = await click(target);
    // The feet are under the hips, give or take half a stride.
    assert.ok(Math.hypot(hips[0] + dx - target[0], hips[2] + dz - target[2]) < 0.35, `${dx}, ${dz}`);
    assert.ok(Math.abs(dy) < 0.1 && yaw === 0);
    const turned = await click([target[0], 0, target[2] + 0.6]);
    assert.ok(Math.abs(turned[3] + 90) <= 12, `from +x to +z: ${turned[3]}`);
    await shoot(page, "placing");
    await page.keyboard.press("Escape");
    assert.equal(await page.evaluate(() => window.foretouch.placeOption()), null);
    await page.close();
  },

  async "verdicts of the program stand in place of the page's own, with what to try"() {
    const checks = [{ name: "Place", state: "bad", text: "The trunk is inside a wall.", try: "--place 1,0,-2" }];
    const { page } = await open(JSON.stringify({ ...inspection(), checks }));
    assert.ok(await page.getByText("The trunk is inside a wall.").isVisible());
    assert.ok(await page.getByText("--place 1,0,-2", { exact: true }).isVisible());
    assert.equal(await page.getByText("the size of a person").count(), 0);
    await page.close();
  },

  async "small and dark screens have everything"() {
    for (const theme of ["light", "dark"]) {
      const { page } = await open(text, { width: 390, height: 844, theme });
      const width = await page.evaluate(() => window.document.documentElement.scrollWidth);
      assert.ok(width <= 390, `the page is ${width} wide`);
      await shoot(page, `small-${theme}`);
      await page.close();
    }
    const { page } = await open(text, { theme: "dark" });
    await shoot(page, "replay-dark");
    await page.close();
  },

  async "an inspection measures"() {
    const { page } = await open(JSON.stringify(inspection()));
    assert.ok(await page.getByText("the size of a person").isVisible());
    assert.ok(await page.getByText("6.10 m", { exact: true }).isVisible());
    await shoot(page, "inspection");
    await page.close();
  },

  async "texts of a document stay texts"() {
    const value = structuredClone(document), attack = '<img src=x onerror="window.attacked=1"></script><script>window.attacked=1</script>';
    value.title = value.scene.name = value.notes[0] = value.avatars[0].name = attack;
    value.avatars[0].links.forEach((link) => (link.name = attack));
    value.avatars[0].contacts.forEach((contact) => contact.object && (contact.object = attack));
    value.settings = [{ name: attack, value: attack }];
    value.summary = [{ name: attack, value: attack, note: attack }];
    const { page } = await open(JSON.stringify(value));
    await page.getByText("Table of contacts").click();
    assert.equal(await page.evaluate(() => window.attacked), undefined);
    assert.equal(await page.locator("img").count(), 0);
    await page.close();
  },

  async "a document that is wrong gets one sentence"() {
    for (const [broken, words] of [["{", "is not JSON"], ['{"format":"foretouch-view","version":9}', "version 9"], ["", "nothing has been put into it"]]) {
      const { page } = await open(broken);
      assert.match(await page.evaluate(() => window.foretouch.state().error), new RegExp(words));
      assert.ok(await page.locator(".refusal").getByText(words).isVisible());
      await page.close();
    }
  },

  async "a live view follows, counts, can be scrubbed and reconnects"() {
    const server = await serveLive();
    const page = await browser.newPage({ viewport: { width: 1400, height: 900 } });
    const complaints = listen(page);
    await page.goto(server.address);
    await page.evaluate(() => window.foretouch.ready);
    await page.waitForFunction(() => window.foretouch.state().end > 3 && window.foretouch.state().contacts > 2, undefined, { timeout: 30000 });
    const { time, end } = await page.evaluate(() => window.foretouch.state());
    assert.ok(end - time < 1, `the page is ${end - time} s behind`);
    assert.ok(await page.getByText("Connected", { exact: true }).isVisible());
    assert.ok(await page.getByText("answered", { exact: true }).isVisible());
    await page.locator(".event").waitFor({ state: "visible" });
    await page.getByText("RightHand × railing").first().waitFor();
    await page.locator(".uplot").first().waitFor();
    await page.screenshot(shots === null ? {} : { path: join(shots, "live.png") });
    await page.evaluate(() => window.foretouch.seek(1));
    await page.waitForTimeout(500);
    assert.equal(await page.evaluate(() => window.foretouch.state().time), 1);
    server.join();
    await page.waitForFunction(() => {
      try {
        return window.foretouch.transformAt(1, 0, window.foretouch.state().end).length === 12;
      } catch {
        return false;
      }
    }, undefined, { timeout: 15000 });
    assert.equal(await page.getByText("Not shown:").count(), 0, "who joins is no complaint");
    await page.getByText("not known to touch anything").waitFor();
    const counted = async () => {
      const figure = async (name) => Number((await page.locator("tr", { has: page.getByText(name, { exact: true }) }).locator("td").first().textContent()).replace(/\D/g, ""));
      return { contacts: await figure("contacts"), steps: await figure("steps") };
    };
    const before = await counted();
    await page.waitForTimeout(3000);
    const after = await counted();
    assert.ok(after.steps > before.steps + 20);
    assert.ok(after.contacts - before.contacts < 0.4 * (after.steps - before.steps), "what is undecided is no contact");
    server.send("event: step\ndata: {nonsense\n\n");
    await page.getByText("Not shown:").waitFor();
    assert.deepEqual(complaints, []);
    server.drop();
    await page.getByText("Connection lost").waitFor();
    await page.getByText("Connected", { exact: true }).waitFor({ timeout: 15000 });
    await page.close();
    server.close();
  },

  async "without WebGL everything else works"() {
    await browser.close();
    browser = await launch(["--no-sandbox", "--disable-gpu", "--disable-3d-apis"]);
    const { page } = await open(text, { expectsErrors: true });
    assert.ok(await page.getByText("This browser has no WebGL").isVisible());
    assert.equal(await page.evaluate(() => window.foretouch.state().has3D), false);
    await page.getByText("Table of contacts").click();
    await page.getByRole("button", { name: /Show the contact of RightHand/ }).nth(1).click();
    assert.equal(await page.evaluate(() => window.foretouch.selected()), 1);
    await page.close();
  },
};

let failures = 0;
for (const [name, run] of Object.entries(tests)) {
  const start = Date.now();
  try {
    await run();
    console.log(`ok     ${name} (${((Date.now() - start) / 1000).toFixed(1)} s)`);
  } catch (error) {
    ++failures;
    console.log(`FAILED ${name}\n${error.stack}`);
  }
}
await browser.close();
process.exit(failures === 0 ? 0 : 1);
