// Rows and bars of the timeline, without drawing: a row a link with contacts, a bar a contact.

import type { Contact } from "../contacts/contact.js";
import type { Avatar } from "../data/document.js";

export interface Row {
  readonly avatar: number;
  readonly link: number;
  readonly name: string;
  /** In order of time. */
  readonly contacts: readonly Contact[];
}

/** In the order of avatars and their links. */
export function rowsOf(contacts: readonly Contact[], avatars: readonly Avatar[]): Row[] {
  const byLink = new Map<string, Contact[]>();
  for (const contact of contacts) {
    const key = `${contact.avatar}:${contact.link}`;
    const row = byLink.get(key);
    if (row === undefined) byLink.set(key, [contact]);
    else row.push(contact);
  }
  const rows = [...byLink.values()].map((row): Row => {
    const { avatar, link, linkName } = row[0];
    const name = avatars.length > 1 ? `${avatars[avatar].name}: ${linkName}` : linkName;
    return { avatar, link, name, contacts: row };
  });
  return rows.sort((a, b) => a.avatar - b.avatar || a.link - b.link);
}

/** The times that the timeline shows, and where on its width. */
export interface Window {
  readonly t0: number;
  readonly t1: number;
}

/** Shortest window, seconds: below it nothing more is to be seen. */
const shortest = 1e-3;

/** `factor` below 1 comes closer; `anchor` stays where it is; all of it stays within `whole`. */
export function zoomed(window: Window, factor: number, anchor: number, whole: Window): Window {
  const length = Math.max(shortest, (window.t1 - window.t0) * factor);
  const share = window.t1 > window.t0 ? (anchor - window.t0) / (window.t1 - window.t0) : 0.5;
  return kept(anchor - share * length, length, whole);
}

export function moved(window: Window, by: number, whole: Window): Window {
  return kept(window.t0 + by, window.t1 - window.t0, whole);
}

function kept(t0: number, length: number, whole: Window): Window {
  if (length >= whole.t1 - whole.t0) return whole;
  const start = Math.min(Math.max(t0, whole.t0), whole.t1 - length);
  return { t0: start, t1: start + length };
}

/** Round times between `t0` and `t1`, at most about `most` of them. */
export function ticks({ t0, t1 }: Window, most: number): { readonly times: number[]; readonly digits: number } {
  const rough = Math.max(1e-6, (t1 - t0) / Math.max(1, most));
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= rough * 0.999) ?? 10 * power;
  const times: number[] = [];
  for (let i = Math.ceil(t0 / step - 1e-9); i * step <= t1 + 1e-9 * step; ++i) times.push(i * step);
  return { times, digits: Math.max(0, Math.min(6, Math.ceil(-Math.log10(step) - 1e-9))) };
}

/** The contact of a row whose bar is nearest to `time`, if it is within `reach` seconds. */
export function nearestContact(row: Row, time: number, reach: number): Contact | null {
  let best: Contact | null = null, bestDistance = reach;
  for (const contact of row.contacts) {
    const distance = Math.max(contact.at - time, time - contact.span.t1, 0);
    if (distance < bestDistance || (distance === 0 && best === null)) [best, bestDistance] = [contact, distance];
  }
  return best;
}
