// Numbers as people read them.

import type { Contact } from "../contacts/contact.js";
import { isDeep, isSlide } from "../contacts/feet.js";
import type { Touch } from "../contacts/touch.js";
import type { FootStance, PersonTouch, Strength, Vector, Verdict } from "../data/document.js";
import type { RayHit } from "../state.js";

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

/** What people call who moves, and where: other names of files make no sentence ("the walk touches"). */
const persons = /^([a-z]*(er|man|woman|girl|boy|robot|person|body|figure|avatar|fox|hero|guy|arm))$/i;
const places = /^(room|kitchen|office|dungeon|city|hall|house|flat|garden|cell|tunnel|street|stairs|level|lab|studio|shop|gym|stage)$/i;

/** A file's name as a word of a sentence: "dancer" of "dancer.avatar.json". */
export function personOf(fileName: string): string {
  return wordOf(fileName, persons) ?? "body";
}

/** As personOf(): "room" of "room.obj". */
export function placeOf(fileName: string): string {
  return wordOf(fileName, places) ?? "scene";
}

function wordOf(fileName: string, kind: RegExp): string | null {
  const words = fileName.split(".")[0].split(/[_\- ]/).filter((word) => kind.test(word));
  return words[0]?.toLowerCase() ?? null;
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
  const met = `${contact.linkName} meets ${object} at ${at}.`;
  if (contact.missedByPoses !== true) return `${met} The step goes from ${from} to ${to}.`;
  const isAtPose = at === from || at === to;
  if (isAtPose && (contact.separation ?? 0) > 0) return `${nearPose(contact, object, at, at === from)} At both poses, ${from} and ${to}, a gap is left: ${unseen}.`;
  return `${met} At both poses, ${from} and ${to}, it touches nothing: ${unseen}.`;
}

/** What the ray through a click met, the nearest first. */
export function storyOfRay(ray: RayHit, timeZero: number): string {
  const { link, linkDistance, object, objectDistance } = ray;
  const begin = `At ${seconds(ray.time - timeZero)} the ray through the pointer`;
  const away = (name: string, distance: number): string => `${name} after ${length(distance)}`;
  if (link === null) return object === null ? `${begin} meets nothing.` : `${begin} meets ${away(object, objectDistance)}.`;
  if (object === null) return `${begin} meets ${away(link, linkDistance)}.`;
  if (linkDistance <= objectDistance) return `${begin} meets ${away(link, linkDistance)}, and ${away(object, objectDistance)}.`;
  return `${begin} meets ${away(object, objectDistance)}, and ${away(link, linkDistance)} behind it.`;
}

/** Of a touch over several steps: from when to when. */
export function storyOfTouch(touch: Touch, timeZero: number): string {
  const object = touch.object === "" ? "the scene" : touch.object;
  const from = seconds(touch.begin - timeZero), to = seconds(touch.end - timeZero);
  if (touch.stance !== null) return `${touch.linkName} ${touch.stance.kind === "hovers" ? "rests" : "touches the ground"} from ${from} to ${to}: ${linesOfStance(touch.stance).join(", ")}.`;
  if (touch.person !== null) return storyOfPerson(touch.linkName, touch.person, timeZero);
  if (touch.isStay) return touch.isUndecided ? `It is not known whether ${touch.linkName} is in ${object} from ${from} to ${to}.` : `${touch.linkName} is in ${object} from ${from} to ${to}${touch.ends === "open" ? ", and still when the clip ends" : ""}.`;
  if (touch.isUndecided && touch.rows.length === 0) return `Nothing is claimed of ${touch.linkName} and ${object} from ${from} to ${to}.`;
  const begins = touch.begins === "inside" ? `touches ${object} already at ${from}` : `touches ${object} from ${from}`;
  const ends = touch.ends === "open" ? ", and still when the clip ends" : ` to ${to}`;
  const fate = touch.isMissed === true ? " No pose lies in between: a check of the poses misses it." : "";
  const deep = (touch.depth ?? 0) > 0 ? `, and is at most ${length(touch.depth ?? 0)} deep in it` : "";
  return `${touch.linkName} ${begins}${ends}${deep}.${fate}`;
}

