// Rows and windows of the timeline, without drawing: a row a link or an object, a bar a touch.

import { badness } from "../contacts/feet.js";
import type { Touch, Whose } from "../contacts/touch.js";
import { whose } from "../contacts/touch.js";
import type { Avatar } from "../data/document.js";
import { limbs, limbsOf, shortNames } from "../motion/limbs.js";

export const groupings = ["limb", "link", "object", "all"] as const;
/** Links with touches, by limb or in their order; objects; all links. */
export type Grouping = (typeof groupings)[number];

export interface Row {
  /** A heading stands for all rows up to the next heading. */
  readonly isHeading: boolean;
  readonly name: string;
  /** As the document has it. */
  readonly fullName: string;
  /** Of a heading: its group; of others the group that they are in. */
  readonly group: string;
  /** -1 where the row is none of a link. */
  readonly avatar: number;
  readonly link: number;
  /** In order of their begin. */
  readonly touches: readonly Touch[];
}

/** Of bodies of one link, and of triggers. */
const thingGroup = "things", triggerGroup = "triggers";
/** How feet stand: above all others. */
export const feetGroup = "feet on the ground";
/** What the person touched, not the model: below them. */
export const personGroup = "the person";

/** Without the rows of `folded` groups; `bounds` are those of the person. */
export function rowsOf(
  touches: readonly Touch[],
  avatars: readonly Avatar[],
  grouping: Grouping,
  folded: ReadonlySet<string>,
  bounds = "",
): Row[] {
  const of = (one: Whose): Touch[] => touches.filter((touch) => whose(touch) === one);
  if (grouping === "object") return rowsOfObjects(of("link"));
  const rows = rowsOfModel(of("link"), avatars, grouping, folded);
  if (grouping !== "limb") return rows;
  const person = withHeading(rowsOfPerson(of("person"), avatars), personGroup, folded, `${personGroup}, ${bounds}`);
  return [...withHeading(rowsOfFeet(of("foot")), feetGroup, folded), ...person, ...rows];
}

/** A row a link, in their order, body by body. */
function rowsOfPerson(touches: readonly Touch[], avatars: readonly Avatar[]): Row[] {
  const names = avatars.map(({ links, name }) => shortNames(links.map((link) => link.name)).map((short) => (avatars.length === 1 ? short : links.length === 1 ? name : `${name}: ${short}`)));
  const rows = [...gathered(touches, ({ avatar, link }) => `${avatar}:${link}`).values()].map((one) => rowOfGroup(one, names[one[0].avatar][one[0].link], personGroup));
  return rows.sort((a, b) => a.avatar - b.avatar || a.link - b.link);
}

/** Of touches of one link. */
function rowOfGroup(touches: readonly Touch[], name: string, group: string): Row {
  const [{ linkName, avatar, link }] = touches;
  return { isHeading: false, name, fullName: linkName, group, avatar, link, touches };
}

/** A row a foot, the one that slides farthest or is deepest first. */
function rowsOfFeet(stances: readonly Touch[]): Row[] {
  const worst = (touches: readonly Touch[]): number => touches.reduce((most, { stance }) => Math.max(most, stance === null ? 0 : badness(stance)), 0);
  return [...gathered(stances, ({ link }) => String(link)).values()].sort((a, b) => worst(b) - worst(a)).map((touches) => rowOfGroup(touches, touches[0].linkName, feetGroup));
}

function withHeading(members: readonly Row[], group: string, folded: ReadonlySet<string>, name = group): Row[] {
  if (members.length === 0) return [];
  const touches = members.flatMap((row) => row.touches).sort((a, b) => a.begin - b.begin);
  const heading: Row = { isHeading: true, name, fullName: name, group, avatar: -1, link: -1, touches };
  return folded.has(group) ? [heading] : [heading, ...members];
}

