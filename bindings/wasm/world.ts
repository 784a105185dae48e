// Moving worlds: avatars, rigid props and what they carry, each known at instants of its own; which
// two meet between two of these, from enter to leave; and volumes that report what is in them. What
// it is good for, and where it ends: docs/moving.md. Instants are whole microseconds since any epoch.

import { type AskOptions, type AskQuestion, type AskShape, type AskTime, type AskWhom, type ContactSide, type FlightAnswer, flown, manyProbed, probed, type WorldAnswer } from "./ask.js";
import { type Fields, ForetouchError, Held, handleOf, instant, known, type Machine, numberOf, type Point, point, real, type Room, type Struct, type Values, whole, type Writes } from "./machine.js";
import { type Verdict, verdicts } from "./query.js";
import { Avatar, type PoseLike, Scene, writtenPose } from "./shapes.js";
import * as structs from "./structs.js";

/** In place of a body: what stands still. It is always b. */
export const stillScene = -1;
/** In place of a body, where something is unresolved: everything that a is asked about. */
export const everyBody = -2;
/** In place of a link: every link, or every one that has no line of its own. */
export const everyLink = -1;

export const silences = ["wait", "hold-still", "undecided"] as const;
/** After its last pose a body is waited for, taken to stay, or unknown. */
export type WhenSilent = (typeof silences)[number];
export const reasons = ["none", "work-budget", "resolution", "after-first", "gap"] as const;
/** Why nothing is claimed. */
export type Reason = (typeof reasons)[number];
export const eventKinds = ["leave", "unresolved_to", "starts_inside", "enter", "unresolved_from"] as const;
/** `enter`: the two were free. `leave`: they are, from here on. `starts_inside`: they are in contact where they are known first. `unresolved_from`, `unresolved_to`: nothing is claimed. */
export type EventKind = (typeof eventKinds)[number];
export const leaveCauses = ["apart", "not_asked", "moved"] as const;
/** `apart`: proven. `not_asked`: one carries the other, or ask() says so. `moved`: one of the two, or what carries it, is put elsewhere there, with a jump. */
export type LeaveCause = (typeof leaveCauses)[number];

export interface WorldOptions {
  /** Metres, of every contact; left out: 1e-3. */
  readonly tolerance?: number;
  /** Two meshes are asked whether they meet, and a mesh and what stands still; left out: they are not. */
  readonly asksMeshes?: boolean;
  /** Evaluations (about 10 ns each) that two bodies may cost in a window, and a body by itself between two poses. Beyond it: undecided. */
  readonly workPerPair?: number;
  /** The same for all pairs of a window together, shared by bodies; left out: no bound. */
  readonly workPerWindow?: number;
  /** A body that may meet more than so many others in a window is crowded: two of them are not asked about each other, and are `silent`. */
  readonly mostNear?: number;
}

export interface BodyOptions {
  /** 0 to 31, for ask(); left out: 0. */
  readonly group?: number;
  /** Left out: "wait". */
  readonly whenSilent?: WhenSilent;
}

/** The first contact of two links in a window. Metres, W. */
export interface WorldContact {
  /** `starts_in_contact`: they touch where the window begins, or where one of them appears or is attached. `undecided`: free until then, nothing claimed after it. */
  readonly verdict: Verdict;
  /** For `undecided`. */
  readonly reason: Reason;
  /** Whole microseconds, rounded down: never later than the first touch. */
  readonly timeUs: number;
  /** Of one microsecond more, in [0, 1). */
  readonly timeFraction: number;
  /** The body with the lower number, or, within one body, the lower link. */
  readonly a: ContactSide;
  readonly b: ContactSide;
  readonly separation: number;
  /** Of `starts_in_contact`; null if it is not known, as of triangles, which have no inside. */
  readonly penetration: number | null;
  /** Unit, from b to a. */
  readonly normal: Point;
  /** It rests on a body that was silent, and was taken to hold still. */
  readonly isAssumed: boolean;
}

/** A body of which nothing was known in the rest of a window. */
export interface SilentBody {
  readonly body: number;
  /** Its last pose, or the window's begin. */
  readonly sinceUs: number;
  readonly takenTo: WhenSilent;
}

