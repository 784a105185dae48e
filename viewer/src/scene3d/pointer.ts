// Clicks on the canvas: a contact near the pointer, or else a link under it, or else nothing.

import type { Contact } from "../contacts/contact.js";
import type { Vector } from "../data/document.js";
import type { LinkChoice } from "../state.js";
import type { Performer } from "./performer.js";
import { pickLink } from "./picking.js";

/** Touch and mouse alike, CSS pixels. */
const markerReach = 14;
/** What is lit wins over the many that are not, CSS pixels. */
const dimHandicap = 6;
/** More than this is a drag, CSS pixels. */
const slack = 5;

export function listenForClicks(canvas: HTMLCanvasElement, click: (x: number, y: number) => void): void {
  let down: [number, number] | null = null;
  canvas.addEventListener("pointerdown", (event) => (down = [event.offsetX, event.offsetY]));
  canvas.addEventListener("pointerup", (event) => {
    if (down !== null && Math.hypot(event.offsetX - down[0], event.offsetY - down[1]) <= slack) {
      click(event.offsetX, event.offsetY);
    }
    down = null;
  });
}

export function contactNear(
  contacts: readonly Contact[],
  isLit: (contact: Contact) => boolean,
  screenOf: (point: Vector) => [number, number] | null,
  x: number,
  y: number,
): Contact | null {
  let best: Contact | null = null, bestDistance = markerReach;
  for (const contact of contacts) {
    const at = contact.point === null ? null : screenOf(contact.point);
    if (at === null) continue;
    const distance = Math.hypot(at[0] - x, at[1] - y) + (isLit(contact) ? 0 : dimHandicap);
    if (distance < bestDistance) [best, bestDistance] = [contact, distance];
  }
  return best;
}

/** The nearest link that a ray of the world meets, and how far along. */
export function linkUnder(performers: readonly Performer[], origin: Vector, direction: Vector): (LinkChoice & { distance: number }) | null {
  let best: (LinkChoice & { distance: number }) | null = null, nearest = Infinity;
  performers.forEach((performer, avatar) => {
    if (!performer.clip.hasPose) return;
    const hit = pickLink(performer.avatar, performer.posture.world, origin, direction);
    if (hit === null || hit.distance >= nearest) return;
    nearest = hit.distance;
    best = { avatar, link: hit.link, distance: hit.distance };
  });
  return best;
}
