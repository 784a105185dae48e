// The outline of a trigger: lines that move with it, and hide nothing.

import * as THREE from "three";
import type { Palette } from "./palette.js";
import { setScreenColour } from "./shading.js";

/** Seen through what is before it, as a share of its colour. */
const behind = 0.35;

export class Outline {
  private readonly lines: readonly THREE.LineSegments[];
  private readonly colours: readonly THREE.ShaderMaterial[];

  /** Two points per line, in the frame of the trigger's one link. */
  constructor(points: Float32Array, parent: THREE.Object3D) {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(points, 3));
    this.colours = [lineMaterial(1, THREE.LessEqualDepth), lineMaterial(behind, THREE.GreaterDepth)];
    this.lines = this.colours.map((material) => {
      const made = new THREE.LineSegments(geometry, material);
      made.frustumCulled = false;
      made.matrixAutoUpdate = false;
      made.renderOrder = 4;
      return made;
    });
    parent.add(...this.lines);
  }

  /** `world`: of its link, rotation row by row, then the origin. */
  place(world: Float64Array, origin: readonly number[]): void {
    for (const line of this.lines) {
      line.matrix.set(
        world[0], world[1], world[2], world[9] - origin[0],
        world[3], world[4], world[5], world[10] - origin[1],
        world[6], world[7], world[8], world[11] - origin[2],
        0, 0, 0, 1,
      );
      line.matrixWorldNeedsUpdate = true;
    }
  }

  paint(palette: Palette): void {
    for (const material of this.colours) setScreenColour(material.uniforms["colour"].value as THREE.Color, palette.trigger);
  }
}

function lineMaterial(opacity: number, depthFunc: THREE.DepthModes): THREE.ShaderMaterial {
  return new THREE.ShaderMaterial({
    transparent: true,
    depthWrite: false,
    depthFunc,
    uniforms: { colour: { value: new THREE.Color() }, opacity: { value: opacity } },
    vertexShader: `
void main() {
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`,
    fragmentShader: `
uniform vec3 colour;
uniform float opacity;
void main() {
  gl_FragColor = vec4(colour, opacity);
}`,
  });
}
