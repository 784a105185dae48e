// What a page shows first: what a person would ask for.

import type { Model } from "../model.js";
import type { Contact } from "./contact.js";
import { badness, told, worstBy } from "./feet.js";
import { mostTelling } from "./telling.js";
import type { Touch } from "./touch.js";

export interface Opening {
  readonly touch: Touch | null;
  readonly contact: Contact | null;
}

/**
 * Of touches the deepest, or the longest where none is as deep as is told; those of the scene before the
 * ground. Where there is but the ground, the foot that slides farthest or is deepest. Of bodies among each other, what
 * one of them does to another; of a document without touches, the contact that says most.
 */
export function openingOf(model: Model): Opening {
  const met = model.contacts.filter(({ otherAvatar }) => otherAvatar !== null);
  if (met.length > 0 || model.document.kind !== "replay" || !model.knowsTouches) {
    const candidates = met.length > 0 ? met : model.contacts;
    const contact = candidates[mostTelling(candidates, model.clips)] ?? null;
    return { contact, touch: contact === null ? null : model.touchOf(contact) };
  }
  const all = model.touches.filter((touch) => !touch.isOwn && touch.rows.length > 0);
  const apart = all.filter((touch) => !touch.isGround);
  const foot = apart.length > 0 ? null : worstBy(model.stances, badness);
  const touch = foot ?? worstTouch(apart.length > 0 ? apart : all) ?? model.touches[0] ?? null;
  return { touch, contact: touch === null ? null : momentOf(touch) };
}

function worstTouch(touches: readonly Touch[]): Touch | null {
  const deepest = greatest(touches, ({ depth }) => depth ?? 0);
  return deepest !== null && (deepest.depth ?? 0) >= told ? deepest : greatest(touches, ({ begin, end }) => end - begin);
}

/** The first of those with the most; null of none. */
function greatest(touches: readonly Touch[], of: (touch: Touch) => number): Touch | null {
  return touches.reduce<Touch | null>((best, touch) => (best === null || of(touch) > of(best) ? touch : best), null);
}

/** The contact that shows a touch: where it is deepest, else where it begins. */
export function momentOf(touch: Touch): Contact | null {
  const shown = touch.rows.filter(({ point }) => point !== null);
  const deepest = shown.reduce<Contact | null>((best, row) => ((row.penetration ?? 0) > (best?.penetration ?? 0) ? row : best), null);
  return deepest !== null && (deepest.penetration ?? 0) >= told ? deepest : (shown[0] ?? touch.rows[0] ?? null);
}
