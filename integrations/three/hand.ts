// A hand of WebXR, as three.js has it.

import type { Object3D } from "three";
import { ForetouchError } from "foretouch";
import { handJoints, handParents, type JointSource, linksOfHand, RigidPart, trackedHand, usualRadius } from "foretouch/host";
import { nameOf, refresh } from "./objects.js";
import type { Hand, HandSpace } from "./touchers.js";

export function handSource(space: HandSpace, hand: Hand): JointSource<Object3D> {
  const tracked = trackedHand(), name = nameOf(space);
  let part: RigidPart | null = null;
  const read = (): boolean => {
    if (!space.visible || !handJoints.every(({ name }) => space.joints[name]?.visible === true)) return false;
    refresh(space, true);
    handJoints.forEach(({ name: of }, joint) => {
      const group = space.joints[of] as Object3D & { jointRadius?: number }, { elements } = group.matrixWorld;
      part ??= new RigidPart(name, elements, 1);
      if (part.scale === null || !part.read(elements, tracked.frames, joint)) throw new ForetouchError(`The hand ${name}: what is above it is scaled unevenly, or its scale has changed; expected one scale that stays`);
      tracked.radii[joint] = (group.jointRadius ?? usualRadius) * part.scale;
    });
    return true;
  };
  return {
    object: space,
    name,
    parents: handParents,
    links: () => (read() ? linksOfHand(tracked) : null),
    read: ({ rotations, places }) => {
      if (!read()) return false;
      rotations.set(tracked.frames.rotations);
      places.set(tracked.frames.places);
      return true;
    },
    show: (frames) => hand.show(frames, tracked.radii),
    tell: hand.tell,
  };
}
