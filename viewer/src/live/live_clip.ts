// The clip of a stream: the steps of the last minute, as they come in.

import type { Link } from "../data/document.js";
import type { Clip, Instant, Span } from "../motion/clip.js";
import type { LocalPose } from "../motion/chain.js";
import { interpolate } from "../motion/chain.js";
import { fraction, lastAtMost, parentsOf } from "../motion/clip.js";

/** How far back one can look, seconds. */
export const keptSeconds = 60;

/** A step that begins this much before the last one ended is one of a new clock, seconds. */
const clockSlack = 1e-3;

export interface LiveStep extends Span {
  readonly from: LocalPose;
  readonly to: LocalPose;
}

export class LiveClip implements Clip {
  readonly parents: Int32Array;
  private steps: LiveStep[] = [];
  private starts: number[] = [];
  /** Number of the first step still known: steps keep their numbers when old ones go. */
  private firstNumber = 0;

  constructor(links: readonly Link[]) {
    this.parents = parentsOf(links);
  }

  get hasPose(): boolean {
    return this.steps.length > 0;
  }

  get start(): number {
    return this.hasPose ? this.steps[0].t0 : 0;
  }

  get end(): number {
    return this.hasPose ? this.steps[this.steps.length - 1].t1 : 0;
  }

  /** Takes one step and forgets those out of reach; returns its number. A stream that begins anew
   * (its clock goes back) begins a new clip. */
  add(step: LiveStep): number {
    if (this.hasPose && step.t0 < this.end - clockSlack) this.forget(this.steps.length);
    this.steps.push(step);
    this.starts.push(step.t0);
    const old = lastAtMost(this.starts, step.t1 - keptSeconds);
    if (old > 0) this.forget(old);
    return this.firstNumber + this.steps.length - 1;
  }

  /** Where the latest step ends; null where there is none. */
  get latestPose(): LocalPose | null {
    return this.steps[this.steps.length - 1]?.to ?? null;
  }

  private forget(count: number): void {
    this.steps.splice(0, count);
    this.starts.splice(0, count);
    this.firstNumber += count;
  }

  instantAt(time: number): Instant {
    const index = lastAtMost(this.starts, time);
    if (index < 0 || time > this.steps[index].t1) return { step: -1, u: 0 };
    return { step: this.firstNumber + index, u: fraction(time, this.steps[index]) };
  }

  spanOf(step: number): Span | null {
    return this.steps[step - this.firstNumber] ?? null;
  }

  poseTimeAt(time: number): number {
    const step = this.steps[lastAtMost(this.starts, time)];
    if (step === undefined) return this.start;
    return time >= step.t1 ? step.t1 : step.t0;
  }

  poseAt(instant: Instant, time: number, out: LocalPose): void {
    const known = this.steps[instant.step - this.firstNumber];
    if (instant.step >= 0 && known !== undefined) {
      interpolate(known.from, known.to, instant.u, out);
      return;
    }
    const held = this.steps[Math.max(0, lastAtMost(this.starts, time))];
    if (held !== undefined) interpolate(held.from, held.to, time >= held.t1 ? 1 : 0, out);
  }
}
