// What a person surely touched, may have touched and cannot have touched between two poses, whatever
// they did there. What a bound is, and which to take: docs/person.md.

import { ForetouchError, Held, handleOf, type Machine, numberOf, real, type Room } from "./machine.js";
import { Avatar, type PoseLike, Scene, writtenPose } from "./shapes.js";
import * as structs from "./structs.js";

export const motionModels = ["constant-rate", "cubic", "cubic-late"] as const;
/** What a body is taken to do between two poses. */
export type MotionModel = (typeof motionModels)[number];
export const bracketVerdicts = ["unclaimed", "excluded", "possible", "certain"] as const;
export type BracketVerdict = (typeof bracketVerdicts)[number];

/** A claim about one link: how far the person may be from the model. What is left out is not claimed; an `error` left out is none. */
export interface LinkBound {
  /** Of a pose, m. */
  readonly error?: number;
  /** Of person minus model within a step, m/s^2. */
  readonly acceleration?: number;
  /** Instead, if less: a length, m, and a share of how much the poses around the step bend. */
  readonly followFloor?: number;
  readonly followShare?: number;
  /** Of the person where poses were lost, m/s. */
  readonly speed?: number;
  /** After the last pose, of person minus model: m/s and m/s^2. */
  readonly aheadSpeed?: number;
  readonly aheadAcceleration?: number;
}

/** Two poses that are `seconds` apart, and those around them, where there are any. */
export interface PosedStep {
  readonly between?: MotionModel;
  readonly before?: PoseLike;
  readonly from: PoseLike;
  readonly to: PoseLike;
  readonly after?: PoseLike;
  readonly seconds: number;
  /** Left out: as long as the step. */
  readonly secondsBefore?: number;
  readonly secondsAfter?: number;
}

/** One link's, in t of the step. Nothing is touched before possibleFrom and after possibleUntil. */
export interface LinkBracket {
  readonly link: number;
  readonly verdict: BracketVerdict;
  /** The scene's that is, or may be, touched first; -1: none, or not known. */
  readonly triangle: number;
  readonly object: number;
  readonly possibleFrom: number;
  readonly possibleUntil: number;
  /** If it is certain: something is touched at both; or, where certainUntil comes first, at an instant between the two, at which the link passed through a surface. */
  readonly certainFrom: number;
  readonly certainUntil: number;
  /** The largest distance between person and model, m. */
  readonly growth: number;
}

export interface BracketOptions {
  /** Instants are as near to the true ones as this, m. */
  readonly resolution?: number;
}

export class BracketQuery extends Held {
  private readonly links: number;

  constructor(machine: Machine, scene: Scene, avatar: Avatar, options: BracketOptions) {
    super(machine, "brackets", machine.within((room) => {
      const written = room.options("ft_bracket_options", structs.ft_bracket_options, { resolution: options.resolution });
      return room.answered("ft_brackets_create", handleOf(scene, Scene, machine, "scene"), handleOf(avatar, Avatar, machine, "avatar"), written);
    }));
    this.links = avatar.links.length;
  }

  /** What follows from the bounds, one per link in order, or one for all. */
  answer(step: PosedStep, bounds: LinkBound | readonly LinkBound[]): LinkBracket[] {
    return this.told("ft_brackets_answer", step, bounds);
  }

  /** Poses were lost between `from` and `to`: only the bounds' `speed` and `error` count. */
  answerGap(step: PosedStep, bounds: LinkBound | readonly LinkBound[]): LinkBracket[] {
    return this.told("ft_brackets_answer_gap", step, bounds);
  }

  /** Looks ahead: t is 0 at the step's `to` and 1 after `horizon` seconds. Links are excluded, or possible from possibleFrom on. */
  lookAhead(step: PosedStep, horizon: number, bounds: LinkBound | readonly LinkBound[]): LinkBracket[] {
    return this.told("ft_brackets_look_ahead", step, bounds, real(horizon, "horizon"));
  }

  private told(name: string, step: PosedStep, bounds: LinkBound | readonly LinkBound[], ...more: number[]): LinkBracket[] {
    return this.machine.within((room) => {
      const all = writtenBounds(room, bounds, this.links);
      this.machine.ask(name, this.handle, writtenStep(room, step, this.links), ...more, all.at, all.count);
      return room.list(structs.ft_link_bracket, "ft_brackets_links", this.handle).map(({ other, verdict, ...of }) => ({ ...of, verdict: bracketVerdicts[verdict] }));
    });
  }
}

function writtenStep(room: Room, step: PosedStep, links: number): number {
  const { before, from, to, after, between, seconds, secondsBefore, secondsAfter } = step ?? {};
  const posed = (pose: PoseLike | undefined, name: string): number | undefined => (pose === undefined ? undefined : writtenPose(room, pose, links, name));
  return room.written(structs.ft_posed_step, {
    between: numberOf(motionModels, between, "between"),
    before: posed(before, "before"),
    from: writtenPose(room, from, links, "from"),
    to: writtenPose(room, to, links, "to"),
    after: posed(after, "after"),
    seconds: real(seconds, "seconds"),
    secondsBefore: secondsBefore ?? seconds,
    secondsAfter: secondsAfter ?? seconds,
  }, "step");
}

function writtenBounds(room: Room, bounds: LinkBound | readonly LinkBound[], links: number): { readonly at: number; readonly count: number } {
  const all = Array.isArray(bounds) ? (bounds as readonly LinkBound[]) : Array.from({ length: links }, () => bounds as LinkBound);
  const at = room.take(all.length * structs.ft_link_bound.size);
  all.forEach((bound, link) => {
    if (typeof bound !== "object" || bound === null) throw new ForetouchError(`bounds[${link}]: expected the bound of a link, found ${String(bound)}`);
    const place = at + link * structs.ft_link_bound.size;
    room.machine.ask("ft_link_bound_init", place);
    structs.ft_link_bound.write(room.machine.view(), place, bound, `bounds[${link}]`);
  });
  return { at, count: all.length };
}

/** Bounds from a file as text, or from "preset:NAME": one per link, for poses of this rate. */
export function readBounds(machine: Machine, file: string, avatar: Avatar, between: MotionModel, rateHz: number): LinkBound[] {
  return machine.within((room) => {
    const text = room.text(file), model = numberOf(motionModels, between, "between");
    if (model === undefined) throw new ForetouchError(`between: expected one of ${motionModels.join(", ")}, found none`);
    return room.list(structs.ft_link_bound, "ftw_bounds", text.at, text.length, handleOf(avatar, Avatar, machine, "avatar"), model, real(rateHz, "rateHz"));
  });
}
