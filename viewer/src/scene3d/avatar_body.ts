// One avatar in one draw call: all its links are one skinned mesh with a bone a link and no
// blending. Ghosts share its vertices.

import * as THREE from "three";
import type { Avatar } from "../data/document.js";
import { transformSize } from "../motion/chain.js";
import type { Shape } from "../state.js";
import { appendCapsule, emptySurface } from "./capsule.js";

/** In the stencil where an avatar itself is seen. */
export const bodyStencil = 1;

/** Vertices of a whole avatar, each moved by its link alone; in the other shape where it has but that. */
export function bodyGeometry(avatar: Avatar, shape: Shape): THREE.BufferGeometry {
  const isMesh = avatar.lss.length === 0 || (shape === "mesh" && avatar.meshes.length > 0);
  return isMesh ? meshGeometry(avatar) : capsuleGeometry(avatar);
}

function capsuleGeometry(avatar: Avatar): THREE.BufferGeometry {
  const surface = emptySurface();
  for (const lss of avatar.lss) appendCapsule(surface, lss);
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(surface.positions, 3));
  geometry.setAttribute("normal", new THREE.Float32BufferAttribute(surface.normals, 3));
  geometry.setIndex(surface.indices);
  return withLinks(geometry, surface.links);
}

function meshGeometry(avatar: Avatar): THREE.BufferGeometry {
  const vertices = avatar.meshes.reduce((sum, mesh) => sum + mesh.positions.length / 3, 0);
  const positions = new Float32Array(3 * vertices);
  const links = new Uint16Array(vertices);
  const indices: number[] = [];
  let first = 0;
  for (const mesh of avatar.meshes) {
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
  const skinWeight = new Float32Array(4 * links.length);
  for (let i = 0; i < links.length; ++i) {
    skinIndex[4 * i] = links[i];
    skinWeight[4 * i] = 1;
  }
  geometry.setAttribute("skinIndex", new THREE.BufferAttribute(skinIndex, 4));
  geometry.setAttribute("skinWeight", new THREE.BufferAttribute(skinWeight, 4));
  const colours = new THREE.BufferAttribute(new Float32Array(3 * links.length).fill(1), 3);
  geometry.setAttribute("color", colours);
  return geometry;
}

export class AvatarBody {
  readonly mesh: THREE.SkinnedMesh;
  private readonly bones: THREE.Bone[];
  private shownColours: string[] = [];

  constructor(geometry: THREE.BufferGeometry, links: number, material: THREE.Material) {
    this.bones = Array.from({ length: links }, () => {
      const bone = new THREE.Bone();
      bone.matrixAutoUpdate = false;
      bone.matrixWorldAutoUpdate = false;
      return bone;
    });
    this.mesh = new THREE.SkinnedMesh(geometry, material);
    // Bones carry world transforms: the mesh itself stays where it is.
    const inverses = this.bones.map(() => new THREE.Matrix4());
    this.mesh.bind(new THREE.Skeleton(this.bones, inverses), new THREE.Matrix4());
    this.mesh.frustumCulled = false;
  }

  set geometry(geometry: THREE.BufferGeometry) {
    this.mesh.geometry = geometry;
    this.shownColours = [];
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

  /** Gives every link its colour; costs nothing where none has changed. */
  paint(colours: readonly string[]): void {
    if (colours.every((colour, link) => colour === this.shownColours[link])) return;
    this.shownColours = [...colours];
    const rgb = colours.map((colour) => new THREE.Color(colour));
    const attribute = this.mesh.geometry.getAttribute("color") as THREE.BufferAttribute;
    const links = this.mesh.geometry.getAttribute("skinIndex");
    for (let i = 0; i < attribute.count; ++i) {
      const colour = rgb[links.getX(i)];
      attribute.setXYZ(i, colour.r, colour.g, colour.b);
    }
    attribute.needsUpdate = true;
  }
}
