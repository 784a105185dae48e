// Hands as WebXR tracks them, as bodies: a link per joint, a capsule per bone.

import type { Point } from "../machine.js";
import type { Link } from "../shapes.js";
import { type Frames, framesOf, localPose, poseRoom, worldFrames } from "./frames.js";
import type { JointSource } from "./members.js";

const fingers = ["thumb", "index-finger", "middle-finger", "ring-finger", "pinky-finger"];
const segments = ["metacarpal", "phalanx-proximal", "phalanx-intermediate", "phalanx-distal", "tip"];

/** The 25 joints of a hand, parents before children; the parent's index, -1 for the wrist. */
export const handJoints: readonly { readonly name: string; readonly parent: number }[] = /* @__PURE__ */ (() => {
  const joints = [{ name: "wrist", parent: -1 }];
  for (const finger of fingers) {
    for (const segment of segments) {
      if (finger === "thumb" && segment === "phalanx-intermediate") continue;
      joints.push({ name: `${finger}-${segment}`, parent: segment === "metacarpal" ? 0 : joints.length - 1 });
    }
  }
  return joints;
})();
export const handParents: Int32Array = /* @__PURE__ */ Int32Array.from(/* @__PURE__ */ handJoints.map(({ parent }) => parent));

/** Where a browser does not say how thick a joint is, metres. */
export const usualRadius = 0.008;

/** The places of all joints, in W. */
export interface TrackedHand {
  readonly frames: Frames;
  readonly radii: Float64Array;
}

export const trackedHand = (): TrackedHand => ({ frames: framesOf(handJoints.length), radii: new Float64Array(handJoints.length) });

// What is used of the types of WebXR, which a program may be without; its spaces are only handed on.
type JointPose = { readonly transform: { readonly position: Readonly<Record<"x" | "y" | "z", number>>; readonly orientation: Readonly<Record<"w" | "x" | "y" | "z", number>> }; readonly radius?: number | undefined };
export interface HandFrame { getJointPose?(joint: any, base: any): JointPose | null | undefined }
export interface HandSource { readonly hand?: { get(name: any): unknown } | null | undefined }

/** Reads a hand of an XRFrame, by an XRInputSource and an XRReferenceSpace. False where not every joint is tracked: then nothing is read. */
export function readHand(frame: HandFrame, { hand }: HandSource, space: unknown, { frames, radii }: TrackedHand): boolean {
  if (hand === undefined || hand === null || frame.getJointPose === undefined) return false;
  const poses: JointPose[] = [];
  for (const { name } of handJoints) {
    const joint = hand.get(name), pose = joint === undefined ? null : frame.getJointPose(joint, space);
    if (pose === undefined || pose === null) return false;
    poses.push(pose);
  }
  poses.forEach(({ transform: { position: p, orientation: q }, radius }, joint) => {
    const length = Math.hypot(q.w, q.x, q.y, q.z);
    frames.rotations.set([q.w / length, q.x / length, q.y / length, q.z / length], 4 * joint);
    frames.places.set([p.x, p.y, p.z], 3 * joint);
    radii[joint] = radius ?? usualRadius;
  });
  return true;
}

/** A hand in a place that is itself moved: frame 0 of `rig`, and so much larger. */
export function moveHand({ frames, radii }: TrackedHand, rig: Frames, scale: number): void {
  const count = handJoints.length, parents = Int32Array.from({ length: count + 1 }, (_, i) => (i === 0 ? -1 : 0)), all = framesOf(count + 1), local = poseRoom(count + 1);
  local.rotations.set([...rig.rotations.subarray(0, 4), ...frames.rotations]);
  local.translations.set([...rig.places.subarray(0, 3), ...frames.places.map((value) => scale * value)]);
  worldFrames(parents, local, all);
  frames.rotations.set(all.rotations.subarray(4));
  frames.places.set(all.places.subarray(3));
  radii.forEach((radius, joint) => (radii[joint] = scale * radius));
}

/** A hand as a world has it. `track`: where all its joints are now; false: not all are tracked. */
export function sourceOfHand<O>(object: O, name: string, track: (hand: TrackedHand) => boolean, show: (frames: Frames, radii: Float64Array) => void, tell: NonNullable<JointSource<O>["tell"]>): JointSource<O> {
  const first = trackedHand(), { radii } = first;
  return {
    object,
    name,
    parents: handParents,
    links: () => (track(first) ? linksOfHand(first) : null),
    read: (frames) => track({ frames, radii }),
    show: (frames) => show(frames, radii),
    tell,
  };
}

/**
 * The links of a hand of this size: that of the first frame in which it was tracked. Each joint's ball
 * is in its link's capsules; a wrist is thicker than what grows out of it, so it has one of its own.
 */
export function linksOfHand({ frames, radii }: TrackedHand): Link[] {
  const { translations } = localPose(handParents, frames, poseRoom(handJoints.length));
  const place = (joint: number): Point => [translations[3 * joint], translations[3 * joint + 1], translations[3 * joint + 2]];
  return handJoints.map(({ name, parent }, joint) => {
    const children = handJoints.flatMap((one, child) => (one.parent === joint ? [child] : []));
    const lss = children.map((child) => ({ a: [0, 0, 0] as Point, b: place(child), radius: radii[parent < 0 ? child : joint] }));
    const ball = { a: [0, 0, 0] as Point, b: [0, 0, 0] as Point, radius: radii[joint] };
    return { name, parent: parent < 0 ? null : handJoints[parent].name, offset: place(joint), lss: parent < 0 || children.length === 0 ? [...lss, ball] : lss };
  });
}
