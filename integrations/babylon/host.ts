// Babylon.js, as a world of Foretouch asks it.

import type { TransformNode } from "@babylonjs/core";
import type { Host } from "foretouch/host";
import { isScene, meshesOf, nameOf, putInWorld, type Thing, worldOf } from "./objects.js";
import { SkinnedNodes } from "./skinned.js";

export const babylon = (isRightHanded: boolean): Host<Thing> => ({
  mirror: isRightHanded ? 1 : -1,
  nameOf,
  parentOf: (thing) => (isScene(thing) ? null : ((thing.parent as TransformNode | null) ?? thing.getScene())),
  matrixOf: (thing) => worldOf(thing as TransformNode).asArray(),
  place: (thing, matrix) => putInWorld(thing as TransformNode, matrix),
  meshesOf,
  skinnedOf: (root) => new SkinnedNodes(root),
});