function rowsOfModel(touches: readonly Touch[], avatars: readonly Avatar[], grouping: Grouping, folded: ReadonlySet<string>): Row[] {
  const rows = rowsOfLinks(touches, avatars).filter((row) => grouping === "all" || row.touches.length > 0);
  return grouping === "limb" ? byGroup(rows, folded) : rows;
}

function gathered(touches: readonly Touch[], keyOf: (touch: Touch) => string): Map<string, Touch[]> {
  const groups = new Map<string, Touch[]>();
  for (const touch of touches) {
    const key = keyOf(touch), group = groups.get(key);
    if (group === undefined) groups.set(key, [touch]);
    else group.push(touch);
  }
  return groups;
}

function rowsOfObjects(touches: readonly Touch[]): Row[] {
  const groups = gathered(touches, ({ object }) => object);
  const rows = [...groups].map(([object, group]): Row => {
    const name = object === "" ? "(no name)" : object;
    return { isHeading: false, name, fullName: name, group: "", avatar: -1, link: -1, touches: group };
  });
  return rows.sort((a, b) => b.touches.length - a.touches.length);
}

function rowsOfLinks(touches: readonly Touch[], avatars: readonly Avatar[]): Row[] {
  // Who is in a trigger is told in the trigger's own row.
  const groups = gathered(touches, (touch) => touch.isStay ? `${touch.otherAvatar}:0` : `${touch.avatar}:${touch.link}`);
  return avatars.flatMap(({ links, name: body, outline }, avatar) => {
    const short = shortNames(links.map(({ name }) => name)), limbOf = limbsOf(links);
    const before = avatars.length > 1 ? `${body}: ` : "", isThing = avatars.length > 1 && links.length === 1;
    return links.map((one, link): Row => ({
      isHeading: false,
      name: isThing ? body : before + short[link],
      fullName: isThing ? body : before + one.name,
      group: outline !== null ? triggerGroup : isThing ? thingGroup : before + limbOf[link],
      avatar,
      link,
      touches: groups.get(`${avatar}:${link}`) ?? [],
    }));
  });
}

function byGroup(rows: readonly Row[], folded: ReadonlySet<string>): Row[] {
  const groups = [...new Set(rows.map(({ group }) => group))];
  const place = (group: string): number => limbs.findIndex((limb) => group.endsWith(limb));
  const bodyOf = (group: string): string => group.slice(0, group.length - (limbs[place(group)] ?? "").length);
  const isLast = (group: string): number => (group === triggerGroup ? 2 : group === thingGroup ? 1 : 0);
  groups.sort((a, b) => isLast(a) - isLast(b) || bodyOf(a).localeCompare(bodyOf(b)) || place(a) - place(b));
  return groups.flatMap((group) => withHeading(rows.filter((row) => row.group === group), group, folded));
}

/** How many touches are under way in each of `bins` parts of the window. */
export function densityOf(touches: readonly Touch[], { t0, t1 }: Window, bins: number): Float32Array {
  const density = new Float32Array(bins), perSecond = bins / Math.max(1e-9, t1 - t0);
  const binOf = (time: number): number => Math.min(bins - 1, Math.max(0, Math.floor((time - t0) * perSecond)));
  for (const { begin, end } of touches) for (let bin = binOf(begin); bin <= binOf(end); ++bin) ++density[bin];
  return density;
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

/** The touch of a row whose bar is nearest to `time`, if it is within `reach` seconds; the shorter of two that are met. */
export function nearestTouch(row: Row, time: number, reach: number): Touch | null {
  let best: Touch | null = null, bestDistance = reach;
  for (const touch of row.touches) {
    const distance = Math.max(touch.begin - time, time - touch.end, 0);
    const isShorter = best !== null && distance === bestDistance && touch.end - touch.begin < best.end - best.begin;
    if (distance < bestDistance || isShorter || (distance === 0 && best === null)) [best, bestDistance] = [touch, distance];
  }
  return best;
}
