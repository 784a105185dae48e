// What lets feet stand: surfaces that look up are darker the nearer a body is above them. The body
// is drawn once from below, as heights over a square; the scene's shader looks up into it.

import * as THREE from "three";
import type { Bounds } from "../data/document.js";
import { skinned } from "./avatar_body.js";

/** Of the square's side: a texel is about 2 cm. */
const texels = 128;
/** Around the body, and the least side of the square, metres. */
const margin = 0.15, smallest = 0.5;
/** Where no body is above, metres over the square's floor: a half float holds it. */
const noBody = 1000;
/** A square that no surface is over, metres. */
const noWhere = 1e9;

/**
 * contactShade(nhat): how much of the light is left at a point of the view with that normal. A
 * processor that draws looks up for every fragment, wherever the body is: in pictures that move once.
 */
export const shadowFunction = (isSoft: boolean): string => `
varying vec3 shadowPosition;
uniform sampler2D shadowHeights;
uniform vec4 shadowSquare;
float shadeUnder(vec2 at, float height) {
  float gap = texture2D(shadowHeights, at).r - height;
  return gap < -0.04 ? 0.0 : exp(-max(0.0, gap) / 0.11);
}
float contactShade(vec3 nhat) {
  vec2 at = (shadowPosition.xz - shadowSquare.xy) * shadowSquare.w;
  vec2 off = abs(at - 0.5);
  float shade = 0.0;
  if (nhat.y > 0.25 && max(off.x, off.y) < 0.5) {
    float height = shadowPosition.y - shadowSquare.z, near = 0.022 * shadowSquare.w, far = 0.055 * shadowSquare.w;
    ${isSoft ? softShade : "shade = 10.0 * shadeUnder(at, height);"}
  }
  return 1.0 - 0.046 * shade;
}`;

/** Around the point, near and far. */
const softShade = `
    shade = 2.0 * shadeUnder(at, height);
    shade += shadeUnder(at + vec2(near, near), height) + shadeUnder(at + vec2(-near, near), height);
    shade += shadeUnder(at + vec2(near, -near), height) + shadeUnder(at + vec2(-near, -near), height);
    shade += shadeUnder(at + vec2(far, 0.0), height) + shadeUnder(at + vec2(-far, 0.0), height);
    shade += shadeUnder(at + vec2(0.0, far), height) + shadeUnder(at + vec2(0.0, -far), height);`;

export class ContactShadow {
  /** Left, front and floor of the square in the view's coordinates, and one over its side. */
  private readonly square = { value: new THREE.Vector4(noWhere, noWhere, 0, 1) };
  private readonly target = new THREE.WebGLRenderTarget(texels, texels, { type: THREE.HalfFloatType, format: THREE.RedFormat, depthBuffer: true });
  private readonly camera = new THREE.OrthographicCamera();
  private readonly scene = new THREE.Scene();
  private readonly material = heightMaterial(this.square);
  private readonly doubles = new Map<THREE.SkinnedMesh, THREE.SkinnedMesh>();

  get uniforms(): Record<string, THREE.IUniform> {
    return { shadowHeights: { value: this.target.texture }, shadowSquare: this.square };
  }

  /** What casts the shadow: the bodies given, within `bounds` of the view; nothing where that is null. */
  cast(renderer: THREE.WebGLRenderer, bodies: readonly THREE.SkinnedMesh[], bounds: Bounds | null): void {
    if (bounds === null) return void this.square.value.set(noWhere, noWhere, 0, 1);
    const { min, max } = bounds;
    const side = Math.max(smallest, max[0] - min[0], max[2] - min[2]) + 2 * margin;
    const left = (min[0] + max[0] - side) / 2, front = (min[2] + max[2] - side) / 2;
    this.square.value.set(left, front, min[1], 1 / side);
    for (const double of this.doubles.values()) double.visible = false;
    for (const body of bodies) this.doubleOf(body).visible = true;
    renderer.setRenderTarget(this.target);
    renderer.setClearColor(new THREE.Color(noBody, 0, 0), 1);
    renderer.render(this.scene, this.camera);
    renderer.setRenderTarget(null);
  }

  private doubleOf(body: THREE.SkinnedMesh): THREE.SkinnedMesh {
    let double = this.doubles.get(body);
    if (double === undefined) {
      double = skinned(body.geometry, this.material, body.skeleton);
      this.doubles.set(body, double);
      this.scene.add(double);
    }
    double.geometry = body.geometry;
    return double;
  }
}

/** From below: of two parts the lower one wins. */
function heightMaterial(square: { value: THREE.Vector4 }): THREE.ShaderMaterial {
  return new THREE.ShaderMaterial({
    side: THREE.DoubleSide,
    uniforms: { shadowSquare: square },
    vertexShader: `
#include <common>
#include <skinning_pars_vertex>
uniform vec4 shadowSquare;
varying float height;
void main() {
  vec3 p = (getBoneMatrix(skinIndex.x) * vec4(position, 1.0)).xyz;
  height = p.y - shadowSquare.z;
  vec2 at = (p.xz - shadowSquare.xy) * shadowSquare.w;
  gl_Position = vec4(2.0 * at - 1.0, height / 4.0 - 0.9, 1.0);
}`,
    fragmentShader: `
varying float height;
void main() {
  gl_FragColor = vec4(height, 0.0, 0.0, 1.0);
}`,
  });
}
