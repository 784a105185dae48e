// An avatar that passes through nothing.

import { Held, handleOf, type Machine, numberOf, type Point, real, type Room, whole, type Writes } from "./machine.js";
import { Avatar, type Pose, type PoseLike, poseFrom, Scene, writtenPose } from "./shapes.js";
import * as structs from "./structs.js";

export const solidStates = ["placing", "equal", "following", "sliding", "held", "around", "snapped"] as const;
export type SolidState = (typeof solidStates)[number];
export const solidJointStates = ["free", "sliding", "held", "lost"] as const;
export type SolidJointState = (typeof solidJointStates)[number];
export const solidLimits = ["none", "budget", "catch-up", "inside"] as const;
export type SolidLimit = (typeof solidLimits)[number];
const floors = ["lift", "hold"] as const;

/** A place where a surface holds the shown pose from the tracked one. */
export interface SolidContact {
  readonly link: number;
  readonly lss: number;
  readonly triangle: number;
  readonly object: number;
  readonly point: Point;
  /** Unit, from the surface to the link. */
  readonly normal: Point;
  readonly gap: number;
  /** How hard the tracked pose presses, in metres: times a stiffness (N/m) it is a force. */
  readonly push: number;
  /** Along the surface, m/s. */
  readonly slipSpeed: number;
}

export interface SolidTick {
  readonly shown: Pose;
  readonly state: SolidState;
  readonly limit: SolidLimit;
  /** Proven: on the whole way from the pose shown before, the avatar touches nothing. */
  readonly isCertified: boolean;
  /** It appeared where its way begins: its first place, or one after it was inside. */
  readonly hasAppeared: boolean;
  /** The largest of all links. */
  readonly deviation: number;
  readonly lift: number;
  /** Lower bound on the separation on the whole way; infinite if it did not move. */
  readonly clearance: number;
  /** Seconds until it snaps, if nothing changes; below 0: it does not. */
  readonly snapInS: number;
  /** Pieces of the way (Solid.way). */
  readonly wayCount: number;
  readonly joints: readonly { readonly state: SolidJointState; readonly deviation: number }[];
  readonly contacts: readonly SolidContact[];
}

/** Metres and seconds. What is left out is as docs/solid.md says. */
export interface SolidOptions {
  /** Gap that it keeps to surfaces where it can. */
  readonly skin?: number;
  /** The proofs' tolerance; left out: a quarter of the skin. */
  readonly tolerance?: number;
  /** A tracked body whose feet are below the floor is lifted whole; left out: it is. */
  readonly liftsFeet?: boolean;
  /** How much faster than the tracked pose it may move to catch up, m/s. */
  readonly catchUp?: number;
  /** Unit. */
  readonly up?: Point;
  readonly mostLift?: number;
  /** Farther off than this, whole or by a limb, for longer than `patience`, it may snap if `maySnap`. */
  readonly mostDeviation?: number;
  readonly mostLimbDeviation?: number;
  readonly patience?: number;
  readonly snapNotice?: number;
  /** How far off a free place may be. */
  readonly placingReach?: number;
  readonly maySnap?: boolean;
  /** Motions tried for a way around, per tick and per target; 0: never. */
  readonly aroundPerTick?: number;
  readonly aroundInAll?: number;
  /** Per tick, in evaluations of a pair. */
  readonly workBudget?: number;
  /** Per link: how much its error counts beyond its area; left out: by the links' names. */
  readonly visibility?: ArrayLike<number>;
  /** Per link: whether `liftsFeet` listens to it; left out: by the links' names. */
  readonly feet?: ArrayLike<boolean>;
}

export class Solid extends Held {
  private readonly links: number;

  constructor(machine: Machine, scene: Scene, avatar: Avatar, options: SolidOptions) {
    super(machine, "solid", machine.within((room) => {
      const scenery = handleOf(scene, Scene, machine, "scene"), body = handleOf(avatar, Avatar, machine, "avatar");
      return room.answered("ft_solid_create", scenery, body, writtenSolidOptions(room, options));
    }));
    this.links = avatar.links.length;
  }

