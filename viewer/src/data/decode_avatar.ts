import { type Avatar, type Carried, type Link, type LinkMesh, type Lss, type Solid, solidStates, type SweptSurface } from "./avatar.js";
import type { Reader } from "./reader.js";
import { decodeContact } from "./decode_contact.js";
import { decodePlacedMesh } from "./decode_scene.js";
import { decodeTrack, increasing } from "./decode_track.js";

/** Links are named by 16 bits where a check at the poses lists them. */
const maxLinks = 65536;

export function decodeAvatar(reader: Reader): Avatar {
  const links = decodeLinks(reader.field("links"));
  const trackReader = reader.optional("track");
  const track = trackReader === null ? null : decodeTrack(trackReader, links.length);
  const steps = track?.from.length ?? 0;
  const tracked = reader.optional("tracked"), solid = reader.optional("solid");
  return {
    id: reader.field("id").count(),
    name: reader.field("name").text(),
    links,
    lss: (reader.optional("lss")?.items() ?? []).map((item) => decodeLss(item, links.length)),
    meshes: (reader.optional("meshes")?.items() ?? []).map((item) => decodeMesh(item, links.length)),
    track,
    tracked: tracked === null ? null : decodeTrack(tracked, links.length),
    solid: solid === null ? null : decodeSolid(solid),
    isLiveSolid: reader.optional("is_solid")?.flag() ?? false,
    contacts: (reader.optional("contacts")?.items() ?? []).map((item) => ({
      ...decodeContact(item, links.length),
      step: item.field("step").index(steps),
    })),
    swept: (reader.optional("swept")?.items() ?? []).map((item) =>
      decodeSwept(item, links.length, steps),
    ),
    carried: (reader.optional("carried")?.items() ?? []).map(decodeCarried),
    outline: decodeOutline(reader),
  };
}

/** Whole lines: two points of three numbers. */
function decodeOutline(reader: Reader): Float32Array | null {
  const outline = reader.optional("outline");
  if (outline === null) return null;
  const points = outline.typed("f32");
  if (points.length % 6 !== 0) outline.fail("ends within a line");
  return points;
}

/** Who carries is checked where all avatars are known. */
function decodeCarried(item: Reader): Carried {
  const from = item.field("from").number();
  return {
    from,
    until: item.optional("until")?.number(from) ?? null,
    avatar: item.field("avatar").count(),
    link: item.field("link").count(),
    links: 0,
  };
}

function decodeSolid(reader: Reader): Solid {
  const times = increasing(reader.field("times"));
  return {
    times,
    states: reader.field("states").typedIndices("u16", solidStates.length, times.length),
    deviations: reader.field("deviations").typed("f64", times.length),
  };
}

function decodeLinks(reader: Reader): Link[] {
  const items = reader.items();
  if (items.length === 0) reader.fail("is empty");
  if (items.length > maxLinks) reader.fail(`has more than ${maxLinks} links`);
  return items.map((item, i) => ({
    name: item.field("name").text(),
    parent: item.field("parent").index(i, -1),
  }));
}

function decodeLss(item: Reader, links: number): Lss {
  return {
    link: item.field("link").index(links),
    a: item.field("a").vector(),
    b: item.field("b").vector(),
    radius: item.field("radius").number(0),
  };
}

function decodeMesh(item: Reader, links: number): LinkMesh {
  const { positions, indices } = decodePlacedMesh(item);
  return { link: item.field("link").index(links), positions, indices };
}

function decodeSwept(item: Reader, links: number, steps: number): SweptSurface {
  return {
    ...decodePlacedMesh(item),
    step: item.field("step").index(steps),
    link: item.field("link").index(links),
    error: item.optional("error")?.number(0) ?? 0,
  };
}
