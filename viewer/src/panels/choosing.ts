// Choosing a contact, from wherever it is chosen: time goes to it and stands still.

import type { Contact } from "../contacts/contact.js";
import { firstAfter } from "../contacts/contact.js";
import type { Model } from "../model.js";
import type { Store } from "../state.js";

export function choose(store: Store, contact: Contact): void {
  store.set({
    contact,
    link: { avatar: contact.avatar, link: contact.link },
    time: contact.at,
    isPlaying: false,
    follows: false,
  });
}

/** The contact before (-1) or after (1) the chosen one, or else the time shown. */
export function chooseNeighbour(store: Store, model: Model, direction: -1 | 1): void {
  const { contacts } = model;
  const chosen = store.state.contact === null ? -1 : contacts.indexOf(store.state.contact);
  const after = firstAfter(contacts, store.state.time);
  const fromTime = direction > 0 ? after : after - 1;
  const next = chosen >= 0 ? chosen + direction : fromTime;
  if (contacts[next] !== undefined) choose(store, contacts[next]);
}
