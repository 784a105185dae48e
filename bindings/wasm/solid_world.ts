// Solid avatars in a world in which other things move: doors push them, what they hold is solid with
// them, two of them meet and neither passes; and what they press against is reported from enter to leave.

import { handleOf, instant, type Machine, numberOf } from "./machine.js";
import { Avatar, type Pose, type PoseLike, Scene, writtenPose } from "./shapes.js";
import { type SolidContact, type SolidOptions, type SolidTick, tickFrom, wayFrom, writtenFlags, writtenSolidOptions } from "./solid.js";
import * as structs from "./structs.js";
import { type BodyOptions, Follower, World, type WorldEvents, type WorldOptions, writtenBodyOptions, writtenWorldOptions } from "./world.js";

export const reaches = ["skin", "surface"] as const;

export interface SolidWorldOptions extends WorldOptions {
  /** Solid avatars are found in contact with what they press against ("skin", if left out), or only with what crushes them ("surface"). */
  readonly reach?: (typeof reaches)[number];
}

/** A moving body that holds or pushes a solid avatar: `link` is the avatar's, the place is on the body's surface, what the body's own motion adds to the push is in it, and the slip is along that surface, which moves. */
export interface SolidBodyContact extends SolidContact {
  readonly body: number;
  /** Which of the link's LSS; those of tools in its hand come after its own. */
  readonly lss: number;
  /** The mesh's; -1: none. */
  readonly triangle: number;
}

/** A body that nothing holds back has left a solid avatar no proven way: between the two nothing is claimed from `sinceUs` on. Everything else stays proven. */
export interface SolidCrush {
  readonly body: number;
  /** Where it was met; while they overlap, the link that is deepest. */
  readonly link: number;
  readonly sinceUs: number;
  /** It ended at the tick's begin, where the two are proven apart; reported once. */
  readonly isOver: boolean;
  /** How deep a link's axis is below the body's surface at the tick's end; 0: no overlap there. */
  readonly depth: number;
}

/** What a solid avatar among moving bodies shows at one tick, and what they do to it. */
export interface SolidBodyTick {
  readonly body: number;
  /** As for a Solid; its contacts are those with what stands still. Moving bodies are part of what it proves. */
  readonly tick: SolidTick;
  readonly contacts: readonly SolidBodyContact[];
  readonly crushes: readonly SolidCrush[];
  /** What its hands hold and is solid with it. */
  readonly tools: readonly number[];
  /** What they hold that touched something where it was taken: nothing is claimed of it yet. */
  readonly looseTools: readonly number[];
  /** What they let go of and still touch: the two are not asked until they are apart. */
  readonly letGo: readonly number[];
  /** A body around it was silent, and was taken to hold still or to be nowhere. */
  readonly isAssumed: boolean;
}

/** Where the tracker says that a solid avatar is at the end of a tick. */
export interface SolidTarget {
  readonly body: number;
  readonly pose: PoseLike;
  /** Per joint false if its tracker lost it. */
  readonly isTracked?: ArrayLike<boolean> | undefined;
}

export class SolidWorld {
  /** Add what moves by itself, push its poses, attach what hands hold. Only tick() moves solid avatars. */
  readonly world: World;
  /** Weighs bodies, and says what is in contact now. */
  readonly follower: Follower;
  private readonly machine: Machine;
  private readonly solids = new Set<number>();
  private shown = new Set<number>();

  constructor(machine: Machine, still: Scene, beginUs: number, { reach = "skin", ...options }: SolidWorldOptions) {
    this.machine = machine;
    this.world = new World(machine, machine.within((room) => {
      const scene = handleOf(still, Scene, machine, "still"), reaching = numberOf(reaches, reach, "reach") ?? 0;
      return room.answered("ft_solid_world_create", scene, instant(beginUs, "beginUs"), reaching, writtenWorldOptions(room, options));
    }));
    this.follower = this.world.followedBy(new Follower(this.world, beginUs));
  }

  /** Adds a solid avatar and returns its number among all bodies; it is there from its first target on. Options: a Solid's, without `maySnap`, and those of World.add(). */
  add(avatar: Avatar, { group, whenSilent, ...options }: SolidOptions & BodyOptions = {}): number {
    return this.machine.within((room) => {
      const shape = handleOf(avatar, Avatar, this.machine, "avatar");
      const body = writtenBodyOptions(room, { ...(group !== undefined && { group }), ...(whenSilent !== undefined && { whenSilent }) });
      const number = room.answered("ft_solid_world_add", this.world.handle, shape, writtenSolidOptions(room, options), body);
      this.solids.add(number);
      return this.world.added(avatar.links.length, number);
    });
  }

  /**
   * One tick, from the last one's end until `timeUs`. An avatar without a target keeps its last. Answers
   * for all that have had one, by their numbers: what to draw is `tick.shown` of each.
   */
  tick(timeUs: number, targets: readonly SolidTarget[]): SolidBodyTick[] {
    return this.machine.within((room) => {
      const all = room.array(structs.ft_solid_target, targets.map(({ body, pose, isTracked }, i) => {
        const joints = this.world.jointsOf(body);
        return { body, pose: writtenPose(room, pose, joints, `targets[${i}]`), isTracked: writtenFlags(room, joints, isTracked) };
      }), "targets");
      this.machine.ask("ft_solid_world_tick", this.world.handle, instant(timeUs, "timeUs"), all, targets.length);
      for (const { body } of targets) this.shown.add(body);
      return [...this.solids].filter((body) => this.shown.has(body)).map((body) => this.told(body));
    });
  }

  /** What has happened from where the last call ended until the last tick's end. Before World.forgetBefore(). */
  follow(): WorldEvents {
    return this.follower.follow(this.timeUs);
  }

  /** Where the last tick ended. */
  get timeUs(): number {
    return this.machine.within((room) => room.instantOf("ft_solid_world_at", this.world.handle));
  }

  /** Piece `index` of a solid avatar's way in the last tick: when it is reached, in (0, 1] of the tick, and the pose that it ends with. */
  way(body: number, index: number): { readonly time: number; readonly pose: Pose } {
    return wayFrom(this.machine, "ft_solid_world_way", this.world.jointsOf(body), index, this.world.handle, body);
  }

  dispose(): void {
    this.world.dispose();
  }

  private told(body: number): SolidBodyTick {
    const { handle } = this.world;
    return this.machine.within((room) => {
      const at = room.zeroed(structs.ft_solid_tick);
      const isAssumed = room.answered("ft_solid_world_get_tick", handle, body, at) === 1;
      const held = room.list(structs.ft_solid_held, "ft_solid_world_held", handle, body);
      const [tools, looseTools, letGo] = [0, 1, 2].map((state) => held.filter((one) => one.state === state).map((one) => one.body));
      return {
        body,
        tick: tickFrom(room, at, "ft_solid_world", this.world.jointsOf(body), handle, body),
        contacts: room.list(structs.ft_solid_body_contact, "ft_solid_world_body_contacts", handle, body),
        crushes: room.list(structs.ft_solid_crush, "ft_solid_world_crushes", handle, body).map((crush) => ({ ...crush, isOver: crush.isOver === 1 })),
        tools,
        looseTools,
        letGo,
        isAssumed,
      };
    });
  }
}
