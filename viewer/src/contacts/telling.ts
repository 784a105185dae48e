// The contact to show first: the one that says most about why the motion between poses matters.

import type { Clip } from "../motion/clip.js";
import { Posture } from "../motion/clip.js";
import type { Contact } from "./contact.js";

/** Looking further does not find a better picture, only a later one. */
const maxCandidates = 2000;
/** More than anything travels in a step, metres. */
const rankWeight = 1e6;

/**
 * Index of the contact whose link moves furthest in its step and has the least company in it, those
 * first that a check at the poses misses; -1 where there are no contacts.
 */
export function mostTelling(contacts: readonly Contact[], clips: readonly Clip[]): number {
  const postures = clips.map((clip) => new Posture(clip));
  const company = new Map<string, number>();
  const stepOf = (contact: Contact): string => `${contact.avatar}:${contact.step}`;
  for (const contact of contacts) company.set(stepOf(contact), (company.get(stepOf(contact)) ?? 0) + 1);
  let best = -1, bestScore = -Infinity;
  contacts.slice(0, maxCandidates).forEach((contact, index) => {
    const rank = contact.verdict === "contact" ? (contact.missedByPoses === true ? 2 : 1) : 0;
    const score = rank * rankWeight + (midway(contact) * travel(contact, postures[contact.avatar])) / (company.get(stepOf(contact)) ?? 1) ** 2;
    if (score > bestScore) [best, bestScore] = [index, score];
  });
  return best;
}

/** 1 for a contact halfway between the poses, 0 for one at either. */
function midway(contact: Contact): number {
  const toi = contact.toi ?? 0;
  return 4 * toi * (1 - toi);
}

/** How far the link's point of contact moves from the step's first pose to its last, metres. */
function travel(contact: Contact, posture: Posture): number {
  posture.moveWithin(contact.step, 0);
  const before = posture.transform(contact.link);
  posture.moveWithin(contact.step, 1);
  const after = posture.transform(contact.link);
  return Math.hypot(after[9] - before[9], after[10] - before[10], after[11] - before[11]);
}
