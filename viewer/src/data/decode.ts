// From the text of a view document to a checked ViewDocument, or one sentence on what is wrong.

import type { Avatar, Kind, SummaryLine, ViewDocument } from "./document.js";
import { Malformed, present, Reader } from "./reader.js";
import { decodeAvatar } from "./decode_avatar.js";
import { decodeFoot } from "./decode_feet.js";
import { decodePerson } from "./decode_person.js";
import { decodeScene, emptyScene } from "./decode_scene.js";
import { decodeCheck, decodeStay, decodeTouch } from "./decode_touch.js";

export const formatName = "foretouch-view";
export const formatVersion = 1;
const kinds: readonly Kind[] = ["replay", "world", "log", "inspection", "live"];

/** Throws Malformed. */
export function decodeDocument(text: string): ViewDocument {
  return decodeValue(parsed(text));
}

function parsed(text: string): unknown {
  try {
    return JSON.parse(text) as unknown;
  } catch {
    throw new Malformed("", "is not JSON; perhaps the file was cut short");
  }
}

function decodeValue(value: unknown): ViewDocument {
  const root = new Reader(value, "");
  requireFormat(root);
  const kind = root.field("kind").oneOf(kinds);
  const scene = root.optional("scene"), person = present(root, "person");
  const avatars = together(root, (root.optional("avatars")?.items() ?? []).map(decodeAvatar));
  return {
    kind,
    title: root.field("title").text(),
    tool: root.optional("tool")?.text() ?? "",
    settings: (root.optional("settings")?.items() ?? []).map((item) => ({
      name: item.field("name").text(),
      value: item.field("value").text(),
    })),
    summary: (root.optional("summary")?.items() ?? []).map(decodeSummaryLine),
    notes: (root.optional("notes")?.items() ?? []).map((note) => note.text()),
    scene: scene === null ? emptyScene : decodeScene(scene),
    avatars,
    touches: root.optional("touches")?.items().map((item) => decodeTouch(item, avatars)) ?? null,
    stays: (root.optional("stays")?.items() ?? []).map((item) => decodeStay(item, avatars)),
    frameTime: root.optional("frame_time")?.number(1e-9) ?? null,
    feet: (root.optional("feet")?.items() ?? []).map((item) => decodeFoot(item, avatars)),
    person: person === null ? null : decodePerson(person, avatars),
    checks: (root.optional("checks")?.items() ?? []).map(decodeCheck),
    events: kind === "live" ? eventsAddress(root) : null,
  };
}

/** Checks what avatars say of each other. */
function together(root: Reader, avatars: readonly Avatar[]): Avatar[] {
  const require = (avatar: number, link: number, what: string): void => {
    if (link >= (avatars[avatar]?.links.length ?? 0)) root.fail(`names a link that is not there as ${what}`);
  };
  for (const { contacts } of avatars) {
    for (const { otherAvatar, otherLink } of contacts) {
      if (otherAvatar !== null) require(otherAvatar, otherLink ?? 0, "the other side of a contact");
    }
  }
  return avatars.map((one) => ({
    ...one,
    carried: one.carried.map((carried) => {
      require(carried.avatar, carried.link, "one that carries");
      return { ...carried, links: avatars[carried.avatar].links.length };
    }),
  }));
}

function requireFormat(root: Reader): void {
  if (root.optional("format")?.value !== formatName) root.fail(`is no ${formatName} document`);
  const version = root.field("version").count();
  if (version !== formatVersion) {
    root.fail(`is of version ${version}, but this page reads version ${formatVersion}`);
  }
}

function decodeSummaryLine(item: Reader): SummaryLine {
  return {
    name: item.field("name").text(),
    value: item.field("value").text(),
    note: item.optional("note")?.text() ?? "",
  };
}

/** Only an address on the page's own server: a document must not send the page elsewhere. */
function eventsAddress(root: Reader): string {
  const events = root.field("live").field("events");
  const address = events.text();
  if (!/^\/(?!\/)[\w./-]*$/.test(address)) events.fail("is no path on this server");
  return address;
}
