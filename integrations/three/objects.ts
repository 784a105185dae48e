// How three.js' objects are read and placed.

import type { BufferAttribute, BufferGeometry, InterleavedBufferAttribute, Mesh, Object3D } from "three";
import { type InstancedMesh, Matrix4 } from "three";
import type { HostMesh, Note } from "foretouch/host";

/** As three.js tells people apart: by name, else by kind. */
export const nameOf = (object: Object3D): string => (object.name === "" ? `${object.type} ${object.id}` : object.name);

/** Its place in the world now, whatever is above it. */
export function refresh(object: Object3D, withChildren: boolean): void {
  if (object.parent !== null) refresh(object.parent, false);
  object.updateWorldMatrix(false, withChildren, true);
}

/** Its place in the world becomes this one. */
export function putInWorld(object: Object3D, elements: Float64Array): void {
  const local = new Matrix4().fromArray(elements), { parent } = object;
  if (parent !== null) {
    refresh(parent, false);
    local.premultiply(new Matrix4().copy(parent.matrixWorld).invert());
  }
  local.decompose(object.position, object.quaternion, object.scale);
}

/** x, y, z per vertex, interleaved and normalised attributes included. */
export function positionsOf(geometry: BufferGeometry): ArrayLike<number> {
  return numbersOf(geometry.attributes["position"], 3);
}

export function numbersOf(attribute: BufferAttribute | InterleavedBufferAttribute | undefined, size: number): ArrayLike<number> {
  if (attribute === undefined) return [];
  if (!("isInterleavedBufferAttribute" in attribute) && !attribute.normalized && attribute.itemSize === size) return attribute.array;
  const numbers = new Float64Array(size * attribute.count);
  for (let i = 0; i < attribute.count; ++i) for (let k = 0; k < size; ++k) numbers[size * i + k] = attribute.getComponent(i, k);
  return numbers;
}

const isMesh = (object: Object3D): object is Mesh => (object as Mesh).isMesh === true;

/**
 * All shown meshes of a tree, as they stand now; an InstancedMesh once per instance. `isOut`: what is
 * left out, with all below it, as what moves is, or what only shows something.
 */
export function meshesOf(root: Object3D, note: Note<Object3D>, isOut: (object: Object3D) => boolean): HostMesh<Object3D>[] {
  const all: HostMesh<Object3D>[] = [];
  refresh(root, true);
  const visit = (object: Object3D): void => {
    if (isOut(object) || !object.visible) return;
    if (isMesh(object)) add(object);
    for (const child of object.children) visit(child);
  };
  const add = (mesh: Mesh): void => {
    const { geometry } = mesh, of = { object: mesh, name: nameOf(mesh), positions: positionsOf(geometry), indices: geometry.index?.array ?? null };
    if ("isSkinnedMesh" in mesh) return note(`SkinnedMesh ${nameOf(mesh)} is left out of what stands still: add it as a body, world.addBody(mesh)`, mesh);
    if ("isBatchedMesh" in mesh) return note(`BatchedMesh ${nameOf(mesh)} is left out: expected Mesh or InstancedMesh`, mesh);
    if (Object.keys(geometry.morphAttributes).length > 0) note(`${nameOf(mesh)} has morph targets: it is taken without them`, mesh);
    if (!("isInstancedMesh" in mesh)) return void all.push({ ...of, matrix: mesh.matrixWorld.elements });
    const instanced = mesh as InstancedMesh;
    for (let i = 0; i < instanced.count; ++i) {
      const matrix = new Matrix4();
      instanced.getMatrixAt(i, matrix);
      all.push({ ...of, matrix: matrix.premultiply(mesh.matrixWorld).elements });
    }
  };
  visit(root);
  return all;
}
