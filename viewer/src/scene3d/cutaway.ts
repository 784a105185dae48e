// Cuts a window into what stands between the camera and what one wants to see: fragments of the
// scene within a cone around the line of sight, and nearer than the focus, are left out.

import * as THREE from "three";

export class Cutaway {
  private readonly focus = { value: new THREE.Vector3() };
  private readonly radius = { value: 0 };

  /** `focus` in the view's coordinates; a radius of 0 cuts nothing. Metres. */
  aim(camera: THREE.Camera, focus: THREE.Vector3, radius: number): void {
    this.focus.value.copy(focus).applyMatrix4(camera.matrixWorldInverse);
    this.radius.value = radius;
  }

  applyTo(material: THREE.Material): void {
    material.onBeforeCompile = (shader) => {
      shader.uniforms["cutFocus"] = this.focus;
      shader.uniforms["cutRadius"] = this.radius;
      shader.vertexShader = shader.vertexShader
        .replace("#include <common>", "#include <common>\nvarying vec3 cutPosition;")
        .replace("#include <project_vertex>", "#include <project_vertex>\ncutPosition = mvPosition.xyz;");
      shader.fragmentShader = shader.fragmentShader
        .replace("#include <common>", `#include <common>\n${declarations}`)
        .replace("#include <clipping_planes_fragment>", `#include <clipping_planes_fragment>\n${test}`);
    };
  }
}

const declarations = `
varying vec3 cutPosition;
uniform vec3 cutFocus;
uniform float cutRadius;`;

const test = `
if (cutRadius > 0.0) {
  float cutDistance = length(cutFocus);
  vec3 cutAxis = cutFocus / cutDistance;
  float cutAlong = dot(cutPosition, cutAxis);
  float cutAside = length(cutPosition - cutAlong * cutAxis);
  if (cutAlong < cutDistance - cutRadius && cutAside < 0.8 * cutRadius * cutAlong / cutDistance + 0.05) discard;
}`;
