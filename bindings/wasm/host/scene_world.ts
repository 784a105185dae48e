// A TouchWorld of a scene graph: what a host says of its objects, and all that follows from it.

import { Foretouch } from "../foretouch.js";
import { ForetouchError } from "../machine.js";
import type { SolidOptions } from "../solid.js";
import type { BodyOptions } from "../world.js";
import { Engine, type EngineLike } from "./engine.js";
import type { Matrix } from "./frames.js";
import type { HostMesh, Note } from "./geometry.js";
import { JointMember, type JointSource, RigidMember, type RigidSource } from "./members.js";
import { fitted, type HostBone, type HostSkin, readRig, type Rig, rigOf } from "./skin.js";
import { TouchWorld, type TouchWorldOptions } from "./touch_world.js";
import type { Touch } from "./touches.js";

/** What a host says of its objects. */
export interface Host<O> {
  /** -1: its z is the other way round. */
  readonly mirror: 1 | -1;
  nameOf(object: O): string;
  parentOf(object: O): O | null;
  /** To the world, as it is now. */
  matrixOf(object: O): Matrix;
  /** Puts it there in the world. */
  place(object: O, matrix: Float64Array): void;
  /** All shown meshes of a tree, as they stand now, without what is out, and what is below that. */
  meshesOf(root: O, note: Note<O>, isOut: (object: O) => boolean): HostMesh<O>[];
  /** Throws where there is no skeleton. */
  skinnedOf(root: O): Skinned<O>;
}

/** An object with a skeleton. */
export interface Skinned<O> {
  readonly bones: readonly HostBone[];
  readonly skins: readonly HostSkin<O>[];
  /** From the bones to the world, as they are now. Throws in the host's words where they are other bones than they were. */
  matrices(): readonly Matrix[];
  /** Puts bones there, parents before children. */
  place(bone: number, matrix: Float64Array): void;
}

export interface SceneWorldOptions<O> extends TouchWorldOptions {
  /** What a person should know of an object; left out: console.warn(). */
  readonly note?: (message: string, object: O | null) => void;
}

type Tell<O> = (touch: Touch<O>) => void;
export type Shown<O> = { readonly shown?: O | null };

export class SceneWorld<O> {
  private readonly world: TouchWorld<O>;
  private readonly engine: EngineLike;
  /** What is not part of what stands still. */
  private readonly apart = new Set<O>();
  private mustStand = true;

  constructor(library: Foretouch | EngineLike, readonly host: Host<O>, private still: O | null, told: Tell<O>, { note, ...options }: SceneWorldOptions<O>) {
    this.engine = library instanceof Foretouch ? new Engine(library) : library;
    this.world = new TouchWorld<O>(this.engine, host.mirror, note ?? ((message) => console.warn(`Foretouch: ${message}`)), told, options);
  }

  /** What stands still is another object, or has changed: the next update reads it anew. */
  stand(still: O | null = this.still): void {
    this.still = still;
    this.mustStand = true;
  }

  addMoving(object: O, tell: Tell<O>, options: BodyOptions): RigidMember<O> {
    this.setApart(object);
    const meshes = this.host.meshesOf(object, this.world.say, (other) => other !== object && this.apart.has(other));
    return this.world.addRigid(this.rigid(object, tell), meshes, options);
  }

  /** With `shown` it is solid. `then`: once it is in the world. */
  async addBody(object: O, tell: Tell<O>, then: (member: JointMember<O>) => void, { shown = null, ...options }: SolidOptions & BodyOptions & Shown<O>): Promise<void> {
    const { host, world } = this, body = host.skinnedOf(object);
    const bare = rigOf(body.bones, host.mirror), copy = shown === null ? null : this.copy(shown, bare, object);
    this.setApart(object, shown);
    const rig = await fitted(bare, body.skins, host.mirror, world.say, (triangles) => this.engine.fit(triangles));
    const matrix = new Float64Array(16);
    world.addJoints({
      object,
      name: host.nameOf(object),
      parents: rig.parents,
      links: () => rig.links,
      read: (frames) => {
        readRig(rig, body.matrices(), frames);
        return true;
      },
      show: (frames) => copy?.rig.bones.forEach((bone, link) => {
        copy.rig.parts[link].write(frames, link, matrix);
        copy.skinned.place(bone, matrix);
      }),
      tell,
    }, options, copy !== null, then);
  }

  addJoints(source: JointSource<O>, options: SolidOptions & BodyOptions, then: (member: JointMember<O>) => void, ...apart: O[]): void {
    this.setApart(...apart);
    this.world.addJoints(source, options, true, then);
  }

  /** Removes what has this object. */
  remove(object: O): void {
    this.world.remove(object);
    this.apart.delete(object);
  }

  hold(moving: RigidMember<O>, by: JointMember<O> | null, joint: string): void {
    if (by === null) throw new ForetouchError(`${moving.source.name}: expected an update of both before one is held`);
    this.world.hold(moving, by, joint);
  }

  letGo(moving: RigidMember<O>): void {
    this.world.letGo(moving);
  }

  update(timeMs: number): void | Promise<void> {
    if (this.mustStand) {
      this.world.stand(this.still === null ? [] : this.host.meshesOf(this.still, this.world.say, (object) => this.apart.has(object)));
      this.mustStand = false;
    }
    return this.world.update(timeMs);
  }

  restart(): void {
    this.world.restart();
  }

  dispose(): void {
    this.world.dispose();
  }

  presses(member: JointMember<O>): ReturnType<TouchWorld<O>["presses"]> {
    return this.world.presses(member);
  }

  private copy(shown: O, rig: Rig, of: O): { skinned: Skinned<O>; rig: Rig } {
    const skinned = this.host.skinnedOf(shown), own = rigOf(skinned.bones, this.host.mirror);
    if (own.links.length !== rig.links.length || own.links.some(({ name }, link) => name !== rig.links[link].name)) {
      throw new ForetouchError(`${this.host.nameOf(shown)}: expected a copy with the bones of ${this.host.nameOf(of)}`);
    }
    return { skinned, rig: own };
  }

  private rigid(object: O, tell: Tell<O>): RigidSource<O> {
    return { object, name: this.host.nameOf(object), matrix: () => this.host.matrixOf(object), place: (matrix) => this.host.place(object, matrix), tell };
  }

  private setApart(...objects: (O | null)[]): void {
    for (const object of objects) {
      if (object === null) continue;
      this.apart.add(object);
      for (let above: O | null = object; above !== null && !this.mustStand; above = this.host.parentOf(above)) this.mustStand = above === this.still;
    }
  }
}
