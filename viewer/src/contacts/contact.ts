// The contacts of all avatars in one list, in order of time, with what the page needs beside the
// recorded fields.

import type { Avatar, ContactFields, RecordedContact, Verdict } from "../data/document.js";
import type { Clip, Span } from "../motion/clip.js";

export interface Contact extends ContactFields {
  /** Index into the page's avatars. */
  readonly avatar: number;
  /** Index into the avatar's contacts; -1 in a stream. */
  readonly row: number;
  readonly step: number;
  readonly linkName: string;
  /** When it is met; for an undecided one until when the link is free. Seconds. */
  readonly at: number;
  /** Of the step it belongs to. */
  readonly span: Span;
}

export const verdictNames: Record<Verdict, string> = {
  contact: "contact",
  starts_in_contact: "starts in contact",
  undecided: "undecided",
};

export function contactOf(
  avatar: number,
  linkName: string,
  span: Span,
  recorded: RecordedContact,
  row = -1,
): Contact {
  const u = recorded.toi ?? recorded.freeUntil ?? 0;
  // Rounding must not show a contact after its step; before it may lie one of a step that a stream
  // has not sent.
  const at = Math.min(span.t1, recorded.time ?? span.t0 + u * (span.t1 - span.t0));
  return { ...recorded, avatar, row, linkName, at, span };
}

/** In order of time; contacts of the same time keep the document's order. */
export function allContacts(avatars: readonly Avatar[], clips: readonly Clip[]): Contact[] {
  const contacts = avatars.flatMap((avatar, index) =>
    avatar.contacts.flatMap((recorded, row) => {
      const span = clips[index].spanOf(recorded.step);
      if (span === null) return [];
      return [contactOf(index, avatar.links[recorded.link].name, span, recorded, row)];
    }),
  );
  return contacts.sort((a, b) => a.at - b.at);
}

/** Index of the first contact later than `time`; the number of contacts where there is none. */
export function firstAfter(contacts: readonly Contact[], time: number): number {
  let low = 0, high = contacts.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (contacts[middle].at <= time) low = middle + 1;
    else high = middle;
  }
  return low;
}

/** Contacts that hold at `time`: from when they are met to before the end of their step. */
export function contactsAt(contacts: readonly Contact[], time: number, longestStep: number): Contact[] {
  const lit: Contact[] = [];
  for (let i = firstAfter(contacts, time) - 1; i >= 0; --i) {
    if (contacts[i].at < time - longestStep) break;
    if (contacts[i].span.t1 > time || contacts[i].at === time) lit.push(contacts[i]);
  }
  return lit;
}

/** Of the whole list: what contactsAt() has to look back over. */
export function longestStep(contacts: readonly Contact[]): number {
  return contacts.reduce((longest, c) => Math.max(longest, c.span.t1 - Math.min(c.at, c.span.t0)), 0);
}
