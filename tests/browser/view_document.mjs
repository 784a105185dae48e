// The document in a report, read without the page's code.

import { readFileSync } from "node:fs";

const opening = '<script type="application/json" id="foretouch-view">';

export function documentIn(path) {
  const html = readFileSync(path, "utf8");
  const begin = html.indexOf(opening) + opening.length;
  return JSON.parse(html.slice(begin, html.indexOf("</script>", begin)));
}

export function doublesOf({ f64 }) {
  return new Float64Array(bytesOf(f64));
}

export function indicesOf({ u32 }) {
  return new Uint32Array(bytesOf(u32));
}

function bytesOf(base64) {
  const { buffer, byteOffset, byteLength } = Buffer.from(base64, "base64");
  return buffer.slice(byteOffset, byteOffset + byteLength);
}

/** Steps in which some link's rotations have a negative dot product: the shorter arc negates one of them. */
export function stepsThatFlip({ links, track }) {
  const rotations = doublesOf(track.rotations), from = indicesOf(track.steps.from), to = indicesOf(track.steps.to);
  const flips = (step) => links.some((_, link) => {
    const at = 4 * (links.length * from[step] + link), then = 4 * (links.length * to[step] + link);
    return [0, 1, 2, 3].reduce((sum, i) => sum + rotations[at + i] * rotations[then + i], 0) < 0;
  });
  return Array.from(from.keys()).filter(flips);
}
