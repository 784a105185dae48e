import type { Vector, Verdict } from "./geometry.js";
import { present, type Reader } from "./reader.js";

const verdicts: readonly Verdict[] = ["contact", "starts_in_contact", "undecided"];

/** The fields of a contact that do not say which step it belongs to. */
export function decodeContact(item: Reader, links: number) {
  const verdict = item.field("verdict").oneOf(verdicts);
  const isDecided = verdict !== "undecided";
  const contact = {
    link: item.field("link").index(links),
    verdict,
    reason: present(item, "reason")?.text() ?? null,
    toi: present(item, "toi")?.number(0, 1) ?? null,
    time: present(item, "time")?.number() ?? null,
    freeUntil: present(item, "free_until")?.number(0, 1) ?? null,
    separation: present(item, "separation")?.number() ?? null,
    penetration: present(item, "penetration")?.number() ?? null,
    point: vector(item, "point"),
    onLink: vector(item, "on_link"),
    normal: vector(item, "normal"),
    triangle: present(item, "triangle")?.number() ?? null,
    object: present(item, "object")?.text() ?? null,
    /** Of two bodies: the other one, an index into the document's avatars, and its link; else null. */
    otherAvatar: present(item, "other_avatar")?.count() ?? null,
    otherLink: present(item, "other")?.count() ?? null,
    missedByPoses: present(item, "missed_by_poses")?.flag() ?? null,
    /** Of a solid avatar: how hard the tracked pose presses, metres; and how fast the link slips, m/s. */
    push: present(item, "push")?.number(0) ?? null,
    slip: present(item, "slip")?.number() ?? null,
  };
  if (isDecided && contact.toi === null) item.fail('has no "toi"');
  if (isDecided && contact.point === null) item.fail('has no "point"');
  return contact;
}

/** A contact as the results have it; null for fields its verdict does not have. */
export type ContactFields = Readonly<ReturnType<typeof decodeContact>>;

function vector(item: Reader, name: string): Vector | null {
  return present(item, name)?.vector() ?? null;
}
