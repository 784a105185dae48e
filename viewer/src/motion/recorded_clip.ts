// The clip of a document's track.

import type { Link, Track } from "../data/document.js";
import type { Clip, Instant, Span } from "./clip.js";
import type { LocalPose } from "./chain.js";
import { emptyPose, interpolate } from "./chain.js";
import { fraction, lastAtMost, parentsOf } from "./clip.js";

export class RecordedClip implements Clip {
  readonly parents: Int32Array;
  readonly start: number;
  readonly end: number;
  readonly hasPose: boolean;
  private readonly stepStarts: Float64Array;
  private readonly from: LocalPose;
  private readonly to: LocalPose;

  constructor(
    links: readonly Link[],
    private readonly track: Track,
  ) {
    const times = track.poseTimes;
    this.parents = parentsOf(links);
    this.hasPose = times.length > 0;
    this.start = this.hasPose ? times[0] : 0;
    this.end = this.hasPose ? times[times.length - 1] : 0;
    this.stepStarts = Float64Array.from(track.from, (pose) => times[pose]);
    this.from = emptyPose(links.length);
    this.to = emptyPose(links.length);
  }

  instantAt(time: number): Instant {
    const step = lastAtMost(this.stepStarts, time);
    const span = step < 0 ? null : this.spanOf(step);
    if (span === null || time > span.t1) return { step: -1, u: 0 };
    return { step, u: fraction(time, span) };
  }

  spanOf(step: number): Span | null {
    const { from, to, poseTimes } = this.track;
    if (!(step >= 0 && step < from.length)) return null;
    return { t0: poseTimes[from[step]], t1: poseTimes[to[step]] };
  }

  poseIndexAt(time: number): number {
    return Math.max(0, lastAtMost(this.track.poseTimes, time));
  }

  poseTimeAt(time: number): number {
    return this.track.poseTimes[this.poseIndexAt(time)];
  }

  poseAt(instant: Instant, time: number, out: LocalPose): void {
    if (!this.hasPose) return;
    if (instant.step < 0) {
      this.readPose(this.poseIndexAt(time), out);
      return;
    }
    this.readPose(this.track.from[instant.step], this.from);
    this.readPose(this.track.to[instant.step], this.to);
    interpolate(this.from, this.to, instant.u, out);
  }

  private readPose(index: number, out: LocalPose): void {
    const { rotations, offsets, moving, movingValues } = this.track;
    const links = this.parents.length;
    out.rotations.set(rotations.subarray(4 * links * index, 4 * links * (index + 1)));
    out.translations.set(offsets);
    moving.forEach((link, i) => {
      const at = 3 * (moving.length * index + i);
      out.translations.set(movingValues.subarray(at, at + 3), 3 * link);
    });
  }
}
