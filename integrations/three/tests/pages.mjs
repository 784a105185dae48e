// The example pages of three.js and Babylon.js in Chromium, with an emulated headset (iwer): hands meet a
// board, a drawer and a platform, and pass through none of them. Pages have a clock of their own, which goes
// by frames: what is asked of them is the same however slow the machine is.
//   node tests/pages.mjs three|babylon FOLDER [SHOTS]
// FOLDER: where npm has installed the packages, and hand.html is. Exit code 77: no browser, as the last line says.

import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import { createServer } from "node:http";
import { createRequire } from "node:module";
import { extname, join, normalize, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const [host, folder, shots = "."] = process.argv.slice(2);
const viewer = fileURLToPath(new URL("../../../viewer", import.meta.url)), chromiumAt = process.env.CHROMIUM ?? "/usr/bin/chromium";
const iwer = join(viewer, "node_modules/iwer/build/iwer.min.js");
for (const [path, words] of [[chromiumAt, "no Chromium (Debian: apt install chromium)"], [iwer, "no iwer in viewer/node_modules (npm ci there)"], [join(viewer, "node_modules/playwright-core"), "no playwright-core in viewer/node_modules (npm ci there)"]]) {
  if (existsSync(path)) continue;
  console.log(`left out: the pages of ${host}: there is ${words}`);
  process.exit(77);
}
const { chromium } = createRequire(join(viewer, "package.json"))("playwright-core");

const kinds = { ".html": "text/html", ".js": "text/javascript", ".wasm": "application/wasm", ".json": "application/json" };
const server = createServer(({ url }, answer) => {
  const path = join(resolve(folder), normalize(decodeURIComponent(new URL(url, "http://x").pathname)));
  if (!existsSync(path) || extname(path) === "") return void answer.writeHead(404).end();
  answer.writeHead(200, { "content-type": kinds[extname(path)] ?? "application/octet-stream" }).end(readFileSync(path));
}).listen(0, "127.0.0.1");
await new Promise((listening) => server.once("listening", listening));
const address = `http://127.0.0.1:${server.address().port}/hand.html`;

const browser = await chromium.launch({ executablePath: chromiumAt, args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"], timeout: 0 });
const complaints = [];

/** A 72nd of a second per frame, whatever one takes here: a frame that takes long is a gap to hands, and where
 * platforms are after it is left to chance. With an engine in a worker no more than five frames are left out. */
function clockOfFrames() {
  let now = 0, waited = 0;
  const ask = window.requestAnimationFrame.bind(window);
  const advance = () => {
    ask(advance);
    if (window.isAnswering && ++waited > 5) return;
    now += 1000 / 72;
    ++window.frame;
  };
  Object.assign(window, { frame: 0, requestAnimationFrame: (then) => ask(() => then(now)) });
  performance.now = () => now;
  window.watch = (world) => {
    const update = world.update.bind(world);
    world.update = (timeMs) => {
      const later = update(timeMs);
      if (later === undefined || window.isAnswering) return later;
      window.isAnswering = true;
      return later.finally(() => ([window.isAnswering, waited] = [false, 0]));
    };
  };
  ask(advance);
}

/** What nobody looks at is not drawn: without a graphics card that is nearly all of a frame. */
function drawWhenLookedAt() {
  for (const { prototype } of [WebGLRenderingContext, WebGL2RenderingContext]) for (const name of ["drawArrays", "drawElements", "drawArraysInstanced", "drawElementsInstanced"]) {
    const draw = prototype[name];
    if (draw !== undefined) prototype[name] = function (...given) {
      if (window.isLookedAt) draw.apply(this, given);
    };
  }
}

async function opened(query, isHeadset) {
  const page = await (await browser.newContext({ viewport: { width: 1000, height: 640 } })).newPage();
  page.setDefaultTimeout(0);
  const stopped = new Promise((_, stop) => page.once("pageerror", stop));
  page.on("pageerror", (error) => complaints.push(error.message));
  page.on("console", (message) => message.type() === "error" && !/favicon|404/.test(message.text()) && complaints.push(message.text()));
  if (isHeadset) {
    await page.addInitScript(readFileSync(iwer, "utf8"));
    await page.addInitScript(() => {
      const device = new IWER.XRDevice(IWER.metaQuest3);
      device.installRuntime({ polyfillLayers: false, forceInstall: true });
      device.primaryInputMode = "hand";
      device.position.set(0, 1.6, 0.4);
      device.hands.left.position.set(-0.2, 1.15, 0.05);
      device.hands.right.position.set(0.15, 1.15, -0.2);
      window.headset = device;
    });
  }
  await page.addInitScript(clockOfFrames);
  await page.addInitScript(drawWhenLookedAt);
  await page.goto(address + query);
  await Promise.race([page.waitForFunction(() => window.example !== undefined), stopped]);
  await page.evaluate(() => window.watch(window.example.world));
  return page;
}

/** What a page says once it says something: within so many frames, however long these take. */
async function until(page, told, given) {
  const said = await page.evaluate(([told, given]) => new Promise((done) => {
    const last = window.frame + 2000;
    const look = () => {
      const said = new Function("given", `return (${told})(given)`)(given);
      if (said || window.frame > last) done(said);
      else requestAnimationFrame(look);
    };
    look();
  }), [String(told), given]);
  assert.ok(said, `not in 2,000 frames: ${told} of ${given}`);
  return said;
}

const frames = (page, count) => page.evaluate((count) => new Promise((done) => {
  const last = window.frame + count;
  const look = () => (window.frame < last ? requestAnimationFrame(look) : done());
  look();
}), count);

async function picture(page, name) {
  const look = (isLookedAt) => page.evaluate((isLookedAt) => void (window.isLookedAt = isLookedAt), isLookedAt);
  await look(true);
  await frames(page, 3);
  await page.screenshot({ path: join(shots, name) });
  await look(false);
}

/** By host: what the page's own objects say of a hand. */
const inPage = {
  three: () => {
    window.enter = () => document.getElementById("VRButton").click();
    // In WebXR's axes; of each hand that is shown.
    window.shown = () => window.example.hands.filter(({ state }) => state !== null).map((hand) => ({
      state: hand.state,
      isCertified: hand.tick.tick.isCertified,
      crushes: hand.tick.crushes.length,
      joints: Object.values(hand.shown.joints).map(({ position: { x, y, z }, jointRadius }) => [x, y, z, jointRadius]),
      presses: hand.presses.map(({ object }) => object?.name),
    }));
    window.moved = () => ({ drawer: window.example.drawer.position.z, platform: window.example.platform.position.y });
  },
  babylon: () => {
    window.enter = () => window.example.enter();
    window.shown = () => window.example.hands().filter(({ state }) => state !== null).map((hand) => ({
      state: hand.state,
      isCertified: hand.tick.tick.isCertified,
      crushes: hand.tick.crushes.length,
      joints: Object.entries(hand.joints).map(([name, { position: { x, y, z } }]) => [x, y, -z, hand.radii.get(name)]),
      presses: hand.presses.map(({ object }) => object?.name),
    }));
    window.moved = () => ({ drawer: -window.example.drawer.position.z, platform: window.example.platform.position.y });
  },
};

async function headset(query) {
  const page = await opened(query, true);
  await page.evaluate(inPage[host]);
  await page.evaluate(() => window.enter());
  await until(page, () => window.shown().length === 2 && window.shown().every(({ state }) => state === "equal"));
  const rightTo = (place) => page.evaluate(([x, y, z]) => window.headset.hands.right.position.set(x, y, z), place);
  await page.evaluate(() => (window.hand = (side) => window.shown().sort((a, b) => a.joints[0][0] - b.joints[0][0])[side]));
  const right = () => page.evaluate(() => window.hand(1));
  // Through the board of 4 mm, whose front is at x = 0.298: in one frame.
  await rightTo([0.5, 1.15, -0.4]);
  await until(page, () => window.shown().some(({ presses }) => presses.includes("board")));
  await frames(page, 30);
  const atBoard = await right();
  const foremost = Math.max(...atBoard.joints.map(([x, , , radius]) => x + radius));
  assert.ok(foremost < 0.298, `a joint is at ${foremost}`);
  assert.ok(atBoard.isCertified && atBoard.state !== "equal", atBoard.state);
  await picture(page, `${host}-board${query.replace("?", "-")}.png`);
  // Down on the table, whose top is at y = 0.87.
  await rightTo([0.2, 1.15, -0.5]);
  await frames(page, 20);
  await rightTo([0.2, 0.85, -0.5]);
  await until(page, () => window.shown().some(({ presses }) => presses.includes("table")));
  await frames(page, 30);
  const lowest = Math.min(...(await right()).joints.map(([, y, , radius]) => y - radius));
  assert.ok(lowest > 0.87, `a joint is at y = ${lowest}`);
  // Against the drawer, which gives way.
  const before = await page.evaluate(() => window.moved().drawer);
  await rightTo([0.0, 1.1, 0.1]);
  await frames(page, 20);
  await rightTo([0.0, 0.96, 0.1]);
  await frames(page, 30);
  await rightTo([0.0, 0.96, -0.35]);
  await until(page, (before) => window.moved().drawer < before - 0.05, before);
  const pushed = await page.evaluate(() => ({ ...window.moved(), ...window.hand(1) }));
  // It may reach over the front, into the drawer, but is never in its board of 2 cm.
  assert.ok(pushed.joints.every(([x, y, z, radius]) => Math.abs(x) > 0.15 || Math.abs(y - 0.96) > 0.07 || Math.abs(z - pushed.drawer) > 0.01 + radius - 1e-4), "a joint is in the drawer's front");
  // Over the platform, which comes up; what is beside it may be lower.
  await page.evaluate(() => window.headset.hands.left.position.set(-0.5, 1.3, -0.5));
  await frames(page, 20);
  await page.evaluate(() => window.headset.hands.left.position.set(-0.5, 0.86, -0.5));
  await until(page, () => window.shown().some(({ presses }) => presses.includes("platform")));
  for (let i = 0; i < 20; ++i) {
    await frames(page, 5);
    const { platform, joints, crushes } = await page.evaluate(() => ({ ...window.moved(), ...window.hand(0) }));
    const low = Math.min(...joints.filter(([x, , z]) => Math.abs(x + 0.5) < 0.15 && Math.abs(z + 0.45) < 0.15).map(([, y, , radius]) => y - radius));
    // In a worker the shown hand is of some frames before, in which the platform was elsewhere: 1.2 mm in each.
    assert.ok(low > platform + 0.01 - (query === "" ? 0 : 0.01), `a joint is at y = ${low}, the platform at ${platform}; ${crushes} crushes`);
  }
  const met = await page.evaluate(() => [...new Set(window.example.touches.map(({ object }) => object))].sort());
  assert.ok(["board", "drawer", "platform", "table"].every((name) => met.includes(name)), met.join());
  await picture(page, `${host}-platform${query.replace("?", "-")}.png`);
  await page.context().close();
  return `the foremost joint ${(1e3 * (0.298 - foremost)).toFixed(1)} mm before the board; met ${met.join(", ")}`;
}

async function pointer() {
  const page = await opened("", false);
  await page.mouse.move(430, 200);
  await until(page, () => window.example.hands[2].state === "equal");
  // Into the cupboard behind the board.
  await page.evaluate(() => window.example.pointer.position.set(0.5, 1.1, -0.3));
  await until(page, () => window.example.hands[2].presses.some(({ object }) => object.name === "board"));
  await frames(page, 100);
  await until(page, () => window.example.hands[2].presses.some(({ object }) => object.name === "board"));
  await picture(page, "three.png");
  const joints = await page.evaluate(() => Object.values(window.example.hands[2].shown.joints).map(({ position, jointRadius }) => position.x + jointRadius));
  assert.ok(Math.max(...joints) < 0.298);
  await page.context().close();
  return "a pointer's hand stays before the board";
}

try {
  if (host === "three") console.log(await pointer());
  console.log(await headset(""));
  if (host === "three") console.log(`in a worker: ${await headset("?worker")}`);
  assert.deepEqual(complaints, []);
} finally {
  if (complaints.length > 0) console.log(complaints);
  await browser.close();
  server.close();
}
