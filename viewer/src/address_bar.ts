// Keeps the page's address at the instant shown, and goes where an address says.

import { addressFrom, fragmentOf } from "./address.js";
import type { Contact } from "./contacts/contact.js";
import type { Touch } from "./contacts/touch.js";
import type { Model } from "./model.js";
import { chooseContact, chooseTouch } from "./panels/choosing.js";
import type { Store } from "./state.js";

/** Browsers refuse more than a hundred changes in half a minute. */
const restMs = 350;
/** An address has microseconds: this near is the same instant, seconds. */
const sameInstant = 1e-6;

/** Goes where the address says now, and later wherever it is changed to; then follows the state. */
export function keepAddress(model: Model, store: Store): void {
  let timer = 0;
  goTo(model, store, location.hash);
  window.addEventListener("hashchange", () => goTo(model, store, location.hash));
  store.subscribe((changes) => {
    if (!changes.has("time") && !changes.has("link") && !changes.has("touch")) return;
    window.clearTimeout(timer);
    timer = window.setTimeout(() => {
      const { isPlaying, follows } = store.state;
      if (!isPlaying && !follows) history.replaceState(null, "", hashOf(model, store));
    }, restMs);
  });
}

/** Of the instant shown, to be shared. */
export function addressOf(model: Model, store: Store): string {
  return location.href.replace(/#.*$/, "") + hashOf(model, store);
}

function hashOf(model: Model, store: Store): string {
  const { time, link, touch } = store.state;
  const name = link === null ? "" : model.avatars[link.avatar]?.links[link.link]?.name ?? "";
  return fragmentOf({ time: time - model.timeZero, link: name, object: touch?.object ?? "" });
}

function goTo(model: Model, store: Store, fragment: string): void {
  const address = addressFrom(fragment);
  if (address === null || model.isLive) return;
  const time = Math.min(model.end, Math.max(model.start, address.time + model.timeZero));
  const isMeant = (one: Contact | Touch): boolean =>
    one.linkName === address.link && (address.object === "" || one.object === address.object);
  const contact = model.contacts.find((one) => isMeant(one) && Math.abs(one.at - time) <= sameInstant);
  if (contact !== undefined) return chooseContact(store, model, contact);
  const touch = model.touches.find((one) => isMeant(one) && one.begin <= time + sameInstant && one.end >= time - sameInstant);
  if (touch !== undefined) chooseTouch(store, model, touch);
  store.set({ time, isPlaying: false, follows: false, ...(touch === undefined ? { touch: null, contact: null, link: linkNamed(model, address.link) } : {}) });
}

function linkNamed(model: Model, name: string): { avatar: number; link: number } | null {
  const avatar = model.avatars.findIndex(({ links }) => links.some((link) => link.name === name));
  return avatar < 0 ? null : { avatar, link: model.avatars[avatar].links.findIndex((link) => link.name === name) };
}
