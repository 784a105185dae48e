// The ways that feet slid, as ribbons on the ground.

import * as THREE from "three";
import { isSlide } from "../contacts/feet.js";
import type { Touch } from "../contacts/touch.js";
import type { Vector } from "../data/document.js";
import type { Palette } from "./palette.js";

/** Of a ribbon, metres: half as wide, and above the ground, so that it is seen. */
const halfWidth = 0.004, above = 0.002;
/** Where a slide began. */
const dotRadius = 0.008, dotSides = 12;

export class SlideTraces {
  readonly group = new THREE.Group();
  private readonly onGround = new THREE.MeshBasicMaterial({ side: THREE.DoubleSide, polygonOffset: true, polygonOffsetFactor: -2, polygonOffsetUnits: -2 });
  /** Of the chosen foot, which stands on it: seen through the foot. */
  private readonly through = new THREE.MeshBasicMaterial({ side: THREE.DoubleSide, depthTest: false, transparent: true });
  private readonly chosen = new THREE.Mesh(new THREE.BufferGeometry(), this.through);
  private shown: Touch | null = null;

  constructor(
    stances: readonly Touch[],
    private readonly origin: Vector,
  ) {
    const all = new THREE.Mesh(this.geometryOf(stances), this.onGround);
    this.chosen.renderOrder = 2;
    this.chosen.visible = false;
    for (const mesh of [all, this.chosen]) mesh.frustumCulled = false;
    this.group.add(all, this.chosen);
  }

  /** The chosen touch, if it is one of a foot. */
  choose(touch: Touch | null): void {
    if (touch === this.shown) return;
    this.shown = touch;
    this.chosen.geometry.dispose();
    this.chosen.geometry = this.geometryOf(touch === null ? [] : [touch]);
    this.chosen.visible = touch !== null && touch.stance !== null;
  }

  paint(palette: Palette): void {
    this.onGround.color.set(palette.slide);
    this.through.color.set(palette.slide);
  }

  private geometryOf(stances: readonly Touch[]): THREE.BufferGeometry {
    const corners: number[] = [], { origin } = this;
    for (const { stance } of stances) {
      if (stance === null || !isSlide(stance)) continue;
      const points = stance.trace.map((point) => new THREE.Vector3(point[0] - origin[0], point[1] - origin[1] + above, point[2] - origin[2]));
      points.slice(1).forEach((to, i) => addRibbon(points[i], to, corners));
      if (points.length > 0) addDot(points[0], corners);
    }
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(corners), 3));
    return geometry;
  }
}

function addRibbon(from: THREE.Vector3, to: THREE.Vector3, corners: number[]): void {
  const side = new THREE.Vector3(to.z - from.z, 0, from.x - to.x);
  if (side.lengthSq() === 0) return;
  side.setLength(halfWidth);
  const [a, b] = [from.clone().add(side), from.clone().sub(side)], [c, d] = [to.clone().add(side), to.clone().sub(side)];
  for (const corner of [a, b, c, c, b, d]) corners.push(...corner.toArray());
}

function addDot(at: THREE.Vector3, corners: number[]): void {
  const rim = (i: number): number[] => {
    const angle = (2 * Math.PI * i) / dotSides;
    return [at.x + dotRadius * Math.cos(angle), at.y, at.z + dotRadius * Math.sin(angle)];
  };
  for (let i = 0; i < dotSides; ++i) corners.push(...at.toArray(), ...rim(i), ...rim(i + 1));
}
