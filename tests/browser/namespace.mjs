// A network of one's own: nothing of a test leaves the machine, and no other service is in the way.

import { spawnSync } from "node:child_process";
import { join } from "node:path";

/** The exit code of the same command in a namespace; null where this is that command, or none is to be had. */
export function ranInNamespace({ source }) {
  const inNamespace = join(source, "tests/network/in_namespace.sh");
  if (process.env.FORETOUCH_PRIVATE_NETWORK !== undefined) return null;
  if (spawnSync(inNamespace, ["true"]).status !== 0) return null;
  return spawnSync(inNamespace, [process.execPath, ...process.argv.slice(1)], { stdio: "inherit" }).status;
}
