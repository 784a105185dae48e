// The motion that the page plays is the library's: every link's place, at random times, at poses, and
// where the shorter arc turns a quaternion's sign.

import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { reportOf, run } from "./programs.mjs";
import { documentIn, doublesOf, indicesOf, stepsThatFlip } from "./view_document.mjs";

const randomTimes = 1000, poseTimes = 200, timesInFlips = 200;
/** Metres, and entries of rotation matrices. */
const agreement = 1e-6;
const timesPerCall = 100;
let flipsSeen = 0;

export async function* casesOf(context) {
  for (const name of ["demo", "kick", "robot", "wrapping"]) {
    yield [`the page plays ${name} as the library does`, () => playsAlike(context, name)];
  }
  yield ["signs of quaternions were turned", () => {
    assert.ok(flipsSeen > 0);
    return `in ${flipsSeen} steps`;
  }];
}

async function playsAlike({ setting, folder, browsing }, name) {
  const report = await reportOf(setting, folder, name);
  const [avatar] = documentIn(report.page).avatars;
  const { times, flips } = timesOf(avatar, name);
  const timesFile = join(folder, `${name}.times`);
  writeFileSync(timesFile, times.join("\n"));
  const lines = (await run(setting.transforms, [...report.played, "--at", timesFile])).trimEnd().split("\n").map((line) => JSON.parse(line));
  assert.equal(lines.length, times.length);
  const visit = await browsing.openFile(report.page);
  let worst = 0, count = 0;
  for (let first = 0; first < lines.length; first += timesPerCall) {
    const some = lines.slice(first, first + timesPerCall);
    const shown = await transformsAt(visit.page, some.map(({ time }) => time), avatar.links.length);
    some.forEach(({ time, links }, i) => {
      assert.equal(time, times[first + i]);
      links.flat().forEach((value, k) => {
        worst = Math.max(worst, Math.abs(value - shown[i][k]));
        ++count;
      });
    });
  }
  await visit.end();
  flipsSeen += flips;
  assert.ok(count > 0 && worst <= agreement, `${worst} apart`);
  return `${times.length} times, ${avatar.links.length} links, ${flips} steps with turned signs, at most ${worst.toExponential(1)} apart`;
}

/** Twelve numbers a link, link after link, for each time. */
function transformsAt(page, times, links) {
  return page.evaluate(([times, links]) => times.map((time) =>
    Array.from({ length: links }, (_, link) => window.foretouch.transformAt(0, link, time)).flat()), [times, links]);
}

function timesOf(avatar, seed) {
  const poses = doublesOf(avatar.track.pose_times);
  const from = indicesOf(avatar.track.steps.from), to = indicesOf(avatar.track.steps.to);
  const random = randomFrom(seed);
  const within = (t0, t1) => t0 + random() * (t1 - t0);
  const some = (list, count) => Array.from({ length: Math.min(count, list.length) }, () => list[Math.floor(random() * list.length)]);
  const flips = stepsThatFlip(avatar);
  const times = Array.from({ length: randomTimes }, () => within(poses[0], poses[poses.length - 1]));
  times.push(poses[0], poses[poses.length - 1], ...some(poses, poseTimes));
  if (flips.length > 0) times.push(...Array.from({ length: timesInFlips }, () => flips[Math.floor(random() * flips.length)]).map((step) => within(poses[from[step]], poses[to[step]])));
  return { times, flips: flips.length };
}

/** Numbers in [0, 1): the same for the same text (mulberry32). */
function randomFrom(text) {
  let state = [...text].reduce((sum, letter) => (Math.imul(sum, 31) + letter.charCodeAt(0)) | 0, 1);
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let z = Math.imul(state ^ (state >>> 15), 1 | state);
    z = (z + Math.imul(z ^ (z >>> 7), 61 | z)) ^ z;
    return ((z ^ (z >>> 14)) >>> 0) / 4294967296;
  };
}
