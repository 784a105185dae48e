// Certified surfaces of what links sweep during a step, translucent.

import * as THREE from "three";
import type { Avatar, SweptSurface, Vector } from "../data/document.js";
import type { Contact } from "../contacts/contact.js";
import type { Palette } from "./palette.js";
import { facetMaterial, setScreenColour } from "./shading.js";

/** More surfaces at once than this hide what they are to show. */
const maxShown = 12;

export class SweptView {
  readonly group = new THREE.Group();
  private readonly surfaces = new Map<string, SweptSurface>();
  private readonly geometries = new Map<string, THREE.BufferGeometry>();
  private readonly material = facetMaterial(0.36);
  private shown = "";

  constructor(avatars: readonly Avatar[]) {
    avatars.forEach((avatar, index) => {
      for (const surface of avatar.swept) {
        this.surfaces.set(key(index, surface.step, surface.link), surface);
      }
    });
  }

  get isEmpty(): boolean {
    return this.surfaces.size === 0;
  }

  surfaceOf(contact: Contact): SweptSurface | null {
    return this.surfaces.get(key(contact.avatar, contact.step, contact.link)) ?? null;
  }

  show(contacts: readonly Contact[], origin: Vector): void {
    const keys = [...new Set(contacts.map((c) => key(c.avatar, c.step, c.link)))]
      .filter((name) => this.surfaces.has(name))
      .slice(0, maxShown);
    if (keys.join() === this.shown) return;
    this.shown = keys.join();
    this.group.clear();
    for (const name of keys) {
      const surface = this.surfaces.get(name);
      if (surface === undefined) continue;
      const mesh = new THREE.Mesh(this.geometryOf(name, surface), this.material);
      mesh.position.fromArray(surface.origin.map((value, axis) => value - origin[axis]));
      mesh.renderOrder = 1;
      this.group.add(mesh);
    }
  }

  paint(palette: Palette): void {
    setScreenColour(this.material.uniforms["colour"].value as THREE.Color, palette.swept);
  }

  private geometryOf(name: string, surface: SweptSurface): THREE.BufferGeometry {
    const known = this.geometries.get(name);
    if (known !== undefined) return known;
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(surface.positions, 3));
    geometry.setIndex(new THREE.BufferAttribute(surface.indices, 1));
    this.geometries.set(name, geometry);
    return geometry;
  }
}

function key(avatar: number, step: number, link: number): string {
  return `${avatar}:${step}:${link}`;
}
