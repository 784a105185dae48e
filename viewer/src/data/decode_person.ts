import type { Avatar } from "./avatar.js";
import { rounding } from "./decode_touch.js";
import { present, type Reader } from "./reader.js";

export function decodePerson(item: Reader, avatars: readonly Avatar[]) {
  if (avatars[0] === undefined) item.fail("is what a person touched, but there is no avatar");
  return {
    /** The file of the bounds, and the motion between two poses that they are about. */
    bounds: item.field("bounds").text(),
    between: item.field("between").text(),
    /** Of the poses that were asked; null where each person has a rate of their own. */
    rateHz: present(item, "rate_hz")?.number(0) ?? null,
    touches: item.field("touches").items().map((touch) => decodePersonTouch(touch, avatars, touch.optional("avatar")?.index(avatars.length) ?? 0)) as readonly PersonTouch[],
  };
}

export type RecordedPerson = Readonly<ReturnType<typeof decodePerson>>;

export function decodePersonTouch(item: Reader, avatars: readonly Avatar[], avatar: number) {
  const { links } = avatars[avatar];
  const other = item.optional("other")?.index(links.length) ?? null;
  const isCertain = item.field("verdict").oneOf(["certain", "possible"] as const) === "certain";
  const [first, begun] = two(item, "begins"), [ended, last] = two(item, "ends");
  const begin = first.number(), end = Math.max(begin, last.number(begin - rounding));
  const within = (time: Reader): number => Math.min(end, Math.max(begin, time.number(begin - rounding, end + rounding)));
  for (const time of [begun, ended]) if (!isCertain && time.value !== null) time.fail("is known, but the touch is only possible");
  return {
    /** Whose; indices into the document's avatars, and into their links. */
    avatar,
    link: item.field("link").index(links.length),
    /** Of the scene, or of another body; the other one's name where it is an own link; "" where it is not known. */
    object: item.optional("object")?.text() ?? (other === null ? "" : links[other].name),
    isOwn: other !== null,
    /** Nothing is touched before, and nothing after. */
    begin,
    end,
    /** By when it had begun, and until when it had not ended; null of what is only possible. */
    certain: isCertain ? { from: within(begun), to: within(ended) } : null,
    /** The clip begins, or ends, in it. */
    beganBefore: item.optional("began_before")?.flag() ?? false,
    goesOn: item.optional("goes_on")?.flag() ?? false,
    /** The farthest that person and model may be apart in it, metres; null where it is not known. */
    growth: present(item, "growth")?.number(0) ?? null,
  };
}

/** What the person touched, whatever they did within the bounds. Seconds. */
export type PersonTouch = Readonly<ReturnType<typeof decodePersonTouch>>;

function two(item: Reader, name: string): readonly [Reader, Reader] {
  const field = item.field(name), items = field.items();
  return items.length === 2 ? [items[0], items[1]] : field.fail("is not two times");
}
