// What a check at the poses alone would have seen: the avatar jumps from pose to pose, and only
// links that touch something at a pose itself light up.

import type { Avatar, TouchingAtPoses, Track } from "../data/document.js";
import { lastAtMost } from "../motion/clip.js";
import type { Contact } from "./contact.js";
import { firstAfter } from "./contact.js";

export interface DiscreteCount {
  readonly seen: number;
  readonly all: number;
}

/**
 * How many contacts a check at the poses sees, of those that begin between poses; null where nobody
 * looked. What starts in contact or is undecided has no instant to miss.
 */
export function discreteCount(contacts: readonly Contact[]): DiscreteCount | null {
  const known = contacts.filter((one) => one.verdict === "contact" && one.missedByPoses !== null);
  if (known.length === 0) return null;
  return { seen: known.filter((contact) => contact.missedByPoses === false).length, all: known.length };
}

/** Links that touch something at the latest pose at or before `time`. */
export function touchingLinks(track: Track | null, time: number): ReadonlySet<number> {
  if (track === null || track.touching === null || track.poseTimes.length === 0) return new Set();
  const pose = Math.max(0, lastAtMost(track.poseTimes, time));
  return new Set(linksAtPose(track.touching, pose));
}

function linksAtPose(touching: TouchingAtPoses, pose: number): Uint16Array {
  return touching.links.subarray(touching.first[pose], touching.first[pose + 1]);
}

/** Contacts that a check at the pose shown at `time` would report, of all avatars. */
export function seenAtPoses(
  { contacts, avatars, longestStep }: { contacts: readonly Contact[]; avatars: readonly Avatar[]; longestStep: number },
  time: number,
): Contact[] {
  // A step that ends or begins at the latest pose lies within its own length of `time`, on either side.
  const from = firstAfter(contacts, time - 2 * longestStep - 1e-9), to = firstAfter(contacts, time + 2 * longestStep);
  return contacts.slice(from, to).filter((contact) => isSeenAtPose(contact, avatars[contact.avatar].track, time));
}

/** Whether a check at the pose shown at `time` would report this contact. */
export function isSeenAtPose(contact: Contact, track: Track | null, time: number): boolean {
  if (contact.missedByPoses !== false || track === null || track.poseTimes.length === 0) return false;
  const pose = Math.max(0, lastAtMost(track.poseTimes, time));
  const isEndOfStep = track.from[contact.step] === pose || track.to[contact.step] === pose;
  if (!isEndOfStep) return false;
  return track.touching === null || linksAtPose(track.touching, pose).includes(contact.link);
}
