// How Babylon.js' nodes are read and placed.

import type { AbstractMesh, Mesh, Node, Scene, TransformNode } from "@babylonjs/core";
import { Matrix, Quaternion } from "@babylonjs/core/Maths/math.vector.js";
import { ForetouchError } from "foretouch";
import type { HostMesh, Note } from "foretouch/host";

/** What a world knows: nodes, and a scene as what stands still. */
export type Thing = TransformNode | Scene;

export const isScene = (thing: Thing | Node): thing is Scene => "rootNodes" in thing;
export const nameOf = (thing: Thing): string => (isScene(thing) ? "the scene" : thing.name === "" ? `${thing.getClassName()} ${thing.uniqueId}` : thing.name);

/** Where a node is; for one that was disposed of, Babylon.js goes on to say where it was last. */
export function worldOf(node: TransformNode): Matrix {
  if (node.isDisposed()) throw new ForetouchError(`${nameOf(node)} was disposed of; remove it from the world, too`);
  return node.computeWorldMatrix(true);
}

/** A node's place in the world becomes this one. */
export function putInWorld(node: TransformNode, elements: ArrayLike<number>): void {
  const local = Matrix.FromArray(elements);
  if (node.parent !== null) local.multiplyToRef(Matrix.Invert(node.parent.computeWorldMatrix(true)), local);
  node.rotationQuaternion ??= Quaternion.Identity();
  local.decompose(node.scaling, node.rotationQuaternion, node.position);
}

const isMesh = (node: Node): node is AbstractMesh => "getVerticesData" in node;

/** All shown meshes of a tree; instances one by one. */
export function meshesOf(root: Thing, note: Note<Thing>, isOut: (thing: Thing) => boolean): HostMesh<Thing>[] {
  const all: HostMesh<Thing>[] = [];
  const add = (mesh: AbstractMesh): void => {
    if (mesh.skeleton !== null) return note(`${nameOf(mesh)} has a skeleton and is left out of what stands still: add it as a body, world.addBody(mesh)`, mesh);
    if (mesh.morphTargetManager) note(`${nameOf(mesh)} has morph targets: it is taken without them`, mesh);
    // A node of nothing but a place is a Mesh, too, as loaders make them.
    const positions = mesh.getVerticesData("position");
    if (positions === null && mesh.getChildren().length > 0) return;
    if ((mesh as Mesh).hasThinInstances) return note(`${nameOf(mesh)} has thin instances and is left out of what stands still: expected a mesh, or instances by createInstance()`, mesh);
    all.push({ object: mesh, name: nameOf(mesh), positions: positions ?? [], indices: mesh.getIndices(), matrix: mesh.computeWorldMatrix(true).asArray() });
  };
  const visit = (node: Node): void => {
    if (isOut(node as TransformNode) || !node.isEnabled(false)) return;
    if (isMesh(node) && node.isVisible && node.getClassName() !== "LinesMesh") add(node);
    for (const child of node.getChildren()) visit(child);
  };
  if (isScene(root)) root.rootNodes.forEach(visit);
  else visit(root);
  return all;
}

/** `isRightHanded`: as Scene.useRightHandedSystem says. */
