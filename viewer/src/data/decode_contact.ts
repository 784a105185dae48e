import type { ContactFields, Vector, Verdict } from "./document.js";
import { present, type Reader } from "./reader.js";

const verdicts: readonly Verdict[] = ["contact", "starts_in_contact", "undecided"];

/** The fields of a contact that do not say which step it belongs to. */
export function decodeContact(item: Reader, links: number): ContactFields {
  const verdict = item.field("verdict").oneOf(verdicts);
  const isDecided = verdict !== "undecided";
  const contact: ContactFields = {
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
    otherAvatar: present(item, "other_avatar")?.count() ?? null,
    otherLink: present(item, "other")?.count() ?? null,
    missedByPoses: present(item, "missed_by_poses")?.flag() ?? null,
    push: present(item, "push")?.number(0) ?? null,
    slip: present(item, "slip")?.number() ?? null,
  };
  if (isDecided && contact.toi === null) item.fail('has no "toi"');
  if (isDecided && contact.point === null) item.fail('has no "point"');
  return contact;
}

function vector(item: Reader, name: string): Vector | null {
  return present(item, name)?.vector() ?? null;
}
