// What a world of a host asks of the library: plain arrays in, records out, so that it can also be
// in a worker (far_engine.ts).

import type { Foretouch } from "../foretouch.js";
import { ForetouchError } from "../machine.js";
import type { Avatar, Link, Lss, PoseLike, Scene, SceneArrays } from "../shapes.js";
import type { SolidOptions } from "../solid.js";
import type { SolidBodyTick, SolidTarget, SolidWorld, SolidWorldOptions } from "../solid_world.js";
import type { BodyOptions, WorldEvents } from "../world.js";

/** What a body is made of. */
export type Shape = { readonly links: readonly Link[] } | { readonly mesh: SceneArrays };

export interface BodyOrder {
  /** As for Engine.shape(). */
  readonly shape: number;
  /** A solid avatar, which follows its targets; else it moves by its moves. */
  readonly isSolid: boolean;
  readonly options: SolidOptions & BodyOptions;
  /** Where it is at the first instant; a solid one may leave it null. */
  readonly pose: PoseLike | null;
}

export interface Move {
  readonly body: number;
  readonly pose: PoseLike;
}

/** A rigid body goes into a link's frame, held fast; null: out of it. At the end of the tick before. */
export interface Hold {
  readonly body: number;
  readonly by: { readonly body: number; readonly link: number } | null;
  /** There; or in W. */
  readonly pose: PoseLike;
}

export interface Tick {
  readonly timeUs: number;
  readonly moves: readonly Move[];
  readonly targets: readonly SolidTarget[];
  readonly holds: readonly Hold[];
}

/** What a tick answers: solid avatars by number, and what happened. */
export interface Told extends Pick<WorldEvents, "events"> {
  readonly solids: readonly SolidBodyTick[];
}

/** Where nothing stands still: far below everything. */
const nowhere: SceneArrays = { positions: [0, -9e6, 0, 1, -9e6, 0, 0, -9e6, 1] };

export class Engine {
  private still: Scene | null = null;
  private readonly shapes = new Map<number, Avatar | Scene>();
  private world: SolidWorld | null = null;
  /** Where the last tick ended. */
  private timeUs = 0;

  constructor(readonly library: Foretouch) {}

  fit(triangles: ArrayLike<number>): Lss[] {
    return this.library.fit(triangles);
  }

  /** What stands still; null: nothing. For the next begin(). */
  stands(arrays: SceneArrays | null): void {
    const made = this.library.scene(arrays ?? nowhere);
    this.still?.dispose();
    this.still = made;
  }

  shape(number: number, shape: Shape): void {
    this.shapes.set(number, "links" in shape ? this.library.avatar(shape.links) : this.library.scene(shape.mesh));
  }

  /** Lets go of a shape that no body of the next begin() has. */
  forget(number: number): void {
    this.shapes.get(number)?.dispose();
    this.shapes.delete(number);
  }

  /** A world anew, with these bodies as 0, 1, 2, ... Nothing before that instant is part of it. */
  begin(timeUs: number, options: SolidWorldOptions, bodies: readonly BodyOrder[]): void {
    if (this.still === null) this.stands(null);
    const world = this.library.solidWorld(this.still as Scene, timeUs, options);
    this.world?.dispose();
    [this.world, this.timeUs] = [world, timeUs];
    for (const body of bodies) this.join(timeUs, body);
  }

  join(timeUs: number, { shape, isSolid, options, pose }: BodyOrder): void {
    const made = this.shapes.get(shape), all = this.begun();
    if (made === undefined) throw new ForetouchError(`shape: expected one that was made, found ${shape}`);
    const body = isSolid ? all.add(made as Avatar, options) : all.world.add(made, options);
    if (pose !== null) all.world.push(body, timeUs, pose);
  }

  tick({ timeUs, moves, targets, holds }: Tick): Told {
    const all = this.begun(), { world } = all, beganUs = this.timeUs;
    for (const { body, by, pose } of holds) {
      if (by === null) world.detach(body, beganUs, pose);
      else world.attach(body, by.body, beganUs, pose, { link: by.link });
    }
    for (const { body, pose } of moves) world.push(body, timeUs, pose);
    const solids = all.tick(timeUs, targets);
    this.timeUs = timeUs;
    const { events } = all.follow();
    // What is held or let go of next is so from this tick's end on.
    world.forgetBefore(beganUs);
    return { solids, events };
  }

  dispose(): void {
    this.world?.dispose();
    this.world = null;
    for (const number of [...this.shapes.keys()]) this.forget(number);
    this.still?.dispose();
    this.still = null;
  }

  private begun(): SolidWorld {
    if (this.world === null) throw new ForetouchError("expected begin() before this");
    return this.world;
  }
}

/** The same, here or in a worker: then answers come later. */
export type EngineLike = {
  readonly [K in "fit" | "stands" | "shape" | "forget" | "begin" | "join" | "tick" | "dispose"]: (...given: Parameters<Engine[K]>) => ReturnType<Engine[K]> | Promise<ReturnType<Engine[K]>>;
};
