// three.js, as a world of Foretouch asks it.

import type { Object3D } from "three";
import type { Host } from "foretouch/host";
import { meshesOf, nameOf, putInWorld, refresh } from "./objects.js";
import { SkinnedTree } from "./skinned.js";

export const three: Host<Object3D> = {
  mirror: 1,
  nameOf,
  parentOf: ({ parent }) => parent,
  matrixOf: (object) => {
    refresh(object, false);
    return object.matrixWorld.elements;
  },
  place: putInWorld,
  meshesOf,
  skinnedOf: (root) => new SkinnedTree(root),
};
