// A world of a host's things: what stands still, what moves, skeletons, hands that pass through
// nothing; and what touches what, from enter to leave. A host (three.js, Babylon.js) says how its
// objects are read, and reports events in its own way.

import { ForetouchError, type Point } from "../machine.js";
import type { SolidContact, SolidOptions } from "../solid.js";
import type { SolidTarget, SolidWorldOptions } from "../solid_world.js";
import type { ContactSide } from "../ask.js";
import { type BodyOptions, stillScene, type WorldEvent } from "../world.js";
import type { BodyOrder, EngineLike, Hold, Move, Told } from "./engine.js";
import { framesOf, intoFrame, localPose, poseRoom, RigidPart, worldFrames } from "./frames.js";
import { gathered, type HostMesh, type Note } from "./geometry.js";
import { JointMember, type JointSource, type Member, RigidMember, type RigidSource } from "./members.js";
import type { Press, Touch } from "./touches.js";

/** Two meshes are not asked about each other: a world that reports touches cannot. */
export interface TouchWorldOptions extends Omit<SolidWorldOptions, "asksMeshes"> {
  /** Seconds between two updates beyond which nothing is swept: the page was away. Left out: 0.5. Solid bodies go on from where they are shown, or after five seconds from where they are tracked. */
  readonly longestStep?: number;
}

/** Microseconds; a solid body that was away for longer is placed anew where it is tracked. */
const longestAway = 5e6;
const moment = 1000;

type Later = void | Promise<void>;
const isLater = (value: unknown): value is Promise<unknown> => value instanceof Promise;

export class TouchWorld<O> {
  private readonly members: Member<O>[] = [];
  /** What is not in the world yet: hands that no tracker has seen. */
  private readonly waiting: { readonly source: JointSource<O>; readonly add: (links: NonNullable<ReturnType<JointSource<O>["links"]>>) => void }[] = [];
  private byBody: Member<O>[] = [];
  private stillObjects: readonly O[] = [];
  private readonly open = new Map<string, WorldEvent>();
  private readonly said = new Set<string>();
  private holds: { member: RigidMember<O>; hold: Hold }[] = [];
  private sending: Promise<unknown>[] = [];
  private shapes = 0;
  private timeUs = -Infinity;
  private mustBegin = true;
  private isAnew = true;
  private running: Promise<void> | null = null;

  /** `note`: what a person should know; `of`: about which of the host's objects. Each comes once. */
  constructor(
    private readonly engine: EngineLike,
    readonly mirror: 1 | -1,
    private readonly note: Note<O>,
    private readonly told: (touch: Touch<O>) => void,
    private readonly options: TouchWorldOptions = {},
  ) {}

  /** What stands still, in place of what stood before. The world begins anew with the next update. */
  stand(meshes: Iterable<HostMesh<O>>): void {
    const still = gathered(meshes, this.mirror, this.say);
    this.stillObjects = still?.objects ?? [];
    this.send(this.engine.stands(still?.arrays ?? null));
    this.mustBegin = true;
  }

  /** Something that moves as a whole; its meshes' matrices are those of now. */
  addRigid(source: RigidSource<O>, meshes: Iterable<HostMesh<O>>, options: BodyOptions = {}): RigidMember<O> {
    const part = new RigidPart(source.name, source.matrix(), this.mirror), frame = framesOf(1);
    part.read(source.matrix(), frame, 0);
    const mesh = gathered(meshes, this.mirror, this.say, frame);
    if (mesh === null) throw new ForetouchError(`${source.name}: expected meshes with triangles below it, found none`);
    return this.join(new RigidMember(this.shapes, { mesh: mesh.arrays }, source, part, mesh.objects, options));
  }

  /** Something with joints. Solid: it is shown where nothing is in its way; `then`: once its links are known. */
  addJoints(source: JointSource<O>, options: SolidOptions & BodyOptions, isSolid: boolean, then: (member: JointMember<O>) => void): void {
    const add = (links: Parameters<(typeof this.waiting)[number]["add"]>[0]): void => then(this.join(new JointMember(this.shapes, links, source, options, isSolid)));
    const links = source.links();
    if (links === null) this.waiting.push({ source, add });
    else add(links);
  }

