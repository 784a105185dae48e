import type { Avatar, Check, RecordedTouch } from "./document.js";
import type { Reader } from "./reader.js";

/** What rounding may put the end of a touch before its begin, seconds. */
const rounding = 1e-6;

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
