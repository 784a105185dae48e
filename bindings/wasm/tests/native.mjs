// What the module is held against: the bundled examples, and what the native program says of them.
//   FORETOUCH_EXAMPLES  their folder; FORETOUCH_PROGRAM  the program foretouch

import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

export const examples = process.env.FORETOUCH_EXAMPLES ?? "";
export const program = process.env.FORETOUCH_PROGRAM ?? "";

/** For tests that need both: false, or why they are skipped. */
export const skip = existsSync(program) && existsSync(join(examples, "room.obj")) ? false : `there is no native program, or no examples (FORETOUCH_PROGRAM: '${program}', FORETOUCH_EXAMPLES: '${examples}')`;

export function example(name) {
  return readFileSync(join(examples, name), "utf8");
}

/** The bundled scenes: one object per "o" line; coordinates are floats, as the native importer reads them. */
export function parseObj(text) {
  const positions = [], indices = [], objects = [], names = [];
  for (const line of text.split("\n")) {
    const [word, ...rest] = line.trim().split(/\s+/);
    if (word === "o") names.push(rest.join(" "));
    if (word === "v") positions.push(...rest.map((number) => Math.fround(Number(number))));
    if (word !== "f") continue;
    const corners = rest.map((corner) => Number.parseInt(corner, 10) - 1);
    for (let i = 2; i < corners.length; ++i) {
      indices.push(corners[0], corners[i - 1], corners[i]);
      objects.push(Math.max(0, names.length - 1));
    }
  }
  return { positions, indices, objects, names };
}

/** The steps of a replay by the native program. */
export function nativeReplay({ scene, avatar, motion }) {
  const folder = mkdtempSync(join(tmpdir(), "foretouch-module-"));
  try {
    const output = join(folder, "contacts.jsonl");
    const at = (name) => join(examples, name);
    execFileSync(program, ["replay", "--scene", at(scene), "--avatar", at(avatar), "--motion", at(motion), "--output", output], { stdio: "pipe" });
    const lines = readFileSync(output, "utf8").trim().split("\n").map((line) => JSON.parse(line));
    return { names: lines[0].links, steps: lines.filter(({ step }) => step !== undefined) };
  } finally {
    rmSync(folder, { recursive: true });
  }
}