  /** Removes all that has this object. */
  remove(object: O): void {
    for (const member of this.members) if (member.source.object === object) this.leave(member);
    const kept = this.waiting.filter(({ source }) => source.object !== object);
    this.waiting.splice(0, this.waiting.length, ...kept);
  }

  /** From the last shown pose on a link carries it, where it is now: it is solid with a solid body. Until letGo(), or a gap. */
  hold(member: RigidMember<O>, by: JointMember<O>, link: string): void {
    const number = by.links.findIndex(({ name }) => name === link);
    if (number < 0) throw new ForetouchError(`${by.source.name}: expected one of its joints, found ${link}`);
    if (member.body < 0 || by.body < 0 || by.tick === null) throw new ForetouchError(`${member.source.name}: expected an update of both before one is held`);
    const places = member.frames.places.slice();
    intoFrame(by.shown, number, places);
    const both = { rotations: Float64Array.of(...by.shown.rotations.subarray(4 * number, 4 * number + 4), ...member.frames.rotations), places: Float64Array.of(...by.shown.places.subarray(3 * number, 3 * number + 3), ...member.frames.places) };
    const local = localPose([-1, 0], both, poseRoom(2)), pose = { rotations: local.rotations.slice(4), translations: local.translations.slice(3) };
    member.held = { by, link: number, pose };
    this.holds.push({ member, hold: { body: member.body, by: { body: by.body, link: number }, pose } });
  }

  letGo(member: RigidMember<O>): void {
    if (member.held === null) return;
    member.held = null;
    this.holds = this.holds.filter((one) => one.member !== member);
    this.holds.push({ member, hold: { body: member.body, by: null, pose: localPose([-1], member.frames, poseRoom(1)) } });
  }

  /** Nothing between the last update and the next one is swept: the user was teleported. */
  restart(): void {
    this.mustBegin = this.isAnew = true;
  }

  /** Once per frame, `timeMs` on any clock that goes on: reads where all are, and shows and reports what follows. With an engine in a worker it goes on meanwhile, and frames that come too early are left out. */
  update(timeMs: number): Later {
    if (this.running !== null) return this.running;
    const timeUs = Math.round(1000 * timeMs);
    if (!Number.isSafeInteger(timeUs)) throw new ForetouchError(`update(): expected milliseconds, as requestAnimationFrame() gives them, found ${timeMs}`);
    if (timeUs <= this.timeUs && this.timeUs - timeUs < 1e5 && !this.mustBegin) return;
    this.admit();
    this.isAnew = this.isAnew || timeUs <= this.timeUs || timeUs - this.timeUs > longestAway;
    const isGap = timeUs <= this.timeUs || timeUs - this.timeUs > 1e6 * (this.options.longestStep ?? 0.5);
    const seen = this.members.filter((member) => this.reads(member));
    // Without members there is nothing to ask: it begins with the first.
    if (seen.length === 0) this.mustBegin = true;
    if (seen.length === 0 && this.byBody.length === 0) return;
    let done: Later;
    try {
      const first = this.mustBegin || isGap ? this.begins(timeUs, seen) : undefined, second = this.step(timeUs, seen);
      done = isLater(first) || isLater(second) ? Promise.all([first, second]).then(() => undefined) : undefined;
    } catch (reason) {
      return this.failed(reason);
    }
    if (!isLater(done)) return;
    this.running = done.catch((reason: unknown) => this.failed(reason)).finally(() => (this.running = null));
    return this.running;
  }

