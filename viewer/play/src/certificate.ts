// The planes of a certificate (docs/certificates.md) that hold at one instant.

import type { ProofPlane } from "./messages.js";

/** Of the spans that contain `time`. */
export function planesAt(certificate: string, link: number, time: number): ProofPlane[] {
  const planes: ProofPlane[] = [];
  let holds = false;
  for (const line of certificate.split("\n")) {
    const [word, ...rest] = line.split(" ");
    const n = rest.map(Number);
    if (word === "span") holds = time >= n[1] / 2 ** n[0] && time <= (n[1] + 1) / 2 ** n[0];
    if (word !== "plane" || !holds) continue;
    const length = Math.hypot(n[0], n[1], n[2]);
    if (length > 0) planes.push({ link, normal: [n[0] / length, n[1] / length, n[2] / length], offset: n[3] / length });
  }
  return planes;
}
