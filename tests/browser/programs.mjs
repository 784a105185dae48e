// The programs under test, run as a person would run them.

import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { promisify } from "node:util";
import { dataFile } from "./setting.mjs";

const maxOutputBytes = 1 << 28;

export async function run(program, words) {
  const { stdout } = await promisify(execFile)(program, words, { maxBuffer: maxOutputBytes });
  return stdout;
}

/** The clips that tests play: each makes the words of `foretouch replay` that say what is played, and where. */
export const clips = {
  demo: ({ examples }) => ({
    scene: ["--scene", join(examples, "room.obj")],
    played: ["--avatar", join(examples, "dancer.avatar.json"), "--motion", join(examples, "dancer.bvh"), "--rate", "10"],
  }),
  async kick(setting, folder) {
    const scene = ["--scene", dataFile(setting, "scenes/kitchen_fatihrmutfak.ply"), "--up", "z"];
    const played = await recordedClip(setting, folder, dataFile(setting, "mocap/bandai1_kick_normal_001.bvh"), 0.01);
    return { scene, played: [...played, "--place", "1,0.02,-1"] };
  },
  async dance(setting, folder) {
    const scene = ["--scene", dataFile(setting, "scenes/kitchen_fatihrmutfak.ply"), "--up", "z"];
    const played = await recordedClip(setting, folder, dataFile(setting, "mocap/bandai1_dance-short_normal_001.bvh"), 0.01);
    return { scene, played: [...played, "--place", "1,0.02,-1"] };
  },
  /** A minute at 120 poses a second: a clip there and back again. */
  async long(setting, folder) {
    const [head, frames] = readFileSync(dataFile(setting, "mocap/cmu_01_01_playground_jumps.bvh"), "utf8").split(/(?<=Frame Time:.*\n)/);
    const there = frames.trim().split("\n"), both = [...there, ...there.slice().reverse()], wanted = 7200;
    const lines = Array.from({ length: wanted }, (_, i) => both[i % both.length]), motion = join(folder, "long.bvh");
    writeFileSync(motion, head.replace(/Frames:.*/, `Frames: ${wanted}`) + lines.join("\n") + "\n");
    const scene = ["--scene", dataFile(setting, "scenes/kitchen_fatihrmutfak.ply"), "--up", "z"];
    return { scene, played: [...(await recordedClip(setting, folder, motion, 0.056444)), "--place", "0.9,0.02,0.6"] };
  },
  async robot(setting, folder) {
    const model = dataFile(setting, "avatars/robot_expressive.glb"), avatar = join(folder, "robot.avatar.json"), scale = "0.3";
    await run(setting.program, ["avatar", "mesh", model, "--scale", scale, "--output", avatar]);
    return { scene: clips.demo(setting).scene, played: ["--avatar", avatar, "--motion", model, "--scale", scale] };
  },
  /** An arm that turns on and on: its angle goes from 350 degrees to 10, its quaternion to the other side. */
  async wrapping(setting, folder) {
    const motion = join(folder, "wrapping.bvh");
    writeFileSync(motion, wrappingClip());
    return { scene: clips.demo(setting).scene, played: await recordedClip(setting, folder, motion, 1) };
  },
};

/** The bundled clip as a stream: words of `serve` and `publish`, and of the `replay` that gives the same answers. */
export function liveClip({ examples }) {
  const avatar = join(examples, "dancer.avatar.json"), motion = join(examples, "dancer.bvh"), rate = "30";
  const served = ["--scene", join(examples, "room.obj"), "--avatar", avatar];
  return {
    served,
    published: [motion, "--avatar", avatar, "--rate", rate],
    replayed: [...served, "--motion", motion, "--rate", rate],
  };
}

function wrappingClip() {
  const frames = Array.from({ length: 60 }, (_, i) => `0 1 0 ${(17 * i) % 360} 0 0 ${(31 * i) % 360} ${(13 * i) % 360} 0`);
  return `HIERARCHY
ROOT Body
{
  OFFSET 0 0 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT Arm
  {
    OFFSET 0 0.5 0
    CHANNELS 3 Zrotation Xrotation Yrotation
    End Site
    {
      OFFSET 0.6 0 0
    }
  }
}
MOTION
Frames: ${frames.length}
Frame Time: 0.05
${frames.join("\n")}
`;
}

async function recordedClip(setting, folder, motion, scale) {
  const avatar = join(folder, "recorded.avatar.json");
  await run(setting.program, ["avatar", "bvh", motion, "--scale", `${scale}`, "--output", avatar]);
  return ["--avatar", avatar, "--motion", motion, "--scale", `${scale}`];
}

/** Replays a clip: the report, the results and what was printed. */
export async function reportOf(setting, folder, name) {
  const clip = await clips[name](setting, folder);
  const page = join(folder, `${name}.html`), output = join(folder, `${name}.jsonl`);
  const printed = await run(setting.program, ["replay", ...clip.scene, ...clip.played, "--output", output, "--report", page]);
  return { ...clip, name, page, printed, results: resultsIn(output) };
}

/** Every contact of a results file, with the step and the times that it belongs to. */
export function resultsIn(path) {
  const [header, ...lines] = readFileSync(path, "utf8").trimEnd().split("\n").map((line) => JSON.parse(line));
  const steps = lines.filter((line) => "step" in line);
  assert.equal(header.format, "foretouch-results");
  assert.equal(steps.length, header.steps);
  const contacts = steps.flatMap(({ step, t0, t1, contacts }) => contacts.map((contact) => ({ ...contact, step, t0, t1 })));
  return { header, contacts };
}