  /** Where surfaces hold or push a solid body, as of the last update. */
  presses(member: JointMember<O>): Press<O>[] {
    if (member.tick === null) return [];
    const { tick, contacts } = member.tick;
    const press = (contact: SolidContact, body: number): Press<O> => ({
      link: member.linkName(contact.link),
      object: this.objectAt(body, contact.object),
      point: this.toHost(contact.point),
      normal: this.toHost(contact.normal),
      push: contact.push,
      slipSpeed: contact.slipSpeed,
      gap: contact.gap,
    });
    // Own links, which keep each other apart, are not a surface that it touches.
    const still = tick.contacts.filter(({ triangle }) => triangle >= 0);
    return [...still.map((contact) => press(contact, stillScene)), ...contacts.map((contact) => press(contact, contact.body))];
  }

  dispose(): void {
    this.send(this.engine.dispose());
  }

  toHost([x, y, z]: Point): Point {
    return [x, y, this.mirror * z];
  }

  readonly say: Note<O> = (words, of) => {
    if (this.said.has(words)) return;
    this.said.add(words);
    this.note(words, of);
  };

  private join<M extends Member<O>>(member: M): M {
    this.send(this.engine.shape(this.shapes++, member.made));
    this.members.push(member);
    return member;
  }

  private leave(member: Member<O>): void {
    member.isOut = true;
    this.mustBegin = true;
  }

  /** Lets in those whose links have become known. */
  private admit(): void {
    for (const one of this.waiting.splice(0)) {
      const links = one.source.links();
      if (links === null) this.waiting.push(one);
      else one.add(links);
    }
  }

  /** False: it is not in the world, or not any more. */
  private reads(member: Member<O>): boolean {
    if (member.isOut) return false;
    try {
      return member instanceof RigidMember && member.held !== null ? true : member.read();
    } catch (reason) {
      this.say(wordsOf(reason), member.source.object);
      this.leave(member);
      return false;
    }
  }

  /** Begins two moments before; in the first, solid bodies are where they were: so there is an answer even where every frame takes too long. */
  private begins(timeUs: number, seen: readonly Member<O>[]): Later {
    this.begin(timeUs - 2 * moment, seen);
    return this.step(timeUs - moment, seen);
  }

  private begin(timeUs: number, seen: readonly Member<O>[]): void {
    for (const event of this.open.values()) this.tellBoth({ ...event, kind: "leave", timeUs: this.timeUs, timeFraction: 0 }, "gap");
    this.open.clear();
    this.holds = [];
    for (const member of this.members) {
      member.body = -1;
      if (member instanceof RigidMember) member.held = null;
      if (!(member instanceof JointMember)) continue;
      // Nothing passes a wall because a frame took too long.
      member.resumes = this.isAnew ? null : (member.tick?.tick.shown ?? member.resumes);
      member.tick = null;
    }
    for (const member of this.members.filter(({ isOut }) => isOut)) this.send(this.engine.forget(member.shape));
    this.members.splice(0, this.members.length, ...this.members.filter(({ isOut }) => !isOut));
    this.byBody = [...seen];
    this.byBody.forEach((member, body) => (member.body = body));
    const { longestStep, ...options } = this.options;
    this.send(this.engine.begin(timeUs, options, this.byBody.map((member) => this.orderOf(member))));
    this.timeUs = timeUs;
    this.mustBegin = this.isAnew = false;
  }

  private step(timeUs: number, seen: readonly Member<O>[]): Later {
    const moves: Move[] = [], targets: SolidTarget[] = [];
    for (const member of seen) {
      const { body, pose, isSolid } = member;
      if (isSolid) {
        if (body < 0) this.comes(timeUs, member);
        const { isTracked, links, resumes } = member as JointMember<O>;
        targets.push({ body: member.body, pose: resumes ?? pose, isTracked: isTracked || resumes !== null ? undefined : links.map(() => false) });
        (member as JointMember<O>).resumes = null;
      } else if (body < 0) this.comes(timeUs, member);
      else if (!(member instanceof RigidMember && member.held !== null)) moves.push({ body, pose });
    }
    const holds = this.holds.splice(0).map(({ hold }) => hold);
    const told = this.engine.tick({ timeUs, moves, targets, holds });
    this.timeUs = timeUs;
    return this.settled(() => (isLater(told) ? told.then((told) => this.apply(told)) : this.apply(told)));
  }

