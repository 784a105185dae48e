// Questions to a world at an instant, also in the past: what a ray hits, what a moved sphere, capsule
// or convex solid hits first, what a shape overlaps, what is nearest, what a point is inside of; and
// what something that flies hits first while the bodies move. Task by task: docs/ask.md. Metres, W.

import { ForetouchError, instant, type Machine, numberOf, point, type Point, real, type Room, type Values, whole, type Writes } from "./machine.js";
import * as structs from "./structs.js";

/** A point; a segment with a radius, where both ends alike, or no `b`, is a sphere; or the convex solid between corners, from `a` (left out: where W begins), with a radius around it. */
export type AskShape =
  | ArrayLike<number>
  | { readonly a: ArrayLike<number>; readonly b?: ArrayLike<number>; readonly radius?: number }
  | { readonly hull: readonly ArrayLike<number>[]; readonly a?: ArrayLike<number>; readonly radius?: number };

/** A body, by its number or with one of its links, or an object of it: of a mesh or, without a body, of what stands still. */
export type AskPart = number | { readonly body?: number; readonly link?: number; readonly object?: number };

/** Microseconds, or these and a fraction of one more. */
export type AskTime = number | readonly [number, number];

/** What a question is about: everything, unless it says less. */
export interface AskWhom {
  /** Nothing but these. */
  readonly only?: readonly AskPart[];
  /** Not these. */
  readonly without?: readonly AskPart[];
  /** Bodies of these groups. */
  readonly groups?: readonly number[];
  /** What stands still, too; left out: true. */
  readonly still?: boolean;
}

export const askWhich = ["closest", "any", "all"] as const;
/** The first one along the way or the nearest one; some one; or each LSS and each triangle that is touched or near, nearest first. */
export type AskWhich = (typeof askWhich)[number];

export interface AskOptions extends AskWhom {
  /** The shape moves along it, up to `reach`: what does it hit? Any length but zero. */
  readonly direction?: ArrayLike<number>;
  /** How far it moves; left out: 1000. */
  readonly reach?: number;
  /** Instead of a direction: what is nearest to it, up to so far? Neither: what does it overlap? */
  readonly within?: number;
  /** Left out: "closest". */
  readonly which?: AskWhich;
  /** Closed objects of meshes and of what stands still are solid: what begins inside one touches it, and an object that is not closed is unknown where its box holds the shape's place. Left out: surfaces count. */
  readonly solids?: boolean;
  /** These bodies at instants of their own: for what a player saw who sees others late. */
  readonly instants?: ReadonlyMap<number, AskTime>;
}

export const askVerdicts = ["clear", "hit", "unknown"] as const;
/** `clear`: nothing is hit or near, proven. `unknown`: nothing that is known is. */
export type AskVerdict = (typeof askVerdicts)[number];
export const askUnknowns = ["assumed", "silent", "not_there", "unresolved", "open"] as const;

/** One of two that meet. */
export interface ContactSide {
  /** Or stillScene; where something is unresolved, it may be everyBody. */
  readonly body: number;
  /** 0 for a mesh and for what stands still; or everyLink. */
  readonly link: number;
  /** Which of the link's LSS; -1: none. */
  readonly lss: number;
  /** The triangle of a mesh, or of what stands still; -1: none. */
  readonly triangle: number;
  /** The object of that mesh, or of what stands still (Scene.objectNames); -1: none. */
  readonly object: number;
  /** On its surface, W. */
  readonly point: Point;
}

/** An LSS or a triangle that was hit or is near; or, without either, an object that is solid and holds the shape's place. */
export interface WorldHit {
  /** For a cast, how far along the way, free before; else how far apart. Rounded down. */
  readonly distance: number;
  readonly what: ContactSide;
  /** Unit, to the shape; zero if none is reported. */
  readonly normal: Point;
  /** For a triangle, the point as a sum of its corners; else zero. */
  readonly weights: Point;
  /** It rests on a body that was silent, and was taken to hold still. */
  readonly isAssumed: boolean;
}

