// Hands as WebXR tracks them, as bodies: a link per joint, a capsule per bone. Only places leave the
// browser's tracker: each joint's pose becomes one in its parent's frame.

import type { Link, Point, Pose } from "../../../bindings/wasm/foretouch.js";
import { multiply, normalise, rotate } from "../../src/motion/quaternion.js";

const fingers = ["thumb", "index-finger", "middle-finger", "ring-finger", "pinky-finger"];
const segments = ["metacarpal", "phalanx-proximal", "phalanx-intermediate", "phalanx-distal", "tip"];

/** The 25 joints of a hand, parents before children; the parent's index, -1 for the wrist. */
export const handJoints: readonly { readonly name: string; readonly parent: number }[] = (() => {
  const joints = [{ name: "wrist", parent: -1 }];
  for (const finger of fingers) {
    for (const segment of segments) {
      if (finger === "thumb" && segment === "phalanx-intermediate") continue;
      joints.push({ name: `${finger}-${segment}`, parent: segment === "metacarpal" ? 0 : joints.length - 1 });
    }
  }
  return joints;
})();

/** In W: where the joint is, its rotation w, x, y, z, and how thick it is. */
export interface TrackedJoint {
  readonly place: Point;
  readonly rotation: readonly [number, number, number, number];
  readonly radius: number;
}

/** Of a joint in its parent's frame. */
function local(joints: readonly TrackedJoint[], joint: number): { rotation: Float64Array; place: Point } {
  const { parent } = handJoints[joint], own = joints[joint], rotation = Float64Array.from(own.rotation);
  if (parent < 0) return { rotation, place: own.place };
  const above = joints[parent], [w, x, y, z] = above.rotation, back = Float64Array.of(w, -x, -y, -z);
  const place = Float64Array.from(own.place, (value, axis) => value - above.place[axis]);
  multiply(back, rotation, 0);
  rotate(back, place, 0);
  return { rotation, place: [place[0], place[1], place[2]] };
}

/** The links of a hand of this size: that of the first frame in which it was tracked. */
export function linksOfHand(joints: readonly TrackedJoint[]): Link[] {
  return handJoints.map(({ name, parent }, joint) => {
    const children = handJoints.flatMap((one, child) => (one.parent === joint ? [child] : []));
    const bones = children.length === 0 ? [{ a: [0, 0, 0] as Point, b: [0, 0, 0] as Point, radius: joints[joint].radius }] : children.map((child) => ({
      a: [0, 0, 0] as Point,
      b: local(joints, child).place,
      radius: Math.min(joints[joint].radius, joints[child].radius),
    }));
    const { place } = local(joints, joint);
    return { name, parent: parent < 0 ? null : handJoints[parent].name, offset: place, lss: bones };
  });
}

export function poseOfHand(joints: readonly TrackedJoint[]): Pose {
  const rotations = new Float64Array(4 * joints.length), translations = new Float64Array(3 * joints.length);
  joints.forEach((_, joint) => {
    const { rotation, place } = local(joints, joint);
    rotations.set(rotation, 4 * joint);
    normalise(rotations, 4 * joint);
    translations.set(place, 3 * joint);
  });
  return { rotations, translations };
}
