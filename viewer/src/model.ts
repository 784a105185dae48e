// The document and what is derived from it, in one place: what all views look at.

import type { Avatar, PersonTouch, RecordedPerson, ViewDocument } from "./data/document.js";
import type { Contact } from "./contacts/contact.js";
import { allContacts, longestStep } from "./contacts/contact.js";
import { stancesOf } from "./contacts/feet.js";
import { personTouchesOf } from "./contacts/person.js";
import type { Touch, TouchCount } from "./contacts/touch.js";
import { countTouches, matches, mergedTouches, recordedStays, recordedTouches, touchOfRow } from "./contacts/touch.js";
import type { Clip } from "./motion/clip.js";
import type { Place } from "./motion/placing.js";
import { placeFrom } from "./motion/placing.js";
import { CarriedClip } from "./motion/carried_clip.js";
import { RecordedClip } from "./motion/recorded_clip.js";
import { LiveClip } from "./live/live_clip.js";

const secondsOfDay = 86400;

export class Model {
  private readonly avatarList: Avatar[];
  private readonly clipList: Clip[];
  private readonly trackedList: (Clip | null)[];
  private contactList: Contact[];
  private touchList: Touch[];
  /** Touches, and who is in triggers: by begin. */
  private barList: readonly Touch[];
  /** How feet stand, as bars; by foot, then by begin. */
  readonly stances: readonly Touch[];
  private personBars: readonly Touch[];
  private recordedPerson: RecordedPerson | null;
  private touchOfContact = new Map<Contact, Touch>();
  private shown: { search: string; showsGround: boolean; of: readonly Touch[]; touches: readonly Touch[] } | null = null;
  private longest: number;
  private zero: number | null = null;

  constructor(readonly document: ViewDocument) {
    this.avatarList = [...document.avatars];
    this.clipList = clipsOf(document.avatars);
    this.trackedList = document.avatars.map(trackedOf);
    this.contactList = allContacts(this.avatars, this.clips);
    this.touchList = this.touchesOf(this.contactList);
    this.stances = stancesOf(document.feet, document.avatars);
    this.recordedPerson = document.person;
    this.personBars = personTouchesOf(document.person, document.avatars);
    this.barList = this.barsOf();
    this.longest = longestStep(this.contactList);
  }

  get avatars(): readonly Avatar[] {
    return this.avatarList;
  }

  /** One an avatar. */
  get clips(): readonly Clip[] {
    return this.clipList;
  }

  /** One an avatar: of a solid one where its tracker says that it is, null of others. */
  get tracked(): readonly (Clip | null)[] {
    return this.trackedList;
  }

  /** What the person touched, not the model; null where nobody asked. */
  get person(): RecordedPerson | null {
    return this.recordedPerson;
  }

  /** The same as bars. */
  get personTouches(): readonly Touch[] {
    return this.personBars;
  }

  /** Of a stream, which goes on. */
  replacePerson(touches: readonly PersonTouch[]): void {
    if (this.recordedPerson === null) return;
    this.recordedPerson = { ...this.recordedPerson, touches };
    this.personBars = personTouchesOf(this.recordedPerson, this.avatarList);
    this.barList = this.barsOf();
  }

  get isSolid(): boolean {
    return this.trackedList.some((clip) => clip !== null);
  }

  /** Takes those whose id is new, after those that are known; whether there were any. */
  join(avatars: readonly Avatar[]): boolean {
    const fresh = avatars.filter(({ id }) => this.avatarList.every((known) => known.id !== id));
    this.avatarList.push(...fresh);
    this.clipList.push(...fresh.map(clipOf));
    this.trackedList.push(...fresh.map(trackedOf));
    return fresh.length > 0;
  }

  get isLive(): boolean {
    return this.document.kind === "live";
  }

  /** In order of time. */
  get contacts(): readonly Contact[] {
    return this.contactList;
  }

  /** In order of their begin. */
  get touches(): readonly Touch[] {
    return this.touchList;
  }

  /** False for documents that have but contacts, each of which then stands for itself. */
  get knowsTouches(): boolean {
    return this.isLive || this.document.touches !== null;
  }

  /** Bodies: nobody touches a trigger. */
  get bodies(): readonly Avatar[] {
    return this.avatarList.filter(({ outline }) => outline === null);
  }

  private barsOf(): readonly Touch[] {
    const stays = recordedStays(this.document.stays, this.avatarList);
    const more = [...stays, ...this.stances, ...this.personTouches];
    return more.length === 0 ? this.touchList : [...this.touchList, ...more].sort((a, b) => a.begin - b.begin);
  }

  /** Of touches and of who is in triggers those that a search and the choice of the ground leave. */
  shownTouches(search: string, showsGround: boolean): readonly Touch[] {
    const { shown } = this;
    if (shown !== null && shown.search === search && shown.showsGround === showsGround && shown.of === this.barList) return shown.touches;
    const isAll = search.trim() === "" && showsGround;
    const touches = isAll ? this.barList : this.barList.filter((touch) => (showsGround || !touch.isGround) && matches(touch, search.trim()));
    this.shown = { search, showsGround, of: this.barList, touches };
    return touches;
  }

  countTouches(): TouchCount {
    return countTouches(this.touchList);
  }

  /** The nearest frame of the clip, from 0; null where no frames are known. */
  frameAt(time: number): number | null {
    const { frameTime } = this.document;
    return frameTime === null ? null : Math.round(time / frameTime);
  }

  /** The touch that a contact is a row of. */
  touchOf(contact: Contact): Touch | null {
    if (this.touchOfContact.size === 0) {
      for (const touch of this.touchList) for (const row of touch.rows) this.touchOfContact.set(row, touch);
    }
    return this.touchOfContact.get(contact) ?? null;
  }

  private touchesOf(contacts: readonly Contact[]): Touch[] {
    const { touches } = this.document;
    this.touchOfContact = new Map();
    if (this.isLive) return mergedTouches(contacts);
    return touches === null ? contacts.map(touchOfRow) : recordedTouches(touches, this.avatars, contacts);
  }

  replaceContacts(contacts: Contact[]): void {
    this.contactList = contacts;
    this.touchList = this.touchesOf(contacts);
    this.barList = this.barsOf();
    this.longest = longestStep(contacts);
  }

  get longestStep(): number {
    return this.longest;
  }

  /** Where the clip stands now, as the document's settings say. */
  get place(): Place {
    return placeFrom(this.document.settings.find(({ name }) => name === "placed at")?.value ?? "");
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

/** Whoever is carried goes along with who carries it. */
function clipsOf(avatars: readonly Avatar[]): Clip[] {
  const clips: Clip[] = [];
  avatars.forEach((avatar, i) => {
    const own = clipOf(avatar);
    clips[i] = avatar.carried.length === 0 ? own : new CarriedClip(own, avatar.carried, clips);
  });
  return clips;
}

function trackedOf(avatar: Avatar): Clip | null {
  if (avatar.isLiveSolid) return new LiveClip(avatar.links);
  return avatar.tracked === null ? null : new RecordedClip(avatar.links, avatar.tracked);
}