  private comes(timeUs: number, member: Member<O>): void {
    member.body = this.byBody.push(member) - 1;
    this.send(this.engine.join(timeUs, this.orderOf(member)));
  }

  private orderOf({ shape, isSolid, options, pose }: Member<O>): BodyOrder {
    return { shape, isSolid, options, pose: isSolid ? null : pose };
  }

  private apply(told: Told): void {
    for (const solid of told.solids) {
      const member = this.byBody[solid.body] as JointMember<O>;
      member.tick = solid;
      worldFrames(member.source.parents, solid.tick.shown, member.shown);
      member.source.show?.(member.shown, solid);
    }
    for (const member of this.byBody) if (member instanceof RigidMember && member.held !== null) this.carry(member, member.held);
    for (const event of told.events) this.tell(event);
  }

  private carry(member: RigidMember<O>, { by, link, pose }: NonNullable<RigidMember<O>["held"]>): void {
    const both = framesOf(2), rotations = Float64Array.of(...by.shown.rotations.subarray(4 * link, 4 * link + 4), ...pose.rotations);
    worldFrames([-1, 0], { rotations, translations: Float64Array.of(...by.shown.places.subarray(3 * link, 3 * link + 3), ...pose.translations) }, both);
    member.frames.rotations.set(both.rotations.subarray(4));
    member.frames.places.set(both.places.subarray(3));
    member.place(member.frames);
  }

  private tell(event: WorldEvent): void {
    const key = [event.a, event.b].map(({ body, link, object }) => `${body} ${link} ${object}`).join(" ");
    if (event.kind === "enter" || event.kind === "starts_inside") this.open.set(key, event);
    if (event.kind === "leave") this.open.delete(key);
    this.tellBoth(event, event.cause);
  }

  private tellBoth(event: WorldEvent, cause: Touch<O>["cause"]): void {
    this.tellOne(event, event.a, event.b, 1, cause, true);
    this.tellOne(event, event.b, event.a, -1, cause, event.a.body < 0);
  }

  private tellOne(event: WorldEvent, own: ContactSide, other: ContactSide, sign: 1 | -1, cause: Touch<O>["cause"], isFirst: boolean): void {
    const member = this.byBody[own.body];
    if (member === undefined) return;
    const [x, y, z] = this.toHost(event.normal);
    const touch: Touch<O> = {
      kind: event.kind,
      cause,
      reason: event.reason,
      time: 1e-6 * (event.timeUs + event.timeFraction),
      link: member.linkName(own.link),
      object: this.objectAt(other.body, other.object),
      otherLink: this.byBody[other.body]?.linkName(other.link) ?? null,
      point: this.toHost(own.point),
      normal: [sign * x, sign * y, sign * z],
      approachSpeed: event.approachSpeed,
      isAssumed: event.isAssumed,
    };
    member.source.tell?.(touch);
    if (isFirst) this.told(touch);
  }

  private objectAt(body: number, object: number): O | null {
    return body === stillScene ? (this.stillObjects[object] ?? null) : (this.byBody[body]?.objectOf(object) ?? null);
  }

  /** What a worker has been sent must have come to pass before what follows counts. */
  private send(answer: unknown): void {
    if (!isLater(answer)) return;
    // What waits for it learns of the failure; nothing else needs to.
    answer.catch(() => undefined);
    this.sending.push(answer);
  }

  private settled(then: () => Later): Later {
    if (this.sending.length === 0) return then();
    return Promise.all(this.sending.splice(0)).then(then);
  }

  private failed(reason: unknown): void {
    if (!(reason instanceof ForetouchError)) throw reason;
    this.say(reason.message, null);
    this.mustBegin = true;
  }
}

const wordsOf = (reason: unknown): string => (reason instanceof Error ? reason.message : String(reason));
