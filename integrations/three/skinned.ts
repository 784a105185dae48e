// A tree with SkinnedMeshes, as its bones and what is skinned to them.

import { type Bone, Matrix4, type Object3D, type Skeleton, type SkinnedMesh } from "three";
import { ForetouchError } from "foretouch";
import type { HostBone, HostSkin, Matrix, Skinned } from "foretouch/host";
import { nameOf, numbersOf, positionsOf, putInWorld, refresh } from "./objects.js";

const isSkinned = (object: Object3D): object is SkinnedMesh => "isSkinnedMesh" in object;

export class SkinnedTree implements Skinned<Object3D> {
  readonly bones: readonly HostBone[];
  readonly skins: readonly HostSkin<Object3D>[];
  private readonly own: readonly Bone[];
  /** Those that no other bone is above; they need not be below the root. */
  private readonly tops: readonly Bone[];
  private readonly above: readonly (Object3D | null)[];
  private readonly skeletons: readonly { readonly skeleton: Skeleton; readonly bones: readonly Bone[] }[];

  constructor(private readonly root: Object3D) {
    const meshes: SkinnedMesh[] = [];
    root.traverse((object) => isSkinned(object) && meshes.push(object));
    if (meshes.length === 0) throw new ForetouchError(`${nameOf(root)}: expected a SkinnedMesh with a Skeleton, found none`);
    this.skeletons = [...new Set(meshes.map(({ skeleton }) => skeleton))].map((skeleton) => ({ skeleton, bones: [...skeleton.bones] }));
    this.own = [...new Set(this.skeletons.flatMap(({ bones }) => bones))];
    this.above = this.own.map(({ parent }) => parent);
    this.tops = this.own.filter((bone) => this.parentOf(bone) < 0);
    this.refresh();
    this.bones = this.own.map((bone) => ({ name: bone.name, parent: this.parentOf(bone), matrix: bone.matrixWorld.elements }));
    this.skins = meshes.map((mesh) => this.skinOf(mesh));
  }

  matrices(): readonly Matrix[] {
    for (const { skeleton, bones } of this.skeletons) {
      if (skeleton.bones.length !== bones.length) this.changed(`it has ${skeleton.bones.length} bones, and had ${bones.length}`);
      bones.forEach((bone, i) => skeleton.bones[i] === bone || this.changed(`bone ${i} is another one than ${bone.name}`));
    }
    this.own.forEach((bone, i) => bone.parent === this.above[i] || this.changed(`${bone.name} has another parent`));
    this.refresh();
    return this.own.map(({ matrixWorld }) => matrixWorld.elements);
  }

  place(bone: number, matrix: Float64Array): void {
    putInWorld(this.own[bone], matrix);
  }

  /** The nearest bone above a bone. */
  private parentOf(bone: Bone): number {
    for (let above = bone.parent; above !== null; above = above.parent) {
      const at = this.own.indexOf(above as Bone);
      if (at >= 0) return at;
    }
    return -1;
  }

  private skinOf(mesh: SkinnedMesh): HostSkin<Object3D> {
    const { geometry, skeleton, bindMatrix } = mesh, toBones = new Float64Array(16 * this.own.length), matrix = new Matrix4();
    const places = skeleton.bones.map((bone) => this.own.indexOf(bone));
    places.forEach((at, bone) => toBones.set(matrix.multiplyMatrices(skeleton.boneInverses[bone], bindMatrix).elements, 16 * at));
    return {
      object: mesh,
      name: nameOf(mesh),
      positions: positionsOf(geometry),
      indices: geometry.index?.array ?? null,
      influences: 4,
      joints: Array.from(numbersOf(geometry.attributes["skinIndex"], 4), (bone) => places[bone]),
      weights: numbersOf(geometry.attributes["skinWeight"], 4),
      toBones,
    };
  }

  private refresh(): void {
    for (const bone of this.tops) refresh(bone, true);
  }

  private changed(how: string): never {
    throw new ForetouchError(`The Skeleton of ${nameOf(this.root)} has changed: ${how}; remove the body and add it anew`);
  }
}
