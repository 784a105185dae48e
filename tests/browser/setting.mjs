// What the browser tests run, and where: from the command line and the environment.

import { existsSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { parseArgs } from "node:util";

const source = resolve(dirname(fileURLToPath(import.meta.url)), "../..");

/** Thrown by what cannot run here; the message says why. */
export class Skipped extends Error {}

export function settingFrom(words) {
  const text = { type: "string" };
  const { values } = parseArgs({
    args: words,
    options: { program: text, transforms: text, viewer: text, examples: text, data: text, shots: text, only: text, page: text },
  });
  const program = resolve(values.program ?? join(source, "build/release/bin/foretouch"));
  const bin = dirname(program);
  return {
    source,
    program,
    transforms: resolve(values.transforms ?? join(bin, "view_transforms")),
    viewer: resolve(values.viewer ?? join(source, "viewer")),
    examples: resolve(values.examples ?? join(bin, "../share/foretouch/examples")),
    data: resolve(values.data ?? process.env.FORETOUCH_DATA ?? join(source, "../shared/data")),
    shots: resolve(values.shots ?? join(bin, "../browser")),
    page: resolve(values.page ?? join(source, "build/page/foretouch.html")),
    only: values.only?.split(",") ?? null,
    chromium: process.env.CHROMIUM ?? "/usr/bin/chromium",
  };
}

/** Why no browser can be run here; null where one can. */
export function missingFor({ chromium, viewer, program }) {
  if (!existsSync(program)) return `there is no program ${program}`;
  if (!existsSync(chromium)) return `there is no browser ${chromium} (Debian: apt install chromium)`;
  if (!existsSync(join(viewer, "node_modules/playwright-core"))) return `playwright-core is not in ${viewer}/node_modules (npm ci there)`;
  return null;
}

/** The driver of browsers: a development dependency of the page. */
export function playwrightOf({ viewer }) {
  return createRequire(join(viewer, "package.json"))("playwright-core");
}

/** A file of ../shared/data, which a checkout may be without. */
export function dataFile({ data }, name) {
  const path = join(data, name);
  if (!existsSync(path)) throw new Skipped(`${path} is absent`);
  return path;
}