  /**
   * One tick: the shown pose goes as near to the tracked one as surfaces let it. `seconds`: since the
   * last tick, above 0 and at most 10. `isTracked`: per joint false if its tracker lost it.
   */
  follow(tracked: PoseLike, seconds: number, isTracked?: ArrayLike<boolean>): SolidTick {
    return this.machine.within((room) => {
      const pose = writtenPose(room, tracked, this.links, "tracked"), at = room.zeroed(structs.ft_solid_tick);
      this.machine.ask("ft_solid_follow", this.handle, pose, writtenFlags(room, this.links, isTracked), real(seconds, "seconds"), at);
      return tickFrom(room, at, "ft_solid", this.links, this.handle);
    });
  }

  /** Piece `index` of the last tick's way: when it is reached, in (0, 1] of the tick, and the pose that it ends with. */
  way(index: number): { readonly time: number; readonly pose: Pose } {
    return wayFrom(this.machine, "ft_solid_way", this.links, index, this.handle);
  }

  /** Goes on in another scene. If it is inside something there, it stays until a tick finds a free place. */
  changeScene(scene: Scene): void {
    this.machine.ask("ft_solid_change_scene", this.handle, handleOf(scene, Scene, this.machine, "scene"));
  }

  /** Forgets the shown pose: the user was teleported. `place`: where it begins, outside of everything; left out: at the next tracked pose. */
  reset(place?: PoseLike): void {
    if (place === undefined) this.machine.ask("ft_solid_reset", this.handle);
    else this.machine.within((room) => this.machine.ask("ft_solid_reset_at", this.handle, writtenPose(room, place, this.links, "place")));
  }
}

// The same for a solid avatar in a world, whose functions have other names and one argument more.

export function writtenSolidOptions(room: Room, { liftsFeet, visibility, feet, tolerance, ...others }: SolidOptions): number {
  return room.options("ft_solid_options", structs.ft_solid_options, {
    ...(others as Writes<typeof structs.ft_solid_options.fields>),
    tolerance: tolerance ?? (others.skin === undefined ? undefined : others.skin / 4),
    floor: liftsFeet === undefined ? undefined : numberOf(floors, liftsFeet ? "lift" : "hold", "liftsFeet"),
    ...(visibility !== undefined && { visibility: room.doubles(visibility), visibilityCount: visibility.length }),
    ...(feet !== undefined && { feet: room.bytes(Array.from(feet, Number)), feetCount: feet.length }),
  });
}

/** Per joint 0 where it is lost; a null pointer if none is said to be. */
export function writtenFlags(room: Room, links: number, isTracked: ArrayLike<boolean> | undefined): number {
  if (isTracked === undefined) return 0;
  return room.bytes(Array.from({ length: links }, (_, joint) => (isTracked[joint] === false ? 0 : 1)));
}

/** `at`: a filled ft_solid_tick; `prefix`: that of the functions that report the rest of it. */
export function tickFrom(room: Room, at: number, prefix: string, links: number, ...of: number[]): SolidTick {
  const { state, limit, isCertified, hasAppeared, deviation, lift, clearance, snapInS, wayCount } = room.read(structs.ft_solid_tick, at);
  return {
    shown: poseFrom(room.machine, `${prefix}_shown`, links, ...of),
    state: solidStates[state],
    limit: solidLimits[limit],
    isCertified: isCertified === 1,
    hasAppeared: hasAppeared === 1,
    deviation,
    lift,
    clearance,
    snapInS,
    wayCount,
    joints: room.list(structs.ft_solid_joint, `${prefix}_joints`, ...of).map(({ state, deviation }) => ({ state: solidJointStates[state], deviation })),
    contacts: room.list(structs.ft_solid_contact, `${prefix}_contacts`, ...of).map(({ other, ...contact }) => contact),
  };
}

export function wayFrom(machine: Machine, name: string, links: number, index: number, ...of: number[]): { readonly time: number; readonly pose: Pose } {
  return machine.within((room) => {
    const time = room.doubles([0]);
    const pose = poseFrom(machine, name, links, ...of, whole(index, "index", 0), time);
    return { time: machine.view().getFloat64(time, true), pose };
  });
}