/** A body that was asked about and is not known then; or an object that has no inside. */
export interface UnknownBody {
  /** Or stillScene. */
  readonly body: number;
  /** `assumed`: taken to hold still. `open`: not closed. Others were left out. */
  readonly why: (typeof askUnknowns)[number];
  /** The one that is open, unless it is a link's surface; else -1. */
  readonly object: number;
}

/** One question of many. */
export interface AskQuestion extends AskOptions {
  readonly time: AskTime;
  readonly shape: AskShape;
}

export interface WorldAnswer {
  readonly verdict: AskVerdict;
  /** Nearest first; then by body, link, LSS and triangle. */
  readonly hits: readonly WorldHit[];
  readonly unknown: readonly UnknownBody[];
  /** All that was asked about is known: a hit is the first of all. */
  readonly isComplete: boolean;
}

export interface FlightAnswer {
  readonly verdict: AskVerdict;
  /** The first of all; null: none. */
  readonly hit: WorldHit | null;
  /** When, rounded down: whole microseconds and a fraction of one more; null without a hit. */
  readonly timeUs: number | null;
  readonly timeFraction: number | null;
  /** Those that are not known all through. */
  readonly unknown: readonly UnknownBody[];
}

const everything = -1;  // FT_STILL_SCENE, FT_EVERY_LINK and FT_EVERY_OBJECT of C

type Shaped = { readonly shape: Writes<typeof structs.ft_lss.fields>; readonly hull?: number; readonly hullCount?: number };

function writtenShape(room: Room, shape: AskShape): Shaped {
  if (typeof shape !== "object" || shape === null) throw new ForetouchError(`shape: expected a point, { a, b, radius } or { hull, radius }, found ${String(shape)}`);
  if (!("a" in shape) && !("hull" in shape)) return { shape: { a: point(shape, "shape"), b: point(shape, "shape") } };
  const { a = [0, 0, 0], radius = 0 } = shape, lss = { a: point(a, "shape.a"), b: point("b" in shape ? shape.b ?? a : a, "shape.b"), radius: real(radius, "shape.radius") };
  if (!("hull" in shape)) return { shape: lss };
  if (shape.hull.length === 0) throw new ForetouchError("shape.hull: expected corners, found none");
  return { shape: lss, hull: room.doubles(Array.from(shape.hull, (corner, i) => point(corner, `shape.hull[${i}]`)).flat()), hullCount: shape.hull.length };
}

function timeOf(given: AskTime, name: string): { readonly timeUs: number; readonly timeFraction: number } {
  const [timeUs, timeFraction] = typeof given === "number" ? [given, 0] : given;
  instant(timeUs, name);
  return { timeUs, timeFraction: real(timeFraction, name) };
}

function writtenParts(room: Room, parts: readonly AskPart[], name: string): number {
  return room.array(structs.ft_ask_part, Array.from(parts, (part) => {
    const { body = everything, link = everything, object = everything } = typeof part === "number" ? { body: part } : part;
    return { body, link, object };
  }), name);
}

function writtenWhom(room: Room, { only = [], without = [], groups, still = true, ...others }: AskWhom): number {
  const unknown = Object.keys(others)[0];
  if (unknown !== undefined) throw new ForetouchError(`question: expected another option than '${unknown}'`);
  return room.options("ft_ask_whom", structs.ft_ask_whom, {
    groups: groups?.reduce((all, group) => (all | (1 << whole(group, "groups", 0, 31))) >>> 0, 0),
    asksStill: still,
    only: writtenParts(room, only, "only"),
    onlyCount: only.length,
    without: writtenParts(room, without, "without"),
    withoutCount: without.length,
  });
}

