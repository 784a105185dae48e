// Choosing a touch or one of its contacts, from wherever it is chosen: time goes there and stands
// still.

import type { Contact } from "../contacts/contact.js";
import { firstAfter } from "../contacts/contact.js";
import { isDeep } from "../contacts/feet.js";
import { momentOf } from "../contacts/opening.js";
import type { Touch } from "../contacts/touch.js";
import { firstTouchAfter, whose } from "../contacts/touch.js";
import type { Model } from "../model.js";
import type { Store } from "../state.js";

export function chooseContact(store: Store, model: Model, contact: Contact): void {
  store.set({
    contact,
    touch: model.touchOf(contact),
    link: { avatar: contact.avatar, link: contact.link },
    time: contact.at,
    isPlaying: false,
    follows: false,
  });
}

export function chooseTouch(store: Store, model: Model, touch: Touch): void {
  const contact = momentOf(touch);
  store.set({
    touch,
    contact,
    link: { avatar: touch.avatar, link: touch.link },
    time: Math.min(model.end, contact?.at ?? timeOf(touch)),
    isPlaying: false,
    follows: false,
  });
}

/** Of a foot: where it is deepest, if it is deep in; else in the middle of its stance. */
export function timeOf({ stance, begin, end }: Touch): number {
  if (stance === null) return begin;
  return isDeep(stance) ? stance.depthAt : (begin + end) / 2;
}

/** The touch before (-1) or after (1) the chosen one, or else the time shown, of those that are shown. */
export function walkTouches(store: Store, model: Model, direction: -1 | 1): void {
  const { touch, time, search, showsGround } = store.state;
  const walked = touch === null ? "link" : whose(touch);
  const touches = model.shownTouches(search, showsGround).filter((one) => whose(one) === walked);
  const chosen = touch === null ? -1 : touches.indexOf(touch);
  const next = chosen >= 0 ? chosen + direction : neighbour(firstTouchAfter(touches, time), direction);
  if (touches[next] !== undefined) chooseTouch(store, model, touches[next]);
}

/** As walkTouches(), from one contact of all steps to the next. */
export function walkContacts(store: Store, model: Model, direction: -1 | 1): void {
  const { contacts } = model, { contact, time } = store.state;
  const chosen = contact === null ? -1 : contacts.indexOf(contact);
  const next = chosen >= 0 ? chosen + direction : neighbour(firstAfter(contacts, time), direction);
  if (contacts[next] !== undefined) chooseContact(store, model, contacts[next]);
}

function neighbour(after: number, direction: -1 | 1): number {
  return direction > 0 ? after : after - 1;
}
