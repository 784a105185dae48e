import { rounding } from "./decode_touch.js";
import type { Avatar, PersonTouch, RecordedPerson } from "./document.js";
import { present, type Reader } from "./reader.js";

export function decodePerson(item: Reader, avatars: readonly Avatar[]): RecordedPerson {
  if (avatars[0] === undefined) item.fail("is what a person touched, but there is no avatar");
  return {
    bounds: item.field("bounds").text(),
    between: item.field("between").text(),
    rateHz: present(item, "rate_hz")?.number(0) ?? null,
    touches: item.field("touches").items().map((touch) => decodePersonTouch(touch, avatars, touch.optional("avatar")?.index(avatars.length) ?? 0)),
  };
}

export function decodePersonTouch(item: Reader, avatars: readonly Avatar[], avatar: number): PersonTouch {
  const { links } = avatars[avatar];
  const other = item.optional("other")?.index(links.length) ?? null;
  const isCertain = item.field("verdict").oneOf(["certain", "possible"] as const) === "certain";
  const [first, begun] = two(item, "begins"), [ended, last] = two(item, "ends");
  const begin = first.number(), end = Math.max(begin, last.number(begin - rounding));
  const within = (time: Reader): number => Math.min(end, Math.max(begin, time.number(begin - rounding, end + rounding)));
  for (const time of [begun, ended]) if (!isCertain && time.value !== null) time.fail("is known, but the touch is only possible");
  return {
    avatar,
    link: item.field("link").index(links.length),
    object: item.optional("object")?.text() ?? (other === null ? "" : links[other].name),
    isOwn: other !== null,
    begin,
    end,
    certain: isCertain ? { from: within(begun), to: within(ended) } : null,
    beganBefore: item.optional("began_before")?.flag() ?? false,
    goesOn: item.optional("goes_on")?.flag() ?? false,
    growth: present(item, "growth")?.number(0) ?? null,
  };
}

function two(item: Reader, name: string): readonly [Reader, Reader] {
  const field = item.field(name), items = field.items();
  return items.length === 2 ? [items[0], items[1]] : field.fail("is not two times");
}