/** Of a foot: how far it slides, how deep it is, or how high it hovers. */
export function linesOfStance(stance: FootStance): string[] {
  if (stance.kind === "hovers") return [`hovers ${millimetres(stance.hover)} above the ground`];
  const lines = [isSlide(stance) ? `its ${stance.slides} slides ${millimetres(stance.slide)}` : "it does not slide"];
  if (isDeep(stance)) lines.push(`its ${stance.deepest} is ${millimetres(stance.depth)} deep in the ground`);
  return stance.kind === "under" ? [...lines, "in between it is below the ground"] : lines;
}

function storyOfPerson(linkName: string, person: PersonTouch, timeZero: number): string {
  const [first, ...more] = linesOfPerson(person, timeZero);
  return `${linkName} ${first}${more.length === 0 ? "" : `: ${more.join(", ")}`}.`;
}

/** Of the person: that they surely touched something, and between when it began and ended; or that they may have. */
export function linesOfPerson(person: PersonTouch, timeZero: number): string[] {
  const what = person.object === "" ? "something" : person.object, when = whenOfPerson(person, timeZero);
  if (when.length === 1) return [`may have touched ${what} ${when[0]}`];
  return [`surely touched ${what}`, `${person.beganBefore ? "had begun" : "began"} ${when[0]}`, `ended ${when[1]}`];
}

/** When it began and when it ended, if it is certain; else when it may have been. */
export function whenOfPerson({ begin, end, certain, beganBefore, goesOn }: PersonTouch, timeZero: number): [string, string] | [string] {
  const from = begin - timeZero, to = end - timeZero;
  if (certain === null) return [beganBefore ? (goesOn ? "at any time" : `up to ${seconds(to)}`) : goesOn ? `from ${seconds(from)} on` : within(from, to)];
  const begun = certain.from - timeZero, ended = certain.to - timeZero;
  return [beganBefore ? `by ${seconds(begun)}` : within(from, begun), goesOn ? `not before ${seconds(ended)}` : within(ended, to)];
}

/** "between 2.314 and 2.316 s". */
function within(from: number, to: number): string {
  return from.toFixed(3) === to.toFixed(3) ? `at ${seconds(to)}` : `between ${from.toFixed(3)} and ${seconds(to)}`;
}

/** With a tenth: as `foretouch feet` says them. */
export function millimetres(metres: number): string {
  return `${(1e3 * metres).toFixed(1)} mm`;
}

/** "frames 12 to 40", or the seconds where no frames are known. */
export function framesOf(model: { frameAt(time: number): number | null; readonly timeZero: number }, { begin, end }: Touch): string {
  const from = model.frameAt(begin), to = model.frameAt(end);
  if (from === null || to === null) return `${seconds(begin - model.timeZero)} to ${seconds(end - model.timeZero)}`;
  return `${from} to ${to}`;
}

const unseen = "a check of the poses sees no contact";

/** Met at a pose itself, as far as digits show: what is met is the tolerance, not the surface. */
function nearPose({ linkName, separation }: Contact, object: string, at: string, isAfter: boolean): string {
  const side = isAfter ? "right after" : "right before";
  return `${linkName} comes within ${length(separation ?? 0)} of ${object} ${side} the pose at ${at}: near enough to count as a contact.`;
}

/** Metres a second. */
export function speed(value: number): string {
  return Math.abs(value) < 0.001 ? "0.000 m/s" : `${value.toPrecision(3)} m/s`;
}

/** How hard two meet, a line a fact; nothing of what is not known. */
export function forceOf({ speed: at, lower, upper, effectiveMass, impulse }: Strength): string[] {
  const lines: string[] = [];
  if (at !== null) lines.push(at > 0 ? `approach at ${speed(at)}${between(lower, upper)}` : `do not approach (${speed(at)})`);
  if (effectiveMass !== null) lines.push(`${effectiveMass.toPrecision(3)} kg meet${impulse === null || impulse === 0 ? "" : `: an impulse of ${impulse.toPrecision(3)} N s`}`);
  return lines;
}

function between(lower: number | null, upper: number | null): string {
  if (lower === null || upper === null) return "";
  return lower < 0 ? `, perhaps a graze (${speed(lower)} to ${speed(upper)})` : `, proven ${speed(lower)} to ${speed(upper)}`;
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
