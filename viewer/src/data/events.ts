// Live events, decoded: as little trusted as the document.

import type { Avatar, ContactFields, PersonTouch, SolidState } from "./document.js";
import { solidStates } from "./document.js";
import type { LocalPose } from "../motion/chain.js";
import { emptyPose } from "../motion/chain.js";
import { normalise } from "../motion/quaternion.js";
import { decodeContact } from "./decode_contact.js";
import { decodePersonTouch } from "./decode_person.js";
import { Malformed, Reader } from "./reader.js";

export type StepKind = "consecutive" | "first" | "across-gap";

/** What a solid avatar shows in a step. */
export interface ShownStep {
  readonly from: LocalPose;
  readonly to: LocalPose;
  readonly state: SolidState;
  readonly limit: string;
  readonly isCertified: boolean;
  /** Metres, of the farthest link from where its tracker says. */
  readonly deviation: number;
  /** Seconds until it snaps; null if it does not. */
  readonly snapIn: number | null;
}

export interface StepEvent {
  /** Index into the document's avatars. */
  readonly avatar: number;
  readonly sequence: number;
  readonly t0: number;
  readonly t1: number;
  readonly kind: StepKind;
  readonly lost: number;
  readonly from: LocalPose;
  readonly to: LocalPose;
  /** Null: the avatar is not solid. */
  readonly shown: ShownStep | null;
  readonly contacts: readonly ContactFields[];
  /** What the person touched in this step and those before it, surely or perhaps; step by step. */
  readonly person: readonly PersonTouch[];
  readonly queryUs: number;
  readonly addedUs: number;
  /** Steps not sent to this page since the last one. */
  readonly skipped: number;
}

export const statusNames = [
  "answered", "rejected", "lost", "gaps", "waiting", "query_p50_us", "query_p99_us",
  "answer_p50_us", "answer_p99_us", "viewers",
] as const;
export type StatusName = (typeof statusNames)[number];
export type StatusEvent = Partial<Record<StatusName, number>>;

const kinds: readonly StepKind[] = ["consecutive", "first", "across-gap"];
/** Rotation w, x, y, z and translation of one link. */
const numbersPerLink = 7;

/** A step of an avatar that the document does not have: it came after the page. */
export class UnknownAvatar extends Malformed {}

function reader(text: string, name: string): Reader {
  try {
    return new Reader(JSON.parse(text) as unknown, name);
  } catch {
    throw new Malformed(`event "${name}"`, "is not JSON");
  }
}

/** Throws Malformed. */
export function decodeStep(text: string, avatars: readonly Avatar[]): StepEvent {
  const event = reader(text, "step");
  const id = event.field("avatar").count();
  const avatar = avatars.findIndex((one) => one.id === id);
  if (avatar < 0) throw new UnknownAvatar('event "step", avatar', `is ${id}, whom the document does not know`);
  const links = avatars[avatar].links.length;
  const t0 = event.field("t0").number();
  return {
    avatar,
    sequence: event.optional("sequence")?.number() ?? 0,
    t0,
    t1: event.field("t1").number(t0),
    kind: event.optional("kind")?.oneOf(kinds) ?? "consecutive",
    lost: event.optional("lost")?.number(0) ?? 0,
    from: decodePose(event.field("from"), links),
    to: decodePose(event.field("to"), links),
    shown: avatars[avatar].isLiveSolid ? decodeShown(event, links) : null,
    contacts: (event.optional("contacts")?.items() ?? []).map((item) => decodeContact(item, links)),
    person: (event.optional("person")?.items() ?? []).map((item) => decodePersonTouch(item, avatars, avatar)),
    queryUs: event.optional("query_us")?.number() ?? 0,
    addedUs: event.optional("added_us")?.number() ?? 0,
    skipped: event.optional("skipped")?.number(0) ?? 0,
  };
}

function decodeShown(event: Reader, links: number): ShownStep {
  const solid = event.field("solid");
  return {
    from: decodePose(event.field("shown_from"), links),
    to: decodePose(event.field("shown_to"), links),
    state: solid.field("state").oneOf(solidStates),
    limit: solid.optional("limit")?.text() ?? "none",
    isCertified: solid.field("certified").flag(),
    deviation: solid.field("deviation").number(0),
    snapIn: solid.optional("snap_in")?.number(0) ?? null,
  };
}

/** Throws Malformed. */
export function decodeStatus(text: string): StatusEvent {
  const event = reader(text, "status");
  const status: StatusEvent = {};
  for (const name of statusNames) {
    const field = event.optional(name);
    if (field !== null && field.value !== null) status[name] = field.number();
  }
  return status;
}

function decodePose(place: Reader, links: number): LocalPose {
  const numbers = place.items();
  if (numbers.length !== links * numbersPerLink) {
    place.fail(`has ${numbers.length} numbers, but ${links * numbersPerLink} are needed`);
  }
  const pose = emptyPose(links);
  for (let link = 0; link < links; ++link) {
    for (let i = 0; i < numbersPerLink; ++i) {
      const value = numbers[numbersPerLink * link + i].number();
      if (i < 4) pose.rotations[4 * link + i] = value;
      else pose.translations[3 * link + i - 4] = value;
    }
    if (!(normalise(pose.rotations, 4 * link) > 0)) place.fail(`has no rotation for link ${link}`);
  }
  return pose;
}