function questionOf(room: Room, time: AskTime, shape: AskShape, options: AskOptions): Writes<typeof structs.ft_question.fields> {
  const { direction, reach = 1000, within, which = "closest", instants = new Map<number, AskTime>(), solids = false, ...whom } = options;
  if (direction !== undefined && within !== undefined) throw new ForetouchError("within: expected a direction or a distance within, found both");
  const seen = Array.from(instants, ([body, at]) => ({ body, ...timeOf(at, "instants") }));
  return {
    what: direction !== undefined ? 0 : within !== undefined ? 2 : 1,
    which: numberOf(askWhich, which, "which"),
    ...writtenShape(room, shape),
    direction: direction === undefined ? undefined : point(direction, "direction"),
    reach: within ?? reach,
    ...timeOf(time, "timeUs"),
    whom: writtenWhom(room, whom),
    instants: room.array(structs.ft_ask_instant, seen, "instants"),
    instantCount: seen.length,
    solids,
  };
}

function unknownOf(room: Room, world: number): UnknownBody[] {
  return room.list(structs.ft_unknown_body, "ft_world_unknown", world).map(({ why, ...of }) => ({ ...of, why: askUnknowns[why] }));
}

const answerOf = (verdict: number, hits: readonly WorldHit[], unknown: readonly UnknownBody[]): WorldAnswer => ({
  verdict: askVerdicts[verdict], hits, unknown, isComplete: unknown.every(({ why }) => why === "assumed"),
});

const hitOf = ({ distance, what, normal, weights, isAssumed }: Values<typeof structs.ft_world_hit.fields>): WorldHit => ({ distance, what, normal, weights, isAssumed: isAssumed === 1 });

/** For World.probe(). */
export function probed(machine: Machine, world: number, time: AskTime, shape: AskShape, options: AskOptions): WorldAnswer {
  return machine.within((room) => {
    const question = room.options("ft_question", structs.ft_question, questionOf(room, time, shape, options));
    const verdict = room.answered("ft_world_probe", world, question);
    return answerOf(verdict, room.list(structs.ft_world_hit, "ft_world_hits", world).map(hitOf), unknownOf(room, world));
  });
}

/** For World.probeMany(). */
export function manyProbed(machine: Machine, world: number, questions: readonly AskQuestion[]): WorldAnswer[] {
  return machine.within((room) => {
    const written = questions.map(({ time, shape, ...options }) => questionOf(room, time, shape, options));
    const all = room.array(structs.ft_question, written, "questions"), probed = room.take(structs.ft_probed.size * questions.length);
    machine.ask("ft_world_probe_many", world, all, questions.length, probed);
    const hits = room.list(structs.ft_world_hit, "ft_world_hits", world).map(hitOf), unknown = unknownOf(room, world), view = machine.view();
    let hit = 0, other = 0;
    return questions.map((_, i) => {
      const { verdict, hitCount, unknownCount } = structs.ft_probed.read(view, probed + i * structs.ft_probed.size);
      return answerOf(verdict, hits.slice(hit, (hit += hitCount)), unknown.slice(other, (other += unknownCount)));
    });
  });
}

/** For World.fly(). */
export function flown(machine: Machine, world: number, fromUs: number, toUs: number, shape: AskShape, way: ArrayLike<number>, whom: AskWhom): FlightAnswer {
  return machine.within((room) => {
    instant(fromUs, "fromUs");
    instant(toUs, "toUs");
    const flight = room.options("ft_flight", structs.ft_flight, { ...writtenShape(room, shape), way: point(way, "way"), fromUs, toUs, whom: writtenWhom(room, whom) });
    const at = room.zeroed(structs.ft_flight_hit);
    machine.ask("ft_world_fly", world, flight, at);
    const { verdict, timeUs, timeFraction, ...hit } = room.read(structs.ft_flight_hit, at), isHit = askVerdicts[verdict] === "hit";
    return { verdict: askVerdicts[verdict], hit: isHit ? hitOf(hit) : null, timeUs: isHit ? timeUs : null, timeFraction: isHit ? timeFraction : null, unknown: unknownOf(room, world) };
  });
}