/** What a world answers about a window. Pairs that were asked and are not listed are proven clear, except of silent bodies that are undecided, and of what these carry. */
export interface WorldContacts {
  /** The earliest first; at equal times by a's body and link, then by b's. */
  readonly contacts: readonly WorldContact[];
  readonly silent: readonly SilentBody[];
  /** Work done, by kind. */
  readonly counters: Values<typeof structs.ft_world_counters.fields>;
}

/** Two points, one of each side, that are near at an event's instant. W. */
export interface EventPoint {
  readonly pointA: Point;
  readonly pointB: Point;
  /** Metres; below zero where the two overlap. */
  readonly separation: number;
}

/** One thing that happens to two links, or to a link and an object of a mesh or of what stands still. Metres, seconds, kilograms, W. */
export interface WorldEvent {
  readonly kind: EventKind;
  /** For a leave. Where it is not `apart`, all places and speeds are the last ones before. */
  readonly cause: LeaveCause;
  /** Of what is unresolved. */
  readonly reason: Reason;
  /** Whole microseconds. An enter is never later than it is, a leave never earlier. */
  readonly timeUs: number;
  /** Of one microsecond more, in [0, 1). */
  readonly timeFraction: number;
  /** When what ends here began; else as the time. */
  readonly sinceUs: number;
  readonly sinceFraction: number;
  readonly a: ContactSide;
  readonly b: ContactSide;
  readonly separation: number;
  /** How deep the axis lies where one starts inside; null: as in WorldContact. */
  readonly penetration: number | null;
  /** Unit, from b to a; zero if none is reported. */
  readonly normal: Point;
  /** Velocity of a's point less b's, m/s. */
  readonly velocity: Point;
  /** Along the normal, above zero while the two approach, m/s. */
  readonly approachSpeed: number;
  /** If these two points touch, they do so at a speed between this one and the next. Below zero: a graze, perhaps. */
  readonly approachLower: number;
  readonly approachUpper: number;
  /** Along the normal, of the bodies that were weighed; infinite if neither was. */
  readonly effectiveMass: number;
  /** Up to four, the nearest first. */
  readonly points: readonly EventPoint[];
  /** It rests on a body that was silent, and was taken to hold still. */
  readonly isAssumed: boolean;
}

/** What two do in a part of the time. Everything else is free: proven. */
export interface WorldPart {
  /** `contact`: at most twice the tolerance apart throughout. `unresolved`: nothing is claimed. */
  readonly kind: "contact" | "unresolved";
  readonly reason: Reason;
  readonly fromUs: number;
  readonly fromFraction: number;
  readonly toUs: number;
  readonly toFraction: number;
  /** When it began: at its begin or before. */
  readonly sinceUs: number;
  readonly sinceFraction: number;
  readonly a: ContactSide;
  readonly b: ContactSide;
  readonly beganBefore: boolean;
  /** It ends where the time that was asked does. */
  readonly goesOn: boolean;
  readonly isAssumed: boolean;
}

/** What enters or leaves a trigger. An enter is never later than it is, a leave never earlier. */
export interface TriggerEvent {
  readonly kind: EventKind;
  readonly trigger: number;
  readonly body: number;
  /** The link that enters or leaves; everyLink: none by itself. */
  readonly link: number;
  readonly timeUs: number;
  readonly timeFraction: number;
  readonly sinceUs: number;
  readonly sinceFraction: number;
  readonly isAssumed: boolean;
}

/** What is inside a trigger, or may be. */
export interface Occupant {
  readonly trigger: number;
  readonly body: number;
  /** The link, where the trigger looks at each by itself; else everyLink. */
  readonly link: number;
  readonly isUnresolved: boolean;
  readonly sinceUs: number;
  readonly sinceFraction: number;
}

/** What happened from one follow() to the next. */
export interface WorldEvents {
  readonly fromUs: number;
  readonly toUs: number;
  /** The earliest first; at one instant what ends comes before what begins. */
  readonly events: readonly WorldEvent[];
  /** By pair, then by time. */
  readonly parts: readonly WorldPart[];
  /** Those of World.triggers. */
  readonly triggers: readonly TriggerEvent[];
}

/** How deep a body is in another at an instant. Metres, W. */
export interface Depth {
  /** No translation shorter than this clears. */
  readonly lower: number;
  /** Infinite if no way out could be certified. */
  readonly upper: number;
  /** Moved by it, the body is proven clear; not longer than upper. */
  readonly wayOut: Point;
  readonly isCertified: boolean;
  /** Pairs of pieces that have, or may have, a point in common. */
  readonly pairCount: number;
  readonly isAssumed: boolean;
  /** Of the deepest pair; -1: none. */
  readonly link: number;
  readonly lss: number;
  readonly fromLink: number;
  readonly fromLss: number;
  readonly fromTriangle: number;
}

