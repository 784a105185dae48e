// The document and what is derived from it, in one place: what all views look at.

import type { Avatar, ViewDocument } from "./data/document.js";
import type { Contact } from "./contacts/contact.js";
import { allContacts, longestStep } from "./contacts/contact.js";
import type { Clip } from "./motion/clip.js";
import { RecordedClip } from "./motion/recorded_clip.js";
import { LiveClip } from "./live/live_clip.js";

const secondsOfDay = 86400;

export class Model {
  private readonly avatarList: Avatar[];
  private readonly clipList: Clip[];
  private contactList: Contact[];
  private longest: number;
  private zero: number | null = null;

  constructor(readonly document: ViewDocument) {
    this.avatarList = [...document.avatars];
    this.clipList = document.avatars.map(clipOf);
    this.contactList = allContacts(this.avatars, this.clips);
    this.longest = longestStep(this.contactList);
  }

  get avatars(): readonly Avatar[] {
    return this.avatarList;
  }

  /** One an avatar. */
  get clips(): readonly Clip[] {
    return this.clipList;
  }

  /** Takes those whose id is new, after those that are known; whether there were any. */
  join(avatars: readonly Avatar[]): boolean {
    const fresh = avatars.filter(({ id }) => this.avatarList.every((known) => known.id !== id));
    this.avatarList.push(...fresh);
    this.clipList.push(...fresh.map(clipOf));
    return fresh.length > 0;
  }

  get isLive(): boolean {
    return this.document.kind === "live";
  }

  /** In order of time. */
  get contacts(): readonly Contact[] {
    return this.contactList;
  }

  replaceContacts(contacts: Contact[]): void {
    this.contactList = contacts;
    this.longest = longestStep(contacts);
  }

  get longestStep(): number {
    return this.longest;
  }

  /** Of all clips that have poses; 0 where none has. */
  get start(): number {
    return this.extreme((clip) => clip.start, Math.min);
  }

  get end(): number {
    return this.extreme((clip) => clip.end, Math.max);
  }

  /** What times are shown relative to: 0, or the first whole second where a clock counts from 1970. */
  get timeZero(): number {
    if (this.zero === null && this.clips.some((clip) => clip.hasPose)) {
      this.zero = Math.abs(this.start) > secondsOfDay ? Math.floor(this.start) : 0;
    }
    return this.zero ?? 0;
  }

  private extreme(of: (clip: Clip) => number, choose: (...values: number[]) => number): number {
    const values = this.clips.filter((clip) => clip.hasPose).map(of);
    return values.length === 0 ? 0 : choose(...values);
  }
}

function clipOf(avatar: Avatar): Clip {
  return avatar.track === null ? new LiveClip(avatar.links) : new RecordedClip(avatar.links, avatar.track);
}
