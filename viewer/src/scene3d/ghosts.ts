// Ghosts: the pose before a step, the pose that was asked for, and the pose at the contact, drawn
// through everything that is not in front of them.

import * as THREE from "three";
import { AvatarBody } from "./avatar_body.js";
import type { Palette } from "./palette.js";

export type GhostName = "before" | "asked" | "atContact";
const opacities: Record<GhostName, number> = { before: 0.28, asked: 0.42, atContact: 0.4 };

/** One translucent avatar. Its depth is drawn first, so that links do not show through each other. */
export class Ghost {
  private readonly depth: AvatarBody;
  private readonly body: AvatarBody;
  private readonly material: THREE.MeshLambertMaterial;

  constructor(
    private readonly name: GhostName,
    geometry: THREE.BufferGeometry,
    links: number,
    parent: THREE.Object3D,
  ) {
    const hidden = new THREE.MeshBasicMaterial({
      colorWrite: false,
      polygonOffset: true,
      polygonOffsetFactor: 1,
      polygonOffsetUnits: 2,
    });
    this.material = new THREE.MeshLambertMaterial({
      transparent: true,
      opacity: opacities[name],
      depthWrite: false,
    });
    this.depth = new AvatarBody(geometry, links, hidden);
    this.body = new AvatarBody(geometry, links, this.material);
    this.depth.mesh.renderOrder = 2;
    this.body.mesh.renderOrder = 3;
    parent.add(this.depth.mesh, this.body.mesh);
    this.hide();
  }

  show(world: Float64Array, origin: readonly number[]): void {
    this.depth.place(world, origin);
    this.body.place(world, origin);
    this.setVisible(true);
  }

  hide(): void {
    this.setVisible(false);
  }

  set geometry(geometry: THREE.BufferGeometry) {
    this.depth.geometry = geometry;
    this.body.geometry = geometry;
  }

  paint(palette: Palette): void {
    this.material.color.set(palette[this.name]);
  }

  private setVisible(isVisible: boolean): void {
    this.depth.mesh.visible = isVisible;
    this.body.mesh.visible = isVisible;
  }
}
