import type { Avatar } from "./avatar.js";
import type { Reader } from "./reader.js";

/** Feet are those of the first avatar. */
export function decodeFoot(item: Reader, avatars: readonly Avatar[]) {
  if (avatars[0] === undefined) item.fail("is a foot, but there is no avatar");
  return {
    /** The ankle, of the first avatar. */
    link: item.field("link").index(avatars[0].links.length),
    stances: item.field("stances").items().map(decodeStance),
  };
}

export type RecordedFoot = Readonly<ReturnType<typeof decodeFoot>>;

function decodeStance(item: Reader) {
  const begin = item.field("begin").number(), metres = (name: string): number => item.optional(name)?.number(0) ?? 0;
  return {
    kind: item.field("kind").oneOf(["touches", "under", "hovers"] as const),
    begin,
    end: item.field("end").number(begin),
    /** The clip begins, or ends, in it. */
    beganBefore: item.optional("began_before")?.flag() ?? false,
    goesOn: item.optional("goes_on")?.flag() ?? false,
    slide: metres("slide"),
    /** The part that slides most, and the deepest: "heel"; "" of what hovers. */
    slides: item.optional("slides")?.text() ?? "",
    depth: metres("depth"),
    deepest: item.optional("deepest")?.text() ?? "",
    depthAt: item.optional("depth_at")?.number() ?? begin,
    hover: metres("hover"),
    /** On the ground; empty where it does not slide. */
    trace: (item.optional("trace")?.items() ?? []).map((point) => point.vector()),
  };
}

/** A touch of a whole foot, or that it hovers. Metres and seconds. */
export type FootStance = Readonly<ReturnType<typeof decodeStance>>;
