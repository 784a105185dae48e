// A hand of WebXR, as three.js has it.

import type { Object3D } from "three";
import { ForetouchError } from "foretouch";
import { handJoints, type JointSource, RigidPart, sourceOfHand, usualRadius } from "foretouch/host";
import { nameOf, refresh } from "./objects.js";
import type { Hand, HandSpace } from "./touchers.js";

export function handSource(space: HandSpace, hand: Hand): JointSource<Object3D> {
  const name = nameOf(space), joints: (Object3D & { jointRadius?: number | undefined })[] = [];
  let part: RigidPart | null = null;
  return sourceOfHand(space, name, ({ frames, radii }) => {
    if (!space.visible) return false;
    for (let joint = 0; joint < handJoints.length; ++joint) {
      const group = space.joints[handJoints[joint].name];
      if (group?.visible !== true) return false;
      joints[joint] = group;
    }
    refresh(space, true);
    joints.forEach(({ matrixWorld: { elements }, jointRadius = usualRadius }, joint) => {
      part ??= new RigidPart(name, elements, 1);
      if (part.scale === null || !part.read(elements, frames, joint)) throw new ForetouchError(`The hand ${name}: what is above it is scaled unevenly, or its scale has changed; expected one scale that stays`);
      radii[joint] = jointRadius * part.scale;
    });
    return true;
  }, (frames, radii) => hand.show(frames, radii), hand.tell);
}
