// The person: what they surely touched and what perhaps, as bars beside those of the model's touches.

import type { Avatar, PersonTouch, RecordedPerson } from "../data/document.js";
import type { Touch } from "./touch.js";
import { plainBar } from "./touch.js";

/** As bars, from when on it is possible until when; they are no touches of the model, and are not counted as such. */
export function personTouchesOf(person: RecordedPerson | null, avatars: readonly Avatar[]): Touch[] {
  return (person?.touches ?? []).map((touch): Touch => ({
    ...plainBar,
    avatar: touch.avatar,
    link: touch.link,
    linkName: avatars[touch.avatar].links[touch.link].name,
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

/** Two steps meet to within this, seconds. */
const sameInstant = 1e-6;

/** Those of the next steps as well: what is possible where a step ends and where the next one begins is one touch. */
export function joinedPerson(known: readonly PersonTouch[], fresh: readonly PersonTouch[]): PersonTouch[] {
  const joined = [...known];
  for (const touch of fresh) {
    const isSame = (one: PersonTouch): boolean => one.avatar === touch.avatar && one.link === touch.link && one.isOwn === touch.isOwn && (!one.isOwn || one.object === touch.object);
    const at = joined.findIndex((one) => isSame(one) && Math.abs(one.end - touch.begin) <= sameInstant);
    if (at < 0) joined.push(touch);
    else joined[at] = both(joined[at], touch);
  }
  return joined.sort((a, b) => a.begin - b.begin);
}

function both(earlier: PersonTouch, later: PersonTouch): PersonTouch {
  const { certain } = earlier, { certain: more } = later;
  return {
    ...earlier,
    end: later.end,
    goesOn: later.goesOn,
    certain: certain === null || more === null ? (certain ?? more) : { from: certain.from, to: more.to },
    growth: Math.max(earlier.growth ?? 0, later.growth ?? 0),
  };
}
