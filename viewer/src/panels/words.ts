// Numbers as people read them.

import type { Contact } from "../contacts/contact.js";
import type { Vector, Verdict } from "../data/document.js";

export function seconds(value: number): string {
  return `${value.toFixed(3)} s`;
}

/** Three digits turn more than this into 1000: the next unit's. */
const roundsUp = 0.9995;

/** Metres, or the unit that leaves few zeros. */
export function length(metres: number): string {
  const size = Math.abs(metres);
  if (size === 0) return "0";
  if (size < 1e-6) return `${metres.toExponential(1)} m`;
  if (size < roundsUp * 1e-3) return `${(metres * 1e6).toPrecision(3)} µm`;
  if (size < 0.1) return `${(metres * 1e3).toPrecision(3)} mm`;
  return `${metres.toPrecision(4)} m`;
}

export function microseconds(value: number): string {
  if (value >= roundsUp * 1e6) return `${(value / 1e6).toPrecision(3)} s`;
  if (value >= roundsUp * 1e3) return `${(value / 1e3).toPrecision(3)} ms`;
  return `${value.toPrecision(3)} µs`;
}

export function vector(v: Vector, digits = 4): string {
  return v.map((value) => value.toFixed(digits).replace(/^-(?=[0.]*$)/, "").replace("-", "−")).join(", ");
}

const counts = new Intl.NumberFormat("en-GB");

export function count(value: number): string {
  return counts.format(value);
}

export function plural(value: number, one: string, many = `${one}s`): string {
  return `${count(value)} ${value === 1 ? one : many}`;
}

/** One sentence or two that say what happened. */
export function story(contact: Contact, timeZero: number): string {
  const object = contact.object ?? "the scene";
  const at = seconds(contact.at - timeZero);
  const from = seconds(contact.span.t0 - timeZero), to = seconds(contact.span.t1 - timeZero);
  if (contact.verdict === "undecided") {
    return `${contact.linkName} is proven free until ${at}; what follows up to ${to} was not decided.`;
  }
  if (contact.verdict === "starts_in_contact") {
    return `${contact.linkName} is in contact with ${object} when the step begins, at ${from}.`;
  }
  const touch = `${contact.linkName} meets ${object} at ${at}.`;
  if (contact.missedByPoses !== true) return `${touch} The step goes from ${from} to ${to}.`;
  const isAtPose = at === from || at === to;
  if (isAtPose && (contact.separation ?? 0) > 0) return `${nearPose(contact, object, at, at === from)} At both poses, ${from} and ${to}, a gap is left: ${unseen}.`;
  return `${touch} At both poses, ${from} and ${to}, it touches nothing: ${unseen}.`;
}

const unseen = "a check at the poses sees no contact";

/** Met at a pose itself, as far as digits show: what is met is the tolerance, not the surface. */
function nearPose({ linkName, separation }: Contact, object: string, at: string, isAfter: boolean): string {
  const side = isAfter ? "right after" : "right before";
  return `${linkName} comes within ${length(separation ?? 0)} of ${object} ${side} the pose at ${at}: near enough to count as a contact.`;
}

/** How many there are of each verdict. */
export function tally(contacts: readonly Contact[]): string {
  const counted = (verdict: Verdict): number => contacts.filter((contact) => contact.verdict === verdict).length;
  const starts = counted("starts_in_contact"), undecided = counted("undecided");
  const parts = [plural(counted("contact"), "contact")];
  if (starts > 0) parts.push(plural(starts, "start in contact", "starts in contact"));
  if (undecided > 0) parts.push(`${count(undecided)} undecided`);
  return parts.join(", ");
}