/** Everything that moves, on one timeline, beside what stands still. */
export class World extends Held {
  readonly triggers: Triggers;
  private readonly joints: number[] = [];
  private following: Follower | null = null;

  /** For the classes beside this one. */
  constructor(machine: Machine, handle: number) {
    super(machine, "world", handle);
    this.triggers = new Triggers(this);
  }

  static made(machine: Machine, still: Scene | null, options: WorldOptions): World {
    return new World(machine, machine.within((room) => {
      const scene = still === null ? 0 : handleOf(still, Scene, machine, "still");
      return room.answered("ft_world_create", scene, writtenWorldOptions(room, options));
    }));
  }

  /** Adds a body and returns its number: 0, 1, 2, ... An avatar touches by its LSS; a scene, in the prop's own frame, by its triangles. It is there from its first pose on. */
  add(shape: Avatar | Scene, options: BodyOptions = {}): number {
    return this.machine.within((room) => {
      if (shape instanceof Scene) return this.added(1, room.answered("ft_world_add_mesh", this.handle, handleOf(shape, Scene, this.machine, "shape"), writtenBodyOptions(room, options)));
      const avatar = handleOf(shape, Avatar, this.machine, "shape");
      return this.added(shape.links.length, room.answered("ft_world_add_avatar", this.handle, avatar, writtenBodyOptions(room, options)));
    });
  }

  /** For the classes beside this one: a body has joined that has so many joints. */
  added(joints: number, body: number): number {
    this.joints[body] = joints;
    return body;
  }

  /** How many joints a body has; a mesh or trigger has 1. */
  jointsOf(body: number): number {
    const joints = this.joints[whole(body, "body")];
    if (joints === undefined) throw new ForetouchError(`body: expected one of the ${this.bodies} that were added, found ${body}`);
    return joints;
  }

  /** How many bodies there are, triggers among them. */
  get bodies(): number {
    return this.joints.length;
  }

  /** The body's next pose: in W, or in the frame of what carries it. Poses of one body come in order; among bodies, in any. */
  push(body: number, timeUs: number, pose: PoseLike): void {
    this.machine.within((room) => this.machine.ask("ft_world_push", this.handle, body, instant(timeUs, "timeUs"), this.poseOf(room, body, pose)));
  }

  /** From then on a link of another body carries it; `pose`: there, in that link's frame. `movesInFrame`: its poses go on in that frame; else it is held fast, without any. */
  attach(body: number, carrier: number, timeUs: number, pose: PoseLike, { link = 0, movesInFrame = false }: { link?: number; movesInFrame?: boolean } = {}): void {
    this.machine.within((room) => {
      const by = room.written(structs.ft_carrier, { body: carrier, link, movesInFrame }, "carrier");
      this.machine.ask("ft_world_attach", this.handle, body, by, instant(timeUs, "timeUs"), this.poseOf(room, body, pose));
    });
  }

  /** From then on nothing carries it; `pose`: there, in W. */
  detach(body: number, timeUs: number, pose: PoseLike): void {
    this.machine.within((room) => this.machine.ask("ft_world_detach", this.handle, body, instant(timeUs, "timeUs"), this.poseOf(room, body, pose)));
  }

  /** Sets whether bodies of two groups are asked if they meet; at first all are. */
  ask(a: number, b: number, isAsked: boolean): void {
    this.machine.ask("ft_world_ask", this.handle, whole(a, "a"), whole(b, "b"), isAsked ? 1 : 0);
  }

  /** The same for bodies of a group and what stands still. */
  askStill(group: number, isAsked: boolean): void {
    this.machine.ask("ft_world_ask_still", this.handle, whole(group, "group"), isAsked ? 1 : 0);
  }

  /** Until when all is known, or taken to be; null before any pose. */
  get knownUntilUs(): number | null {
    return this.known()?.untilUs ?? null;
  }

  /** The body that knownUntilUs waits for; null: none. */
  get waitsFor(): number | null {
    const body = this.known()?.waitsFor ?? -1;
    return body < 0 ? null : body;
  }

