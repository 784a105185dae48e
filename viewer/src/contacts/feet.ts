// Feet: how each of them stands, slides, sinks in or hovers, as bars beside those of touches.

import type { Avatar, FootStance, RecordedFoot } from "../data/document.js";
import type { Touch } from "./touch.js";
import { plainBar } from "./touch.js";

/** From here on a slide, or a depth, is told as one, metres: as `foretouch feet` does. */
export const told = 0.002;

export function isSlide({ slide }: FootStance): boolean {
  return slide >= told;
}

export function isDeep({ depth }: FootStance): boolean {
  return depth >= told;
}

/** What it is judged by, metres; what slides or sinks in before all that hovers, as `foretouch feet` has it. */
export function badness({ slide, depth, hover }: FootStance): number {
  const fault = Math.max(slide, depth);
  return fault >= told ? 1e3 + fault : Math.max(fault, hover);
}

/** As bars, by begin; they are no touches of links, and are not counted as such. */
export function stancesOf(feet: readonly RecordedFoot[], avatars: readonly Avatar[]): Touch[] {
  return feet.flatMap(({ link, stances }) => stances.map((stance): Touch => ({
    ...plainBar,
    link,
    linkName: avatars[0].links[link].name,
    object: "",
    begin: stance.begin,
    end: stance.end,
    begins: stance.beganBefore ? "inside" : "contact",
    ends: stance.goesOn ? "open" : "left",
    isGround: true,
    depth: stance.depth,
    stance,
  })));
}

/** Shorter, seconds, a foot kicks or brushes past: it does not stand. */
const shortestStand = 0.1;

export function stands({ begin, end }: FootStance): boolean {
  return end - begin >= shortestStand;
}

/** The worst first; of what slides or sinks in, what is over too soon to stand comes after what stands. */
export function byBadness(stances: readonly Touch[]): Touch[] {
  const isFault = (stance: FootStance): boolean => isSlide(stance) || isDeep(stance);
  const rank = ({ stance }: Touch): number => (stance === null ? 0 : badness(stance) + (isFault(stance) && stands(stance) ? 1e6 : 0));
  return [...stances].sort((a, b) => rank(b) - rank(a));
}

/** Of those that stand the one with the greatest of something; null where all have less than is told. */
export function worstBy(stances: readonly Touch[], of: (stance: FootStance) => number): Touch | null {
  return worstOf(stances.filter(({ stance }) => stance !== null && stands(stance)), of);
}

/** The same of all, also of a foot that only passes. */
export function worstOf(stances: readonly Touch[], of: (stance: FootStance) => number): Touch | null {
  let worst: Touch | null = null;
  for (const touch of stances) {
    if (touch.stance === null || of(touch.stance) < told) continue;
    if (worst?.stance == null || of(touch.stance) > of(worst.stance)) worst = touch;
  }
  return worst;
}
