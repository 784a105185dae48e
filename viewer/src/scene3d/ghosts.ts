// Ghosts: the pose before a step, the pose that was asked for, the pose at the contact, of a solid
// avatar the one that its tracker says, and of a link how far the person may be from it. Where the avatar itself is seen they are only hinted at, so that it keeps its colour.

import * as THREE from "three";
import { AvatarBody, bodyStencil } from "./avatar_body.js";
import type { Palette } from "./palette.js";
import { linkMaterial, setScreenColour } from "./shading.js";

/** Of a whole body in a pose. */
export type GhostName = "before" | "asked" | "atContact" | "tracked";
type Shown = GhostName | "veil";
const opacities: Record<Shown, number> = { before: 0.3, asked: 0.5, atContact: 0.5, tracked: 0.5, veil: 0.45 };
/** Of a ghost's opacity, in front of the avatar. */
const hint = 0.22;

/** One translucent avatar. Its depth is drawn first, so that links do not show through each other. */
export class Ghost {
  private readonly meshes: readonly THREE.SkinnedMesh[];
  private readonly body: AvatarBody;
  private readonly colours: readonly THREE.ShaderMaterial[];

  constructor(
    private readonly name: Shown,
    geometry: THREE.BufferGeometry,
    links: number,
    parent: THREE.Object3D,
  ) {
    const beside = ghostMaterial(opacities[name], THREE.NotEqualStencilFunc);
    const before = ghostMaterial(hint * opacities[name], THREE.EqualStencilFunc);
    this.colours = [beside, before];
    this.body = new AvatarBody(geometry, links, depthMaterial());
    this.meshes = [this.body.mesh, this.body.double(beside), this.body.double(before)];
    this.meshes.forEach((mesh, i) => (mesh.renderOrder = i === 0 ? 2 : 3));
    parent.add(...this.meshes);
    this.hide();
  }

  show(world: Float64Array, origin: readonly number[]): void {
    this.body.place(world, origin);
    for (const mesh of this.meshes) mesh.visible = true;
  }

  hide(): void {
    for (const mesh of this.meshes) mesh.visible = false;
  }

  set geometry(geometry: THREE.BufferGeometry) {
    for (const mesh of this.meshes) mesh.geometry = geometry;
  }

  paint(palette: Palette): void {
    for (const material of this.colours) setScreenColour(material.uniforms["colour"].value as THREE.Color, palette[this.name]);
  }
}

function ghostMaterial(opacity: number, where: THREE.StencilFunc): THREE.ShaderMaterial {
  return linkMaterial("one", {
    transparent: true,
    opacity,
    depthWrite: false,
    stencilWrite: true,
    stencilFunc: where,
    stencilRef: bodyStencil,
  });
}

function depthMaterial(): THREE.ShaderMaterial {
  return linkMaterial("one", {
    transparent: true,
    colorWrite: false,
    polygonOffset: true,
    polygonOffsetFactor: 1,
    polygonOffsetUnits: 2,
  });
}
