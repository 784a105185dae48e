// Foretouch for JavaScript: what an articulated body touches between two poses, when and where; a
// solid avatar that passes through nothing; and worlds in which everything may move. Metres in a
// world W with y up; quaternions w, x, y, z; t is 0 at the earlier pose and 1 at the later. The
// promise: docs/guarantees.md. Everything here is for one thread at a time, and answers at once; a
// page with much to do asks from a worker.

import { type Machine, moduleOf, started } from "./machine.js";
import { type BracketOptions, BracketQuery, type LinkBound, type MotionModel, readBounds } from "./person.js";
import { Query } from "./query.js";
import { Avatar, Clip, fitted, type Link, type Lss, Scene, type SceneArrays } from "./shapes.js";
import { Solid, type SolidOptions } from "./solid.js";
import { SolidWorld, type SolidWorldOptions } from "./solid_world.js";
import { World, type WorldOptions } from "./world.js";

export {
  type AskOptions, type AskPart, type AskQuestion, type AskShape, type AskTime, type AskVerdict, askVerdicts, type AskWhich, askWhich, type AskWhom, type ContactSide, type FlightAnswer, type UnknownBody,
  type WorldAnswer, type WorldHit,
} from "./ask.js";
export { ForetouchError, type Point } from "./machine.js";
export { type BracketOptions, BracketQuery, type BracketVerdict, bracketVerdicts, type LinkBound, type LinkBracket, type MotionModel, motionModels, type PosedStep } from "./person.js";
export { type Contact, Query, type SweptSurface, type Verdict, verdicts } from "./query.js";
export { Avatar, Clip, type Link, type Lss, type Pose, type PoseLike, Scene, type SceneArrays, type SkinArrays } from "./shapes.js";
export { Solid, type SolidContact, type SolidJointState, solidJointStates, type SolidLimit, solidLimits, type SolidOptions, type SolidState, solidStates, type SolidTick } from "./solid.js";
export { reaches, type SolidBodyContact, type SolidBodyTick, type SolidCrush, type SolidTarget, SolidWorld, type SolidWorldOptions } from "./solid_world.js";
export {
  type BodyOptions, type Depth, type EventKind, eventKinds, type EventPoint, everyBody, everyLink, Follower, type FollowOptions, type LeaveCause,
  leaveCauses, type Occupant, type Reason, reasons, type SilentBody, silences, stillScene, type TriggerEvent, type TriggerOptions, Triggers, type WhenSilent, World,
  type WorldContact, type WorldContacts, type WorldEvent, type WorldEvents, type WorldOptions, type WorldPart,
} from "./world.js";

/** The library, loaded once. */
export class Foretouch {
  private constructor(
    private readonly machine: Machine,
    readonly version: string,
  ) {}

  /** `module`: the content of foretouch.wasm, or the answer of a fetch() of it. */
  static async load(module: BufferSource | WebAssembly.Module | Response | PromiseLike<Response>): Promise<Foretouch> {
    const given = await module;
    const machine = await started(typeof Response !== "undefined" && given instanceof Response ? await moduleOf(given) : (given as BufferSource | WebAssembly.Module));
    return new Foretouch(machine, machine.text(machine.call("ft_version")));
  }

  /** Triangles at rest, two-sided. */
  scene(arrays: SceneArrays): Scene {
    return new Scene(this.machine, arrays);
  }

  /** From an avatar file, or its links. */
  avatar(file: string | readonly Link[]): Avatar {
    return Avatar.parsed(this.machine, typeof file === "string" ? file : JSON.stringify({ format: "foretouch-avatar", version: 1, links: file }));
  }

  /** Capsules, `most` at most: at least one of them contains each triangle. Nine numbers per triangle. */
  fit(triangles: ArrayLike<number>, { most = 4 }: { most?: number } = {}): Lss[] {
    return fitted(this.machine, triangles, most);
  }

  /** A BVH file, for an avatar, or with one made from it. `scale`: metres per unit of the file. */
  clip(bvh: string, { avatar, scale = 1 }: { avatar?: Avatar; scale?: number } = {}): Clip {
    return new Clip(this.machine, bvh, scale, avatar ?? null);
  }

  /** What does each link meet first? `tolerance` in metres. */
  query(scene: Scene, avatar: Avatar, { tolerance = 1e-3 }: { tolerance?: number } = {}): Query {
    return new Query(this.machine, scene, avatar, tolerance);
  }

  /** What did the person touch, surely or perhaps, whatever they did between two poses? */
  brackets(scene: Scene, avatar: Avatar, options: BracketOptions = {}): BracketQuery {
    return new BracketQuery(this.machine, scene, avatar, options);
  }

  /** From a file of `foretouch bounds`, as text, or "preset:NAME": one per link, for poses of this rate. */
  bounds(file: string, avatar: Avatar, { between, rateHz }: { between: MotionModel; rateHz: number }): LinkBound[] {
    return readBounds(this.machine, file, avatar, between, rateHz);
  }

  /** An avatar that passes through nothing that stands still. */
  solid(scene: Scene, avatar: Avatar, options: SolidOptions = {}): Solid {
    return new Solid(this.machine, scene, avatar, options);
  }

  /** Everything that moves, beside `still`, which does not; left out, or null: nothing stands still. */
  world(still: Scene | null = null, options: WorldOptions = {}): World {
    return World.made(this.machine, still, options);
  }

  /** The same with solid avatars among what moves. The first tick begins at `beginUs`. */
  solidWorld(still: Scene, beginUs: number, options: SolidWorldOptions = {}): SolidWorld {
    return new SolidWorld(this.machine, still, beginUs, options);
  }
}
