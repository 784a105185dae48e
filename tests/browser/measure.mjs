// What the pages cost: size, time until something is seen, frames a second, memory, and how late a
// live contact is. Figures, not a test; rendering is by software.
//   node tests/browser/measure.mjs [the options of run.mjs; --only demo,dance,long,live]

import { mkdtempSync, readFileSync, rmSync, statSync } from "node:fs";
import { loadavg, tmpdir } from "node:os";
import { join } from "node:path";
import { Browsing, noGraphicsCard, noWebGL } from "./browsing.mjs";
import { delaysSeen, percentiles, watchDelays } from "./live_delays.mjs";
import { ranInNamespace } from "./namespace.mjs";
import { liveClip, reportOf, run } from "./programs.mjs";
import { serve, viewAddress } from "./service.mjs";
import { missingFor, settingFrom } from "./setting.mjs";
import { documentIn } from "./view_document.mjs";

const playedMs = 10000, walkedTouches = 20;
/** Functions of a profile that are printed. */
const printedFunctions = 6;

const setting = settingFrom(process.argv.slice(2));
const missing = missingFor(setting);
if (missing !== null) throw new Error(missing);
process.exit(ranInNamespace(setting) ?? (await measureAll()));

async function measureAll() {
  const folder = mkdtempSync(join(tmpdir(), "foretouch-measure-"));
  const isAsked = (name) => setting.only?.includes(name) ?? true;
  console.log(`load ${loadavg().map((value) => value.toFixed(1)).join(" ")}`);
  try {
    for (const name of ["demo", "dance", "long"]) if (isAsked(name)) await measureReport(folder, name);
    if (isAsked("live")) await measureLive("3D by software");
    if (isAsked("live")) await measureLive("without 3D", noWebGL);
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
  return 0;
}

async function measureReport(folder, name) {
  const { page: path } = await reportOf(setting, folder, name);
  const { scene } = documentIn(path);
  const triangles = Buffer.byteLength(scene.indices.u32, "base64") / 12;
  console.log(`${name}: ${(statSync(path).size / 1e6).toFixed(1)} MB, ${triangles} of ${scene.triangles_in_file} triangles`);
  const browsing = await Browsing.start(setting, noGraphicsCard);
  const { page } = await browsing.visit({ isOwn: () => true });
  const profiler = await page.context().newCDPSession(page);
  await profiler.send("Profiler.enable");
  await profiler.send("Profiler.start");
  const start = Date.now(), since = () => `${((Date.now() - start) / 1000).toFixed(1)} s`;
  await page.goto(`file://${path}`);
  const parsed = since();
  await page.evaluate(() => window.foretouch.ready);
  const ready = since();
  await page.waitForFunction(() => window.foretouch.state().frames > 0);
  console.log(`  loaded ${parsed}, ready ${ready}, first frame ${since()}; of it`);
  printProfile(await profiler.send("Profiler.stop"));
  console.log(`  next touch on the screen: ${percentiles(await nextTouches(page))}`);
  await page.evaluate(() => window.foretouch.seek(window.foretouch.state().start));
  await profiler.send("Profiler.start");
  console.log(`  ${(await framesPerSecond(page)).toFixed(1)} frames a second while playing at 1400x900; of ${playedMs / 1000} s`);
  printProfile(await profiler.send("Profiler.stop"));
  await printMemory(browsing.browser, profiler);
  await browsing.end();
}

/** From the key to the first frame that shows it, milliseconds. */
async function nextTouches(page) {
  return page.evaluate(async (count) => {
    const times = [], pause = (ms) => new Promise((done) => setTimeout(done, ms));
    for (let i = 0; i < count; ++i) {
      const { frames } = window.foretouch.state(), start = performance.now();
      document.dispatchEvent(new KeyboardEvent("keydown", { key: "]" }));
      while (window.foretouch.state().frames === frames) await pause(1);
      times.push(performance.now() - start);
      await pause(600);
    }
    return times;
  }, walkedTouches);
}

async function framesPerSecond(page) {
  const frames = () => page.evaluate(() => [window.foretouch.state().frames, performance.now()]);
  await page.keyboard.press(" ");
  const [before, from] = await frames();
  await page.waitForTimeout(playedMs);
  const [after, to] = await frames();
  return (1000 * (after - before)) / (to - from);
}

/** Time in functions themselves. */
function printProfile({ profile }) {
  const names = new Map(profile.nodes.map(({ id, callFrame }) => [id, callFrame.functionName || "(no name)"]));
  const times = new Map();
  profile.samples.forEach((id, i) => times.set(names.get(id), (times.get(names.get(id)) ?? 0) + profile.timeDeltas[i] / 1000));
  const most = [...times].sort((a, b) => b[1] - a[1]).slice(0, printedFunctions);
  console.log(`    ${most.map(([name, ms]) => `${name} ${ms.toFixed(0)} ms`).join(", ")}`);
}

async function printMemory(browser, session) {
  await session.send("Performance.enable");
  const { metrics } = await session.send("Performance.getMetrics");
  const heap = metrics.find(({ name }) => name === "JSHeapUsedSize").value;
  const { processInfo } = await (await browser.newBrowserCDPSession()).send("SystemInfo.getProcessInfo");
  const resident = processInfo.map(({ type, id }) => {
    const [, kilobytes] = /VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${id}/status`, "utf8"));
    return `${type} ${(kilobytes / 1000).toFixed(0)} MB`;
  });
  console.log(`  heap ${(heap / 1e6).toFixed(0)} MB without typed arrays; resident: ${resident.join(", ")}`);
}

async function measureLive(name, flags) {
  const clip = liveClip(setting), browsing = await Browsing.start(setting, flags), service = await serve(setting, clip.served);
  const { page } = await browsing.visit({ width: 800, height: 600, isOwn: () => true });
  await page.goto(`http://${viewAddress}/`);
  await page.evaluate(() => window.foretouch.ready);
  await page.getByText("Connected", { exact: true }).waitFor();
  await watchDelays(page);
  await run(setting.program, ["publish", ...clip.published]);
  const { received, drawn } = await delaysSeen(page);
  console.log(`live, ${name}: from a pose's stamp to the page ${percentiles(received)}, to the screen ${percentiles(drawn)}`);
  await browsing.end();
  await service.stop();
}