  /** The first contact, in the window, of every two links that are asked. It ends at knownUntilUs at the latest. */
  contacts(fromUs: number, toUs: number): WorldContacts {
    return this.machine.within((room) => {
      this.machine.ask("ft_world_answer", this.handle, instant(fromUs, "fromUs"), instant(toUs, "toUs"));
      const counters = room.zeroed(structs.ft_world_counters);
      this.machine.ask("ft_world_get_counters", this.handle, counters);
      return {
        contacts: this.list(room, structs.ft_world_contact, "ft_world_contacts").map((contact) => ({
          ...contact,
          penetration: known(contact.penetration),
          verdict: verdicts[contact.verdict],
          reason: reasons[contact.reason],
          isAssumed: contact.isAssumed === 1,
        })),
        silent: this.list(room, structs.ft_silent_body, "ft_world_silent").map((silent) => ({ ...silent, takenTo: silences[silent.takenTo] })),
        counters: room.read(structs.ft_world_counters, counters),
      };
    });
  }

  /** Lets go of what no window from there on needs; earlier poses and windows are refused. */
  forgetBefore(timeUs: number): void {
    this.machine.ask("ft_world_forget_before", this.handle, instant(timeUs, "timeUs"));
  }

  /** The same by memory: the oldest poses of all, until poseBytes() is at most as many. Returns the instant before which all is forgotten. */
  forgetBeyond(bytes: number): number {
    return this.machine.within((room) => {
      const us = room.doubles([0]);
      this.machine.ask("ft_world_forget_beyond", this.handle, whole(bytes, "bytes"), us);
      return Number(this.machine.view().getBigInt64(us, true));
    });
  }

  /** The bytes that kept poses take: 56 n + 256 for one of n joints. */
  poseBytes(): number {
    return this.machine.within((room) => {
      const bytes = room.integers([0]);
      this.machine.ask("ft_world_pose_bytes", this.handle, bytes);
      return this.machine.view().getUint32(bytes, true);
    });
  }

  /** Lets go of earlier poses between others that say nearly the same: no point is ever farther than so many metres from where all poses that were pushed have it. */
  thinBefore(timeUs: number, metres: number): void {
    this.machine.ask("ft_world_thin_before", this.handle, instant(timeUs, "timeUs"), real(metres, "metres"));
  }

  /** Follows the world from an instant on: nothing before is reported, and what is in contact there starts inside. A world has one follower: another one takes its place. */
  follower(fromUs: number, options: FollowOptions = {}): Follower {
    this.machine.within((room) => {
      const written = room.options("ft_follow_options", structs.ft_follow_options, { ...options });
      this.machine.ask("ft_world_follow_from", this.handle, instant(fromUs, "fromUs"), written);
    });
    return this.followedBy(new Follower(this, fromUs));
  }

  /** For the classes beside this one. */
  followedBy(follower: Follower): Follower {
    this.following = follower;
    return follower;
  }

  /** For the classes beside this one: refuses one in whose place there is another. */
  askFollower(follower: Follower | null): void {
    if (follower !== this.following) throw new ForetouchError("expected the last follower of the world: another one has taken its place");
  }

  /** For the classes beside this one. */
  isFollowed(): boolean {
    return this.following?.hasFollowed === true;
  }

  /** How deep a body is in another one (left out: in what stands still) at an instant, and which way leads out. */
  depth(timeUs: number, body: number, other: number = stillScene, { timeFraction = 0, link = everyLink, otherLink = everyLink }: { timeFraction?: number; link?: number; otherLink?: number } = {}): Depth {
    return this.machine.within((room) => {
      instant(timeUs, "timeUs");
      const question = room.written(structs.ft_depth_question, { body, link, fromBody: other, fromLink: otherLink, timeUs, timeFraction }, "depth");
      const at = room.zeroed(structs.ft_depth);
      this.machine.ask("ft_world_depth", this.handle, question, at);
      const depth = room.read(structs.ft_depth, at);
      return { ...depth, isCertified: depth.isCertified === 1, isAssumed: depth.isAssumed === 1 };
    });
  }

  /** What a shape meets at an instant, also in the past: with a direction, what it hits on its way; within a distance, what is nearest to it; else what it overlaps. */
  probe(time: AskTime, shape: AskShape, options: AskOptions = {}): WorldAnswer {
    return probed(this.machine, this.handle, time, shape, options);
  }

  /** Many questions in one call: each answer is that of probe(), to the bit. */
  probeMany(questions: readonly AskQuestion[]): WorldAnswer[] {
    return manyProbed(this.machine, this.handle, questions);
  }

