// Hands as WebXR tracks them, as bodies: a link per joint, a capsule per bone. Only places leave the
// browser's tracker: each joint's pose becomes one in its parent's frame.

import type { Link, Point, Pose } from "../../../bindings/wasm/foretouch.js";

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

type Rotation = readonly [number, number, number, number];

const conjugate = ([w, x, y, z]: Rotation): Rotation => [w, -x, -y, -z];

function product([a, b, c, d]: Rotation, [e, f, g, h]: Rotation): Rotation {
  return [a * e - b * f - c * g - d * h, a * f + b * e + c * h - d * g, a * g - b * h + c * e + d * f, a * h + b * g - c * f + d * e];
}

function turned(q: Rotation, [x, y, z]: Point): Point {
  const [, px, py, pz] = product(product(q, [0, x, y, z]), conjugate(q));
  return [px, py, pz];
}

const minus = (a: Point, b: Point): Point => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];

/** Of a joint in its parent's frame. */
function local(joints: readonly TrackedJoint[], joint: number): { rotation: Rotation; place: Point } {
  const { parent } = handJoints[joint], own = joints[joint];
  if (parent < 0) return { rotation: own.rotation, place: own.place };
  const back = conjugate(joints[parent].rotation);
  return { rotation: product(back, own.rotation), place: turned(back, minus(own.place, joints[parent].place)) };
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
    const { rotation, place } = local(joints, joint), length = Math.hypot(...rotation);
    rotations.set(rotation.map((value) => value / length), 4 * joint);
    translations.set(place, 3 * joint);
  });
  return { rotations, translations };
}
