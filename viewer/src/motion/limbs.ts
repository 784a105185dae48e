// What part of a body a link belongs to, by its name; and names without what all of them begin with.

import type { Link } from "../data/document.js";

export const limbs = ["trunk", "left arm", "right arm", "left leg", "right leg"] as const;
export type Limb = (typeof limbs)[number];

const arm = /arm|hand|finger|thumb|index|middle|ring|pinky|little|elbow|wrist|clavicle|collar|shoulder|palm/;
const leg = /leg|foot|feet|toe|knee|ankle|thigh|calf|shin|hip(?!s)|upleg/;
const left = /left|^[lL](?=[A-Z][a-z]|[_. ])|[_. ][lL]$|[_. ][lL][_. ]/;
const right = /right|^[rR](?=[A-Z][a-z]|[_. ])|[_. ][rR]$|[_. ][rR][_. ]/;

/** By link. One whose name says nothing belongs where its parent does. */
export function limbsOf(links: readonly Link[]): Limb[] {
  const found: Limb[] = [];
  for (const { name, parent } of links) found.push(limbNamed(name) ?? found[parent] ?? "trunk");
  return found;
}

function limbNamed(name: string): Limb | null {
  const words = name.toLowerCase();
  const isOf = (side: RegExp): boolean => side.test(words) || side.test(name);
  const side = isOf(left) ? "left" : isOf(right) ? "right" : null;
  if (side === null) return /hips|pelvis|spine|chest|torso|neck|head|body|abdomen/.test(words) ? "trunk" : null;
  if (arm.test(words)) return `${side} arm`;
  return leg.test(words) ? `${side} leg` : null;
}

/** Up to the last sign that parts names: "mixamorig:". Shorter names of their own stay whole. */
const parting = /^.*[:|]|^[A-Za-z0-9]+_(?=[A-Z])/;

/** Names without the beginning that most of them share. */
export function shortNames(names: readonly string[]): string[] {
  const prefixes = new Map<string, number>();
  for (const name of names) {
    const prefix = parting.exec(name)?.[0] ?? "";
    if (prefix !== "") prefixes.set(prefix, (prefixes.get(prefix) ?? 0) + 1);
  }
  const shared = [...prefixes].filter(([, count]) => count > names.length / 2).map(([prefix]) => prefix);
  return names.map((name) => {
    const prefix = shared.find((one) => name.startsWith(one) && name.length > one.length);
    return prefix === undefined ? name : name.slice(prefix.length);
  });
}
