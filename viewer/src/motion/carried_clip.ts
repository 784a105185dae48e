// The clip of a body that others carry for a while: its poses are then in the frame of a link of
// theirs.

import type { Carried } from "../data/document.js";
import type { LocalPose } from "./chain.js";
import { emptyPose } from "./chain.js";
import type { Clip, Instant, Span } from "./clip.js";
import { multiply, rotate } from "./quaternion.js";

export class CarriedClip implements Clip {
  readonly parents: Int32Array;
  readonly start: number;
  readonly end: number;
  readonly hasPose: boolean;
  private readonly roots: number[];
  private readonly rotation = new Float64Array(4);
  private readonly translation = new Float64Array(3);
  private readonly carrying: LocalPose[];
  /** A document in which bodies carry each other in a circle ends here. */
  private isBusy = false;

  constructor(
    private readonly own: Clip,
    private readonly carried: readonly Carried[],
    /** Of all bodies: those that carry. Read when a pose is asked for. */
    private readonly clips: readonly Clip[],
  ) {
    this.parents = own.parents;
    this.start = own.start;
    this.end = own.end;
    this.hasPose = own.hasPose;
    this.roots = Array.from(own.parents.keys()).filter((link) => own.parents[link] < 0);
    this.carrying = carried.map(({ links }) => emptyPose(links));
  }

  instantAt(time: number): Instant {
    return this.own.instantAt(time);
  }

  spanOf(step: number): Span | null {
    return this.own.spanOf(step);
  }

  poseTimeAt(time: number): number {
    return this.own.poseTimeAt(time);
  }

  poseAt(instant: Instant, time: number, out: LocalPose): void {
    this.own.poseAt(instant, time, out);
    const span = instant.step < 0 ? null : this.own.spanOf(instant.step);
    const at = span === null ? time : span.t0 + instant.u * (span.t1 - span.t0);
    const place = this.carried.findIndex(({ from, until }) => from <= at && (until === null || at < until));
    if (place < 0 || this.isBusy) return;
    this.isBusy = true;
    this.findFrame(place, at);
    this.isBusy = false;
    for (const root of this.roots) {
      rotate(this.rotation, out.translations, 3 * root);
      for (let i = 0; i < 3; ++i) out.translations[3 * root + i] += this.translation[i];
      multiply(this.rotation, out.rotations, 4 * root);
    }
  }

  /** Of the link that carries, in the world. */
  private findFrame(place: number, time: number): void {
    const { avatar, link } = this.carried[place], clip = this.clips[avatar], pose = this.carrying[place];
    clip.poseAt(clip.instantAt(time), time, pose);
    this.rotation.set([1, 0, 0, 0]);
    this.translation.fill(0);
    for (let at = link; at >= 0; at = clip.parents[at]) {
      const turn = pose.rotations.subarray(4 * at, 4 * at + 4);
      rotate(turn, this.translation, 0);
      for (let i = 0; i < 3; ++i) this.translation[i] += pose.translations[3 * at + i];
      multiply(turn, this.rotation, 0);
    }
  }
}
