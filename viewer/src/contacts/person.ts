// The person: what they surely touched and what perhaps, as bars beside those of the model's touches.

import type { Avatar, RecordedPerson } from "../data/document.js";
import type { Touch } from "./touch.js";
import { plainBar } from "./touch.js";

/** As bars, from when on it is possible until when; they are no touches of the model, and are not counted as such. */
export function personTouchesOf(person: RecordedPerson | null, avatars: readonly Avatar[]): Touch[] {
  return (person?.touches ?? []).map((touch): Touch => ({
    ...plainBar,
    link: touch.link,
    linkName: avatars[0].links[touch.link].name,
    object: touch.object,
    isOwn: touch.isOwn,
    begin: touch.begin,
    end: touch.end,
    begins: touch.beganBefore ? "inside" : "contact",
    ends: touch.goesOn ? "open" : "left",
    person: touch,
  }));
}

export interface PersonCount {
  readonly certain: number;
  readonly possible: number;
}

export function countPerson({ touches }: RecordedPerson): PersonCount {
  const certain = touches.filter((touch) => touch.certain !== null).length;
  return { certain, possible: touches.length - certain };
}
