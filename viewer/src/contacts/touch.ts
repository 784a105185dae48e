// Touches: a link and an object from their first contact to where it ends, over all steps. The
// contacts of the single steps are the rows of a touch.

import type { Avatar, FootStance, PersonTouch, RecordedStay, RecordedTouch, Strength } from "../data/document.js";
import type { Contact } from "./contact.js";

export interface Touch {
  readonly avatar: number;
  readonly link: number;
  readonly linkName: string;
  /** "" where it is not known. */
  readonly object: string;
  readonly isOwn: boolean;
  /** Whom else it touches: an index into the page's avatars; null where that is the scene or itself. */
  readonly otherAvatar: number | null;
  readonly begin: number;
  readonly end: number;
  readonly begins: "contact" | "inside";
  readonly ends: "left" | "open";
  readonly isGround: boolean;
  /** A check of the poses alone sees nothing of it; null where nobody looked. */
  readonly isMissed: boolean | null;
  /** Nothing is claimed of the two: it is no touch. */
  readonly isUndecided: boolean;
  /** In order of time; those that the document carries. */
  readonly rows: readonly Contact[];
  /** Where it begins; null where nobody looked. */
  readonly strength: Strength | null;
  /** Somebody is in a trigger: it is no touch. */
  readonly isStay: boolean;
  /** The deepest that it is known to be, metres; null where it is not known. */
  readonly depth: number | null;
  /** Of a whole foot: how it stands. It is no touch of a link. */
  readonly stance: FootStance | null;
  /** Of the person: how sure it is, and of what. It is no touch of the model. */
  readonly person: PersonTouch | null;
}

/** Whose a bar is: the model's link, a whole foot, or the person. */
export type Whose = "link" | "foot" | "person";

export function whose({ stance, person }: Touch): Whose {
  return stance !== null ? "foot" : person !== null ? "person" : "link";
}

/** What bars of which no contact is a row have in common. */
export const plainBar = {
  avatar: 0,
  isOwn: false,
  otherAvatar: null,
  isGround: false,
  isMissed: null,
  isUndecided: false,
  rows: [],
  strength: null,
  isStay: false,
  depth: null,
  stance: null,
  person: null,
} as const;

/** Of the document, in its order: by begin. `contacts` as allContacts() has them. */
export function recordedTouches(
  recorded: readonly RecordedTouch[],
  avatars: readonly Avatar[],
  contacts: readonly Contact[],
): Touch[] {
  const byRow = new Map(contacts.map((contact) => [`${contact.avatar}:${contact.row}`, contact]));
  const touches = recorded.map((touch): Touch => {
    const rows = touch.rows.flatMap((row) => byRow.get(`${touch.avatar}:${row}`) ?? []);
    return {
      ...touch,
      rows,
      linkName: avatars[touch.avatar].links[touch.link].name,
      isOwn: touch.other !== null && touch.otherAvatar === null,
      isUndecided: touch.unresolved !== null,
      isStay: false,
      stance: null,
      person: null,
    };
  });
  return touches.sort((a, b) => a.begin - b.begin);
}

/** Who is in triggers, as bars. */
export function recordedStays(stays: readonly RecordedStay[], avatars: readonly Avatar[]): Touch[] {
  return stays.map((stay): Touch => ({
    ...plainBar,
    avatar: stay.avatar,
    link: stay.link,
    linkName: avatars[stay.avatar].name,
    object: avatars[stay.trigger].name,
    otherAvatar: stay.trigger,
    begin: stay.begin,
    end: stay.end,
    begins: stay.begins === "inside" ? "inside" : "contact",
    ends: stay.ends,
    isUndecided: stay.isUnresolved,
    isStay: true,
  }));
}

/** Where a document knows no touches, each contact is one. */
export function touchOfRow(contact: Contact): Touch {
  return {
    avatar: contact.avatar,
    link: contact.link,
    linkName: contact.linkName,
    object: contact.object ?? "",
    isOwn: false,
    otherAvatar: contact.otherAvatar,
    begin: contact.at,
    end: contact.span.t1,
    begins: contact.verdict === "starts_in_contact" ? "inside" : "contact",
    ends: "left",
    isGround: false,
    isMissed: contact.verdict === "contact" ? contact.missedByPoses : null,
    isUndecided: contact.verdict === "undecided",
    rows: [contact],
    strength: null,
    isStay: false,
    depth: contact.penetration,
    stance: null,
    person: null,
  };
}

/**
 * Of a stream: contacts of one link and one object in steps that follow each other are one touch
 * if each of them but the first starts in contact. `contacts` in order of time.
 */
export function mergedTouches(contacts: readonly Contact[]): Touch[] {
  const touches: Grown[] = [], latest = new Map<string, Grown>();
  for (const contact of contacts) {
    const key = `${contact.avatar}:${contact.link}:${contact.object ?? ""}`;
    const known = latest.get(key);
    const isNext = known !== undefined && contact.verdict === "starts_in_contact" && contact.step - known.lastStep <= 1;
    const touch = isNext ? known : { ...touchOfRow(contact), rows: [], lastStep: contact.step };
    if (!isNext) {
      touches.push(touch);
      latest.set(key, touch);
    }
    touch.rows.push(contact);
    touch.end = contact.span.t1;
    touch.lastStep = contact.step;
    touch.depth = Math.max(touch.depth ?? 0, contact.penetration ?? 0);
  }
  return touches;
}

/** A touch while its rows are gathered. */
interface Grown extends Touch {
  end: number;
  depth: number | null;
  rows: Contact[];
  lastStep: number;
}

/** Index of the first touch that begins later than `time`; their number where there is none. */
export function firstTouchAfter(touches: readonly Touch[], time: number): number {
  let low = 0, high = touches.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (touches[middle].begin <= time) low = middle + 1;
    else high = middle;
  }
  return low;
}

/** What a person looks for: every word occurs in the name of the link or of the object. */
export function matches(touch: Touch, search: string): boolean {
  const names = `${touch.linkName} ${touch.object}`.toLowerCase();
  return search.toLowerCase().split(/\s+/).every((word) => names.includes(word));
}

export interface TouchCount {
  /** Without the ground. */
  readonly all: number;
  /** Of these. */
  readonly missed: number;
  readonly ground: number;
}

/** As the program counts: touches of own links are another question, and the ground is counted apart. */
export function countTouches(touches: readonly Touch[]): TouchCount {
  const ofScene = touches.filter((touch) => !touch.isOwn && !touch.isStay && whose(touch) === "link" && (!touch.isUndecided || touch.rows.length > 0));
  const met = ofScene.filter((touch) => !touch.isGround);
  return {
    all: met.length,
    missed: met.filter((touch) => touch.isMissed === true).length,
    ground: ofScene.length - met.length,
  };
}
