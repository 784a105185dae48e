// The bodies that the page brings: a hand on its forearm, and a dancer. Metres.

import type { Link, Lss, Point } from "../../../bindings/wasm/foretouch.js";

const capsule = (a: Point, b: Point, radius: number): Lss => ({ a, b, radius });

/** Fingers point to -z, the thumb of a right hand to -x; the wrist is the root. */
export function handLinks(): Link[] {
  const links: Link[] = [
    { name: "Wrist", parent: null, offset: [0, 0, 0], lss: [capsule([0, 0, 0.03], [0, 0, 0.2], 0.032), capsule([-0.018, 0, -0.02], [-0.018, 0, -0.07], 0.018), capsule([0.02, 0, -0.02], [0.018, 0, -0.065], 0.018)] },
  ];
  const fingers: [string, number, readonly number[]][] = [["Index", -0.03, [0.045, 0.026, 0.022]], ["Middle", -0.01, [0.05, 0.03, 0.023]], ["Ring", 0.012, [0.046, 0.028, 0.022]], ["Little", 0.032, [0.036, 0.022, 0.02]]];
  for (const [finger, across, lengths] of fingers) {
    lengths.forEach((length, joint) => links.push({
      name: `${finger}${joint + 1}`,
      parent: joint === 0 ? "Wrist" : `${finger}${joint}`,
      offset: joint === 0 ? [across, 0, -0.09] : [0, 0, -lengths[joint - 1]],
      lss: [capsule([0, 0, 0], [0, 0, -length], 0.0105 - 0.001 * joint)],
    }));
  }
  const half = Math.sin(0.35);
  links.push({ name: "Thumb1", parent: "Wrist", offset: [-0.035, -0.005, -0.02], rotation: [Math.cos(0.35), 0, half, 0], lss: [capsule([0, 0, 0], [0, 0, -0.045], 0.014)] });
  links.push({ name: "Thumb2", parent: "Thumb1", offset: [0, 0, -0.045], lss: [capsule([0, 0, 0], [0, 0, -0.03], 0.012)] });
  return links;
}

export function dancerLinks(): Link[] {
  const limb = (side: "Left" | "Right"): Link[] => {
    const s = side === "Left" ? 1 : -1;
    return [
      { name: `${side}Arm`, parent: "Chest", offset: [0.17 * s, 0.18, 0], lss: [capsule([0.03 * s, 0, 0], [0.26 * s, 0, 0], 0.045)] },
      { name: `${side}ForeArm`, parent: `${side}Arm`, offset: [0.28 * s, 0, 0], lss: [capsule([0, 0, 0], [0.23 * s, 0, 0], 0.036)] },
      { name: `${side}Hand`, parent: `${side}ForeArm`, offset: [0.25 * s, 0, 0], lss: [capsule([0.02 * s, 0, 0], [0.15 * s, 0, 0], 0.03)] },
      { name: `${side}UpLeg`, parent: "Hips", offset: [0.095 * s, -0.06, 0], lss: [capsule([0, -0.05, 0], [0, -0.38, 0], 0.075)] },
      { name: `${side}Leg`, parent: `${side}UpLeg`, offset: [0, -0.43, 0], lss: [capsule([0, 0, 0], [0, -0.37, 0], 0.055)] },
      { name: `${side}Foot`, parent: `${side}Leg`, offset: [0, -0.41, 0], lss: [capsule([0, -0.025, -0.03], [0, -0.025, 0.14], 0.042)] },
    ];
  };
  return [
    { name: "Hips", parent: null, offset: [0, 0.97, 0], lss: [capsule([-0.07, 0, 0], [0.07, 0, 0], 0.11)] },
    { name: "Spine", parent: "Hips", offset: [0, 0.1, 0], lss: [capsule([0, 0, 0], [0, 0.16, 0], 0.115)] },
    { name: "Chest", parent: "Spine", offset: [0, 0.2, 0], lss: [capsule([-0.07, 0.1, 0], [0.07, 0.1, 0], 0.13)] },
    { name: "Neck", parent: "Chest", offset: [0, 0.26, 0], lss: [capsule([0, 0, 0], [0, 0.06, 0], 0.055)] },
    { name: "Head", parent: "Neck", offset: [0, 0.1, 0], lss: [capsule([0, 0.06, 0.01], [0, 0.12, 0.01], 0.095)] },
    ...limb("Left"),
    ...limb("Right"),
  ];
}
