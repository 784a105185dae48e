import type { Avatar } from "./avatar.js";
import { present, type Reader } from "./reader.js";

/** What rounding may put the end of a touch before its begin, seconds. */
export const rounding = 1e-6;

export function decodeTouch(item: Reader, avatars: readonly Avatar[]) {
  const avatar = item.optional("avatar")?.index(avatars.length) ?? 0;
  if (avatars[avatar] === undefined) item.fail("is of an avatar, but there is none");
  const { links, contacts } = avatars[avatar];
  const otherAvatar = item.optional("other_avatar")?.index(avatars.length) ?? null;
  const otherLinks = otherAvatar === null ? links : avatars[otherAvatar].links;
  const other = item.optional("other")?.index(otherLinks.length) ?? null;
  const begin = item.field("begin").number();
  return {
    avatar,
    link: item.field("link").index(links.length),
    /** Of own links: the other one's name. */
    object: item.optional("object")?.text() ?? (other === null ? "" : otherLinks[other].name),
    /** The other link; null where it touches the scene. */
    other,
    /** Whose that is: an index into the document's avatars; null where it is the avatar's own. */
    otherAvatar,
    begin,
    end: Math.max(begin, item.field("end").number(begin - rounding)),
    /** "inside": it touched already when somebody first looked. */
    begins: item.optional("begins")?.oneOf(["contact", "inside"] as const) ?? "contact",
    /** "open": it still touches when nobody looks any more. */
    ends: item.optional("ends")?.oneOf(["left", "open"] as const) ?? "left",
    isGround: item.optional("ground")?.flag() ?? false,
    /** No pose that was asked for lies in it. */
    isMissed: item.optional("missed")?.flag() ?? false,
    /** Indices into the avatar's contacts. */
    rows: (item.optional("rows")?.items() ?? []).map((row) => row.index(contacts.length)),
    /** The deepest that any of its poses is in it, metres; null where none is. */
    depth: present(item, "penetration")?.number(0) ?? null,
    /** Where it begins; null where nobody looked. */
    strength: decodeStrength(item),
    /** Why nothing is claimed of the two in this time, which is then no touch; null of touches. */
    unresolved: item.optional("unresolved")?.text() ?? null,
  };
}

/** A link and an object (or another link, of the same avatar or of another one) from first contact to where it ends. */
export type RecordedTouch = Readonly<ReturnType<typeof decodeTouch>>;

function decodeStrength(item: Reader) {
  const approach = item.optional("approach");
  if (approach === null) return null;
  return {
    /** Above zero while they approach; if they touch, it is proven to be between the next two. */
    speed: finite(approach, "speed"),
    lower: finite(approach, "lower"),
    upper: finite(approach, "upper"),
    /** That meets the other along the normal; null where nothing of the two has a mass. */
    effectiveMass: finite(item, "effective_mass"),
    /** That would take the approach away. */
    impulse: finite(item, "impulse"),
  };
}

/** How hard two meet: metres a second along the normal, kilograms, newton seconds; null where it is not known. */
export type Strength = Readonly<NonNullable<ReturnType<typeof decodeStrength>>>;

/** Null for what is absent or null: no number stands for infinity. */
function finite(item: Reader, name: string): number | null {
  const field = item.optional(name);
  return field === null || field.value === null ? null : field.number();
}

export function decodeStay(item: Reader, avatars: readonly Avatar[]) {
  const trigger = item.field("trigger"), index = trigger.index(avatars.length);
  if (avatars[index].outline === null) trigger.fail("is no trigger");
  const avatar = item.field("avatar").index(avatars.length), begin = item.field("begin").number();
  return {
    /** Indices into the document's avatars. */
    trigger: index,
    avatar,
    /** Whose entering it begins with. */
    link: item.optional("link")?.index(avatars[avatar].links.length) ?? 0,
    begin,
    end: Math.max(begin, item.field("end").number(begin - rounding)),
    begins: item.optional("begins")?.oneOf(["enter", "inside"] as const) ?? "enter",
    ends: item.optional("ends")?.oneOf(["left", "open"] as const) ?? "left",
    isUnresolved: item.optional("unresolved")?.flag() ?? false,
  };
}

/** Somebody is in a trigger, or nothing is known of that. */
export type RecordedStay = Readonly<ReturnType<typeof decodeStay>>;

export function decodeCheck(item: Reader) {
  return {
    name: item.field("name").text(),
    state: item.field("state").oneOf(["good", "doubt", "bad"] as const),
    text: item.field("text").text(),
    /** An option to copy; "" for none. */
    remedy: item.optional("try")?.text() ?? "",
  };
}

/** One verdict of an inspection, and what to try where it is no good one. */
export type Check = Readonly<ReturnType<typeof decodeCheck>>;
