// One avatar in one draw call: all its links are one skinned mesh with a bone a link and no
// blending. Ghosts share its vertices.

import * as THREE from "three";
import type { Avatar, LinkMesh, Lss } from "../data/document.js";
import { transformSize } from "../motion/chain.js";
import type { Shape } from "../state.js";
import { appendCapsule, emptySurface, round, roundEnough } from "./capsule.js";
import { bodyCell, coarsened } from "./coarse.js";
import { setScreenColour } from "./shading.js";

/** In the stencil where an avatar itself is seen. */
export const bodyStencil = 1;
/** Of all its links' meshes together, where drawing is slow. */
const maxCoarseTriangles = 8000;

/** Vertices of a whole avatar, each moved by its link alone; in the other shape where it has but that. */
export function bodyGeometry(avatar: Avatar, shape: Shape, isCoarse: boolean): THREE.BufferGeometry {
  const isMesh = avatar.lss.length === 0 || (shape === "mesh" && avatar.meshes.length > 0);
  return isMesh ? meshGeometry(isCoarse ? coarseMeshes(avatar.meshes) : avatar.meshes) : capsuleGeometry(avatar.lss, isCoarse);
}

/** Vertices of one link's LSS, thicker by `growth`, metres; the link's bone moves them. */
export function grownGeometry({ lss }: Avatar, link: number, growth: number): THREE.BufferGeometry {
  return capsuleGeometry(lss.filter((one) => one.link === link).map((one) => ({ ...one, radius: one.radius + growth })), false);
}

function capsuleGeometry(all: readonly Lss[], isCoarse: boolean): THREE.BufferGeometry {
  const surface = emptySurface();
  for (const lss of all) appendCapsule(surface, lss, isCoarse ? roundEnough : round);
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(surface.positions, 3));
  geometry.setAttribute("normal", new THREE.Float32BufferAttribute(surface.normals, 3));
  geometry.setIndex(surface.indices);
  return withLinks(geometry, surface.links);
}

function coarseMeshes(meshes: readonly LinkMesh[]): readonly LinkMesh[] {
  const triangles = meshes.reduce((sum, { indices }) => sum + indices.length / 3, 0);
  if (triangles <= maxCoarseTriangles) return meshes;
  return meshes.map((mesh) => {
    const share = Math.max(12, (maxCoarseTriangles * mesh.indices.length) / (3 * triangles));
    return { ...mesh, indices: coarsened(mesh.positions, mesh.indices, share, bodyCell).triangles };
  });
}

function meshGeometry(meshes: readonly LinkMesh[]): THREE.BufferGeometry {
  const vertices = meshes.reduce((sum, mesh) => sum + mesh.positions.length / 3, 0);
  const positions = new Float32Array(3 * vertices);
  const links = new Uint16Array(vertices);
  const indices: number[] = [];
  let first = 0;
  for (const mesh of meshes) {
    positions.set(mesh.positions, 3 * first);
    links.fill(mesh.link, first, first + mesh.positions.length / 3);
    for (const index of mesh.indices) indices.push(first + index);
    first += mesh.positions.length / 3;
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(positions, 3));
  geometry.setIndex(indices);
  geometry.computeVertexNormals();
  return withLinks(geometry, links);
}

function withLinks(geometry: THREE.BufferGeometry, links: ArrayLike<number>): THREE.BufferGeometry {
  const skinIndex = new Uint16Array(4 * links.length);
  for (let i = 0; i < links.length; ++i) skinIndex[4 * i] = links[i];
  geometry.setAttribute("skinIndex", new THREE.BufferAttribute(skinIndex, 4));
  return geometry;
}

export class AvatarBody {
  readonly mesh: THREE.SkinnedMesh;
  private readonly bones: THREE.Bone[];

  constructor(geometry: THREE.BufferGeometry, links: number, material: THREE.Material) {
    this.bones = Array.from({ length: links }, () => {
      const bone = new THREE.Bone();
      bone.matrixAutoUpdate = false;
      bone.matrixWorldAutoUpdate = false;
      return bone;
    });
    // Bones carry world transforms: the mesh itself stays where it is.
    const skeleton = new THREE.Skeleton(this.bones, this.bones.map(() => new THREE.Matrix4()));
    this.mesh = skinned(geometry, material, skeleton);
  }

  /** The same body, moved by the same bones, in another material. */
  double(material: THREE.Material): THREE.SkinnedMesh {
    return skinned(this.mesh.geometry, material, this.mesh.skeleton);
  }

  /** World transforms of all links; `origin` is the world's point that the view has at zero. */
  place(world: Float64Array, origin: readonly number[]): void {
    this.bones.forEach((bone, link) => {
      const w = world.subarray(transformSize * link, transformSize * (link + 1));
      bone.matrixWorld.set(
        w[0], w[1], w[2], w[9] - origin[0],
        w[3], w[4], w[5], w[10] - origin[1],
        w[6], w[7], w[8], w[11] - origin[2],
        0, 0, 0, 1,
      );
    });
  }
}

/** A mesh whose bones move it; nobody asks how far it reaches. */
export function skinned(geometry: THREE.BufferGeometry, material: THREE.Material, skeleton: THREE.Skeleton): THREE.SkinnedMesh {
  const mesh = new THREE.SkinnedMesh(geometry, material);
  mesh.bind(skeleton, new THREE.Matrix4());
  mesh.frustumCulled = false;
  // Asked for to sort what is drawn, and worked out vertex by vertex where it is not there.
  mesh.boundingSphere = new THREE.Sphere();
  return mesh;
}

/** A colour a link, for the shader of links. */
export class LinkColours {
  readonly texture: THREE.DataTexture;
  private shown: string[] = [];

  constructor(links: number) {
    this.texture = new THREE.DataTexture(new Float32Array(4 * links), links, 1, THREE.RGBAFormat, THREE.FloatType);
  }

  /** Costs nothing where none has changed. */
  paint(colours: readonly string[]): void {
    if (colours.every((colour, link) => colour === this.shown[link])) return;
    this.shown = [...colours];
    const data = this.texture.image.data as Float32Array, colour = new THREE.Color();
    colours.forEach((text, link) => {
      setScreenColour(colour, text);
      data.set([colour.r, colour.g, colour.b, 1], 4 * link);
    });
    this.texture.needsUpdate = true;
  }
}
