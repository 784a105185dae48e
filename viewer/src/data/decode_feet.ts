import type { Avatar, FootStance, RecordedFoot } from "./document.js";
import type { Reader } from "./reader.js";

/** Feet are those of the first avatar. */
export function decodeFoot(item: Reader, avatars: readonly Avatar[]): RecordedFoot {
  if (avatars[0] === undefined) item.fail("is a foot, but there is no avatar");
  return {
    link: item.field("link").index(avatars[0].links.length),
    stances: item.field("stances").items().map(decodeStance),
  };
}

function decodeStance(item: Reader): FootStance {
  const begin = item.field("begin").number(), metres = (name: string): number => item.optional(name)?.number(0) ?? 0;
  return {
    kind: item.field("kind").oneOf(["touches", "under", "hovers"] as const),
    begin,
    end: item.field("end").number(begin),
    beganBefore: item.optional("began_before")?.flag() ?? false,
    goesOn: item.optional("goes_on")?.flag() ?? false,
    slide: metres("slide"),
    slides: item.optional("slides")?.text() ?? "",
    depth: metres("depth"),
    deepest: item.optional("deepest")?.text() ?? "",
    depthAt: item.optional("depth_at")?.number() ?? begin,
    hover: metres("hover"),
    trace: (item.optional("trace")?.items() ?? []).map((point) => point.vector()),
  };
}