  /** What a shape that flies straight by `way` hits first while the bodies move. */
  fly(fromUs: number, toUs: number, shape: AskShape, way: ArrayLike<number>, whom: AskWhom = {}): FlightAnswer {
    return flown(this.machine, this.handle, fromUs, toUs, shape, way, whom);
  }

  /** For the classes beside this one. */
  list<M extends Fields>(room: Room, struct: Struct<M>, name: string): Values<M>[] {
    return room.list(struct, name, this.handle);
  }

  /** For the classes beside this one. */
  poseOf(room: Room, body: number, pose: PoseLike): number {
    return writtenPose(room, pose, this.jointsOf(body), "pose");
  }

  private known(): { readonly untilUs: number; readonly waitsFor: number } | null {
    if (!this.hasPoses()) return null;
    return this.machine.within((room) => {
      const until = room.doubles([0]), waitsFor = room.integers([0]);
      this.machine.ask("ft_world_known_until", this.handle, until, waitsFor);
      const view = this.machine.view();
      return { untilUs: Number(view.getBigInt64(until, true)), waitsFor: view.getInt32(waitsFor, true) };
    });
  }

  private hasPoses(): boolean {
    const isEmpty = 110; // FT_ERROR_EMPTY: no body has a pose
    return this.machine.call("ft_world_known_until", this.handle, 0, 0) !== isEmpty;
  }
}

export interface FollowOptions {
  /** Where time is cut: at the multiples of so many microseconds, less work for many bodies with clocks of their own; what is after the last multiple waits. Left out: at every pose of any body. */
  readonly cutUs?: number;
}

/** Reports which body enters and leaves which, each once, at its own instant, however many happen between two poses. */
export class Follower {
  /** For the classes beside this one. */
  hasFollowed = false;

  constructor(
    private readonly world: World,
    private untilUs: number,
  ) {}

  /**
   * What a body weighs, for effective masses; nothing moves the others. Alone, `kg` is what the LSS
   * of an avatar weigh in all. A rigid body may say its `center` and its `inertia` about that, nine
   * numbers, row after row, in its frame; a mesh must.
   */
  weigh(body: number, kg: number, { center, inertia }: { center?: Point; inertia?: ArrayLike<number> } = {}): void {
    const { machine, handle } = this.followed();
    this.world.jointsOf(body);
    if (center === undefined && inertia === undefined) return machine.ask("ft_world_weigh_avatar", handle, body, real(kg, "kg"));
    if (center === undefined || inertia?.length !== 9) throw new ForetouchError("expected both a center and an inertia of nine numbers");
    machine.within((room) => machine.ask("ft_world_weigh", handle, body, real(kg, "kg"), room.doubles(point(center, "center")), room.doubles(inertia)));
  }

  /** Everything that happens from where the last call ended until then, which is knownUntilUs at the latest. */
  follow(untilUs: number): WorldEvents {
    const { machine, handle } = this.followed();
    return machine.within((room) => {
      const fromUs = this.untilUs;
      machine.ask("ft_world_follow", handle, instant(untilUs, "untilUs"));
      this.hasFollowed = true;
      this.untilUs = room.instantOf("ft_world_followed", handle, 0);
      return {
        fromUs,
        toUs: this.untilUs,
        events: room.list(structs.ft_event, "ft_world_events", handle).map(eventOf),
        parts: room.list(structs.ft_part, "ft_world_parts", handle).map(partOf),
        triggers: room.list(structs.ft_trigger_event, "ft_world_trigger_events", handle).map((event) => ({
          ...event,
          kind: eventKinds[event.kind],
          isAssumed: event.isAssumed === 1,
        })),
      };
    });
  }

  /** What is in contact, or unresolved, where the last follow() ended, and since when. */
  get open(): readonly WorldPart[] {
    const { machine, handle } = this.followed();
    return machine.within((room) => room.list(structs.ft_part, "ft_world_open_parts", handle).map(partOf));
  }

  get followedUntilUs(): number {
    return this.untilUs;
  }

  private followed(): World {
    this.world.askFollower(this);
    return this.world;
  }
}

export interface TriggerOptions {
  /** Left out: 31. Triggers of one group do not meet each other, nor what stands still. */
  readonly group?: number;
  /** Left out: "hold-still". */
  readonly whenSilent?: WhenSilent;
  /** Each link enters and leaves by itself; left out: a body is inside while any of its links is. */
  readonly byLink?: boolean;
}

