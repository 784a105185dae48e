// A service that is watched, and a sender, as programs of their own.

import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { once } from "node:events";
import { patience } from "./browsing.mjs";

export const viewAddress = "127.0.0.1:9465";

/** A running service that takes poses; `stop()` ends it in order. */
export async function serve({ program }, words) {
  const child = spawn(program, ["serve", ...words, "--view", viewAddress], { stdio: ["ignore", "pipe", "pipe"] });
  let said = "";
  for (const stream of [child.stdout, child.stderr]) stream.on("data", (data) => (said += data));
  const deadline = Date.now() + patience;
  while (!/\bready\b/.test(said)) {
    assert.ok(child.exitCode === null && Date.now() < deadline, `the service does not start: ${said}`);
    await new Promise((resolve) => setTimeout(resolve, 20));
  }
  return {
    async stop() {
      child.kill("SIGTERM");
      if (child.exitCode === null) await once(child, "exit");
      assert.equal(child.exitCode, 0, said);
    },
  };
}
