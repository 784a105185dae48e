// What a TouchWorld has in it, and how a host says where it is.

import { ForetouchError } from "../machine.js";
import type { Link, Pose } from "../shapes.js";
import type { SolidOptions, SolidState } from "../solid.js";
import type { SolidBodyTick } from "../solid_world.js";
import type { BodyOptions } from "../world.js";
import type { Shape } from "./engine.js";
import { type Frames, framesOf, localPose, type Matrix, poseRoom, type RigidPart } from "./frames.js";
import type { Touch } from "./touches.js";

/** How the host has something that moves as a whole: a door, a ball. */
export interface RigidSource<O> {
  /** What events name. */
  readonly object: O;
  readonly name: string;
  /** To the host's world, now. */
  matrix(): Matrix;
  /** Where a hand carries it. */
  place?(matrix: Float64Array): void;
  tell?(touch: Touch<O>): void;
}

/** How the host has something with joints. */
export interface JointSource<O> {
  readonly object: O;
  readonly name: string;
  /** By link; -1: a root. */
  readonly parents: Int32Array;
  /** Null: not known yet, as for a hand before it is tracked. */
  links(): readonly Link[] | null;
  /** Where the joints are, in W. False: the tracker does not say. Throws in the host's words where the skeleton is another one. */
  read(frames: Frames): boolean;
  /** Where a solid one is shown. */
  show?(frames: Frames, tick: SolidBodyTick): void;
  tell?(touch: Touch<O>): void;
}

export abstract class Member<O> {
  /** Its number in the world; -1: it is not in it. */
  body = -1;
  /** It was removed, or something is wrong with it, as a note says. */
  isOut = false;

  protected constructor(
    /** Its number among shapes. */
    readonly shape: number,
    readonly made: Shape,
    readonly source: RigidSource<O> | JointSource<O>,
    readonly options: SolidOptions & BodyOptions,
    readonly isSolid: boolean,
    readonly pose: Pose,
  ) {}

  /** Reads where it is, into `pose`. False: it has not been seen yet. */
  abstract read(): boolean;
  abstract linkName(link: number): string | null;
  /** The object of a mesh; else what the whole is. */
  abstract objectOf(object: number): O;
}

export class RigidMember<O> extends Member<O> {
  readonly frames = framesOf(1);
  /** What carries it, and where in that one's hand. */
  held: { readonly by: JointMember<O>; readonly link: number; readonly pose: Pose } | null = null;

  constructor(
    shape: number,
    made: Shape,
    override readonly source: RigidSource<O>,
    private readonly part: RigidPart,
    private readonly objects: readonly O[],
    options: BodyOptions,
  ) {
    super(shape, made, source, options, false, poseRoom(1));
  }

  override read(): boolean {
    if (!this.part.read(this.source.matrix(), this.frames, 0)) throw new ForetouchError(`${this.source.name}: its scale has changed; expected the one that it was added with: remove it and add it anew`);
    localPose([-1], this.frames, this.pose);
    return true;
  }

  place(frames: Frames): void {
    const matrix = new Float64Array(16);
    this.part.write(frames, 0, matrix);
    this.source.place?.(matrix);
  }

  override linkName(): null {
    return null;
  }

  override objectOf(object: number): O {
    return this.objects[object] ?? this.source.object;
  }
}

export class JointMember<O> extends Member<O> {
  readonly tracked: Frames;
  /** Where it is shown. */
  readonly shown: Frames;
  isTracked = false;
  /** The last tick's answer. */
  tick: SolidBodyTick | null = null;
  /** Where a solid one was shown before the world began anew, and begins. */
  resumes: Pose | null = null;

  constructor(
    shape: number,
    readonly links: readonly Link[],
    override readonly source: JointSource<O>,
    options: SolidOptions & BodyOptions,
    isSolid: boolean,
  ) {
    super(shape, { links }, source, options, isSolid, poseRoom(links.length));
    [this.tracked, this.shown] = [framesOf(links.length), framesOf(links.length)];
  }

  /** Where it is to be drawn. */
  get drawn(): Frames {
    return this.isSolid && (this.tick !== null || this.resumes !== null) ? this.shown : this.tracked;
  }

  override read(): boolean {
    this.isTracked = this.source.read(this.tracked);
    if (this.isTracked) localPose(this.source.parents, this.tracked, this.pose);
    return this.isTracked || this.body >= 0;
  }

  override linkName(link: number): string | null {
    return this.links[link]?.name ?? null;
  }

  override objectOf(): O {
    return this.source.object;
  }
}

/** Slower than this along a surface, m/s, is a tracker's noise. */
const noise = 0.02;

/** As the tick says; but a press that trembles is "held". */
export function stateOf({ tick, contacts }: SolidBodyTick): SolidState {
  const isStill = [...tick.contacts, ...contacts].every(({ slipSpeed }) => slipSpeed < noise);
  return tick.state === "sliding" && isStill ? "held" : tick.state;
}
