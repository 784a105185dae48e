// Cuts a window into what stands between the camera and what one wants to see: fragments of the
// scene within a cone around the line of sight, and nearer than the focus, are left out.

import * as THREE from "three";

export class Cutaway {
  /** Unit direction from the camera to the focus, and how far that is; in the camera's coordinates. */
  private readonly line = { value: new THREE.Vector4(0, 0, -1, 1) };
  private readonly radius = { value: 0 };

  /** `focus` in the view's coordinates; a radius of 0 cuts nothing. Metres. */
  aim(camera: THREE.Camera, focus: THREE.Vector3, radius: number): void {
    const seen = focus.clone().applyMatrix4(camera.matrixWorldInverse), distance = seen.length();
    seen.divideScalar(Math.max(1e-9, distance));
    this.line.value.set(seen.x, seen.y, seen.z, distance);
    this.radius.value = radius;
  }

  /** For shaders that take cutDeclarations and cutTest themselves, with a varying "cutPosition" in the view's coordinates. */
  get uniforms(): Record<string, THREE.IUniform> {
    return { cutLine: this.line, cutRadius: this.radius };
  }

  applyTo(material: THREE.Material): void {
    material.onBeforeCompile = (shader) => {
      Object.assign(shader.uniforms, this.uniforms);
      shader.vertexShader = shader.vertexShader
        .replace("#include <common>", "#include <common>\nvarying vec3 cutPosition;")
        .replace("#include <project_vertex>", "#include <project_vertex>\ncutPosition = mvPosition.xyz;");
      shader.fragmentShader = shader.fragmentShader
        .replace("#include <common>", `#include <common>\n${cutDeclarations}`)
        .replace("#include <clipping_planes_fragment>", `#include <clipping_planes_fragment>\n${cutTest}`);
    };
  }
}

export const cutDeclarations = `
varying vec3 cutPosition;
uniform vec4 cutLine;
uniform float cutRadius;`;

export const cutTest = `
if (cutRadius > 0.0) {
  float cutAlong = dot(cutPosition, cutLine.xyz);
  if (cutAlong < cutLine.w - cutRadius) {
    float cutReach = 0.8 * cutRadius * cutAlong / cutLine.w + 0.05;
    if (dot(cutPosition, cutPosition) - cutAlong * cutAlong < cutReach * cutReach && cutReach > 0.0) discard;
  }
}`;
