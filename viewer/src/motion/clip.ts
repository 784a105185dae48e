// What an avatar does over time: the steps that were answered, and poses held where none was.

import type { Link } from "../data/document.js";
import type { LocalPose } from "./chain.js";
import { compose, emptyPose, transformSize } from "./chain.js";

/** Where a time lies in a clip. */
export interface Instant {
  /** The step that covers it, or -1: the avatar holds a pose that nobody asked to leave. */
  readonly step: number;
  /** Within the step, in [0,1]. */
  readonly u: number;
}

export interface Span {
  readonly t0: number;
  readonly t1: number;
}

/** Times in seconds. Steps are numbered by their own document or stream. */
export interface Clip {
  readonly parents: Int32Array;
  readonly start: number;
  readonly end: number;
  /** False as long as no pose is known. */
  readonly hasPose: boolean;
  instantAt(time: number): Instant;
  /** When the step begins and ends; null where it is not known (any more). */
  spanOf(step: number): Span | null;
  /** Time of the latest pose at or before `time`: what a check at the poses alone looks at. */
  poseTimeAt(time: number): number;
  /** The pose at an instant; `time` counts only where no step covers it. */
  poseAt(instant: Instant, time: number, out: LocalPose): void;
}

export function parentsOf(links: readonly Link[]): Int32Array {
  return Int32Array.from(links, (link) => link.parent);
}

/** World transforms of a clip's links; memory is kept from one time to the next. */
export class Posture {
  readonly world: Float64Array;
  private readonly pose: LocalPose;

  constructor(private readonly clip: Clip) {
    this.pose = emptyPose(clip.parents.length);
    this.world = new Float64Array(transformSize * clip.parents.length);
  }

  moveTo(time: number): Instant {
    const instant = this.clip.instantAt(time);
    this.clip.poseAt(instant, time, this.pose);
    compose(this.clip.parents, this.pose, this.world);
    return instant;
  }

  moveWithin(step: number, u: number): void {
    this.clip.poseAt({ step, u }, 0, this.pose);
    compose(this.clip.parents, this.pose, this.world);
  }

  transform(link: number): number[] {
    const at = transformSize * link;
    return Array.from(this.world.subarray(at, at + transformSize));
  }
}

/** Index of the last of `times` that is at most `time`; -1 where all are later. */
export function lastAtMost(times: ArrayLike<number>, time: number): number {
  let low = 0, high = times.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (times[middle] <= time) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}

export function fraction(time: number, span: Span): number {
  return Math.min(1, Math.max(0, (time - span.t0) / (span.t1 - span.t0)));
}

