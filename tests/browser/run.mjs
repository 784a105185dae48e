// The pages as a person sees them, in Chromium, made by the built program.
//   node tests/browser/run.mjs [--program FORETOUCH] [--viewer FOLDER] [--only report,world,motion,live,page]
//       [--transforms VIEW_TRANSFORMS] [--examples FOLDER] [--data FOLDER] [--shots FOLDER] [--page FILE]
// Runs in a network namespace of its own where the system allows one. Exit code 77: nothing can run here.

import { mkdirSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { Browsing } from "./browsing.mjs";
import { ranInNamespace } from "./namespace.mjs";
import { Skipped, missingFor, settingFrom } from "./setting.mjs";

const allSkipped = 77;
const suites = ["report", "world", "motion", "live", "page"];

const setting = settingFrom(process.argv.slice(2));
const missing = missingFor(setting);
if (missing !== null) {
  console.log(`[  SKIPPED ] browser tests: ${missing}`);
  process.exit(allSkipped);
}
process.exit(ranInNamespace(setting) ?? (await runSuites(setting)));

async function runSuites(setting) {
  const folder = mkdtempSync(join(tmpdir(), "foretouch-browser-"));
  mkdirSync(setting.shots, { recursive: true });
  const counts = { ok: 0, skipped: 0, failed: 0 };
  const browsing = await Browsing.start(setting);
  try {
    for (const suite of suites.filter((name) => setting.only?.includes(name) ?? true)) {
      const { casesOf } = await import(`./${suite}_test.mjs`);
      for await (const [name, run] of casesOf({ setting, folder, browsing })) {
        ++counts[await outcome(`${suite}: ${name}`, run)];
      }
    }
  } finally {
    await browsing.end();
    rmSync(folder, { recursive: true, force: true });
  }
  console.log(`${counts.ok} ok, ${counts.skipped} skipped, ${counts.failed} failed; screenshots: ${setting.shots}`);
  if (counts.failed > 0) return 1;
  return counts.ok > 0 ? 0 : allSkipped;
}

async function outcome(name, run) {
  const start = Date.now();
  try {
    const words = await run();
    const seconds = ((Date.now() - start) / 1000).toFixed(1);
    console.log(`[ OK ] ${name} (${seconds} s)${words === undefined ? "" : `: ${words}`}`);
    return "ok";
  } catch (error) {
    const isSkipped = error instanceof Skipped;
    console.log(isSkipped ? `[  SKIPPED ] ${name}: ${error.message}` : `[ FAILED ] ${name}\n${error.stack}`);
    return isSkipped ? "skipped" : "failed";
  }
}