/** Volumes of a world that report what is in them, along with what its follower reports. Each is a body of the world: stand() puts it somewhere, or World.push() and attach() move body(trigger). */
export class Triggers {
  private readonly bodies: number[] = [];

  constructor(private readonly world: World) {}

  /** A box around the origin of its frame, by its number: 0, 1, 2, ... */
  addBox(halfExtents: Point, options: TriggerOptions = {}): number {
    return this.add("ft_world_add_trigger_box", (room) => room.doubles(point(halfExtents, "halfExtents")), options);
  }

  addSphere(radius: number, options: TriggerOptions = {}): number {
    return this.add("ft_world_add_trigger_sphere", () => real(radius, "radius"), options);
  }

  /** What is inside some object of a scene, each of which must be closed. */
  addMesh(closed: Scene, options: TriggerOptions = {}): number {
    return this.add("ft_world_add_trigger_mesh", () => handleOf(closed, Scene, this.world.machine, "closed"), options);
  }

  /** The trigger's body in the world. */
  body(trigger: number): number {
    const body = this.bodies[whole(trigger, "trigger")];
    if (body === undefined) throw new ForetouchError(`trigger: expected one of ${this.bodies.length}, found ${trigger}`);
    return body;
  }

  /** Puts one that has no pose where it stays, for eleven days; then answers say that they rest on it (`isAssumed`). */
  stand(trigger: number, fromUs: number, pose: PoseLike): void {
    const { machine, handle } = this.world;
    machine.within((room) => machine.ask("ft_world_stand_trigger", handle, whole(trigger, "trigger"), instant(fromUs, "fromUs"), writtenPose(room, pose, 1, "pose")));
  }

  /** Looks at this body, or at this link of it, instead of at all bodies. Before the follower's first follow(). */
  watch(trigger: number, body: number, link: number = everyLink): void {
    this.world.machine.ask("ft_world_watch", this.world.handle, whole(trigger, "trigger"), whole(body, "body"), whole(link, "link"));
  }

  /** What is inside, or may be, where the last follow() ended. */
  get occupants(): readonly Occupant[] {
    if (!this.world.isFollowed()) return [];
    return this.world.machine.within((room) => this.world.list(room, structs.ft_occupant, "ft_world_occupants").map((occupant) => ({
      ...occupant,
      isUnresolved: occupant.isUnresolved === 1,
    })));
  }

  private add(name: string, volume: (room: Room) => number, { whenSilent, ...others }: TriggerOptions): number {
    const { machine, handle } = this.world;
    return machine.within((room) => {
      const options = room.options("ft_trigger_options", structs.ft_trigger_options, { ...others, whenSilent: numberOf(silences, whenSilent, "whenSilent") });
      const trigger = room.integers([0]);
      this.bodies.push(this.world.added(1, room.answered(name, handle, volume(room), options, trigger)));
      return machine.view().getInt32(trigger, true);
    });
  }
}

function eventOf({ pointCount, points0, points1, points2, points3, ...event }: Values<typeof structs.ft_event.fields>): WorldEvent {
  return {
    ...event,
    penetration: known(event.penetration),
    kind: eventKinds[event.kind],
    cause: leaveCauses[event.cause],
    reason: reasons[event.reason],
    isAssumed: event.isAssumed === 1,
    points: [points0, points1, points2, points3].slice(0, pointCount),
  };
}

function partOf({ isContact, ...part }: Values<typeof structs.ft_part.fields>): WorldPart {
  return {
    ...part,
    kind: isContact === 1 ? "contact" : "unresolved",
    reason: reasons[part.reason],
    isAssumed: part.isAssumed === 1,
    beganBefore: part.beganBefore === 1,
    goesOn: part.goesOn === 1,
  };
}

/** For the classes beside these. */
export function writtenWorldOptions(room: Room, options: WorldOptions): number {
  return room.options("ft_world_options", structs.ft_world_options, options as Writes<typeof structs.ft_world_options.fields>);
}

/** For the classes beside these. */
export function writtenBodyOptions(room: Room, { whenSilent, ...others }: BodyOptions): number {
  return room.options("ft_body_options", structs.ft_body_options, { ...others, whenSilent: numberOf(silences, whenSilent, "whenSilent") });
}
