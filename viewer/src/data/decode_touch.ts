import type { Avatar, Check, RecordedStay, RecordedTouch, Strength } from "./document.js";
import { present, type Reader } from "./reader.js";

/** What rounding may put the end of a touch before its begin, seconds. */
export const rounding = 1e-6;

export function decodeTouch(item: Reader, avatars: readonly Avatar[]): RecordedTouch {
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
    object: item.optional("object")?.text() ?? (other === null ? "" : otherLinks[other].name),
    other,
    otherAvatar,
    begin,
    end: Math.max(begin, item.field("end").number(begin - rounding)),
    begins: item.optional("begins")?.oneOf(["contact", "inside"] as const) ?? "contact",
    ends: item.optional("ends")?.oneOf(["left", "open"] as const) ?? "left",
    isGround: item.optional("ground")?.flag() ?? false,
    isMissed: item.optional("missed")?.flag() ?? false,
    rows: (item.optional("rows")?.items() ?? []).map((row) => row.index(contacts.length)),
    depth: present(item, "penetration")?.number(0) ?? null,
    strength: decodeStrength(item),
    unresolved: item.optional("unresolved")?.text() ?? null,
  };
}

function decodeStrength(item: Reader): Strength | null {
  const approach = item.optional("approach");
  if (approach === null) return null;
  return {
    speed: finite(approach, "speed"),
    lower: finite(approach, "lower"),
    upper: finite(approach, "upper"),
    effectiveMass: finite(item, "effective_mass"),
    impulse: finite(item, "impulse"),
  };
}

/** Null for what is absent or null: no number stands for infinity. */
function finite(item: Reader, name: string): number | null {
  const field = item.optional(name);
  return field === null || field.value === null ? null : field.number();
}

export function decodeStay(item: Reader, avatars: readonly Avatar[]): RecordedStay {
  const trigger = item.field("trigger"), index = trigger.index(avatars.length);
  if (avatars[index].outline === null) trigger.fail("is no trigger");
  const avatar = item.field("avatar").index(avatars.length), begin = item.field("begin").number();
  return {
    trigger: index,
    avatar,
    link: item.optional("link")?.index(avatars[avatar].links.length) ?? 0,
    begin,
    end: Math.max(begin, item.field("end").number(begin - rounding)),
    begins: item.optional("begins")?.oneOf(["enter", "inside"] as const) ?? "enter",
    ends: item.optional("ends")?.oneOf(["left", "open"] as const) ?? "left",
    isUnresolved: item.optional("unresolved")?.flag() ?? false,
  };
}

export function decodeCheck(item: Reader): Check {
  return {
    name: item.field("name").text(),
    state: item.field("state").oneOf(["good", "doubt", "bad"] as const),
    text: item.field("text").text(),
    remedy: item.optional("try")?.text() ?? "",
  };
}
