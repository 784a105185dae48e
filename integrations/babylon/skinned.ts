// Meshes with a skeleton, as its bones and what is skinned to them.

import type { AbstractMesh, Bone, Node, Skeleton } from "@babylonjs/core";
import { Matrix, Quaternion, Vector3 } from "@babylonjs/core/Maths/math.vector.js";
import { ForetouchError } from "foretouch";
import type { HostBone, HostSkin, Skinned } from "foretouch/host";
import { isScene, nameOf, type Thing, worldOf } from "./objects.js";

export class SkinnedNodes implements Skinned<Thing> {
  readonly bones: readonly HostBone[];
  readonly skins: readonly HostSkin<Thing>[];
  private readonly skeleton: Skeleton;
  /** The one that says where the skeleton is. */
  private readonly mesh: AbstractMesh;
  private readonly own: readonly Bone[];
  private readonly above: readonly (Bone | null)[];

  constructor(private readonly root: Thing) {
    const meshes = (isScene(root) ? root.meshes : [root, ...root.getChildMeshes()]).filter((node: Node): node is AbstractMesh => "skeleton" in node && node.skeleton !== null);
    if (meshes.length === 0) throw new ForetouchError(`${nameOf(root)}: expected a mesh with a skeleton, found none`);
    const other = meshes.find(({ skeleton }) => skeleton !== meshes[0].skeleton);
    if (other !== undefined) throw new ForetouchError(`${nameOf(root)}: expected meshes of one skeleton, found those of ${meshes[0].name} and ${other.name}: add them one by one`);
    this.mesh = meshes[0];
    this.skeleton = this.mesh.skeleton as Skeleton;
    this.own = [...this.skeleton.bones];
    this.above = this.own.map((bone) => bone.getParent());
    const matrices = this.worlds();
    this.bones = this.own.map((bone, i) => ({ name: bone.name, parent: this.own.indexOf(this.above[i] as Bone), matrix: matrices[i].asArray() }));
    this.skins = meshes.map((mesh) => this.skinOf(mesh));
  }

  matrices(): readonly ArrayLike<number>[] {
    const { bones } = this.skeleton;
    if (bones.length !== this.own.length) this.changed(`it has ${bones.length} bones, and had ${this.own.length}`);
    this.own.forEach((bone, i) => {
      if (bones[i] !== bone) this.changed(`bone ${i} is another one than ${bone.name}`);
      if (bone.getParent() !== this.above[i]) this.changed(`${bone.name} has another parent`);
    });
    return this.worlds().map((matrix) => matrix.asArray());
  }

  place(at: number, elements: Float64Array): void {
    const bone = this.own[at], node = bone.getTransformNode(), local = Matrix.FromArray(elements);
    const parent = this.above[at], above = parent === null ? this.mesh.computeWorldMatrix(true) : this.worlds()[this.own.indexOf(parent)];
    local.multiplyToRef(Matrix.Invert(above), local);
    const scaling = new Vector3(), turn = new Quaternion(), position = new Vector3();
    local.decompose(scaling, turn, position);
    const target = node ?? bone;
    target.position = position;
    target.rotationQuaternion = turn;
    target.scaling = scaling;
  }

  /** Every bone's matrix to the world, as the mesh is drawn by. */
  private worlds(): Matrix[] {
    const { skeleton, mesh } = this, all = new Map<Bone, Matrix>(), world = worldOf(mesh);
    skeleton.prepare(true);
    const of = (bone: Bone): Matrix => {
      let matrix = all.get(bone);
      if (matrix === undefined) {
        const parent = bone.getParent(), first = skeleton.needInitialSkinMatrix ? mesh.getPoseMatrix().multiply(world) : world;
        matrix = bone.getLocalMatrix().multiply(parent === null ? first : of(parent));
        all.set(bone, matrix);
      }
      return matrix;
    };
    return this.own.map(of);
  }

  private skinOf(mesh: AbstractMesh): HostSkin<Thing> {
    const toBones = new Float64Array(16 * this.own.length);
    // Bones count from the mesh that says where the skeleton is; this one may be elsewhere.
    const toMesh = mesh.computeWorldMatrix(true).multiply(Matrix.Invert(this.mesh.computeWorldMatrix(true)));
    this.own.forEach((bone, i) => toBones.set(toMesh.multiply(bone.getAbsoluteInverseBindMatrix()).asArray(), 16 * i));
    const extra = mesh.getVerticesData("matricesIndicesExtra"), four = mesh.getVerticesData("matricesIndices") ?? [];
    const woven = (kind: string): ArrayLike<number> => {
      const first = mesh.getVerticesData(kind) ?? [], second = mesh.getVerticesData(`${kind}Extra`);
      return second === null ? first : Float64Array.from({ length: 2 * first.length }, (_, i) => (i % 8 < 4 ? first[4 * Math.floor(i / 8) + (i % 8)] : second[4 * Math.floor(i / 8) + (i % 8) - 4]));
    };
    // A bone's number on the graphics card may be another one than its place.
    const places = new Map(this.own.map((bone, i) => [bone.getIndex(), i]));
    return {
      object: mesh,
      name: nameOf(mesh),
      positions: mesh.getVerticesData("position") ?? [],
      indices: mesh.getIndices(),
      influences: extra === null || four.length === 0 ? 4 : 8,
      joints: Array.from(woven("matricesIndices"), (index) => places.get(index) ?? -1),
      weights: woven("matricesWeights"),
      toBones,
    };
  }

  private changed(how: string): never {
    throw new ForetouchError(`The skeleton of ${nameOf(this.root)} has changed: ${how}; remove the body and add it anew`);
  }
}
