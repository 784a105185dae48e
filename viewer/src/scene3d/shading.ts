// Light, as shaders: a sky that is brighter than the ground, a sun and a little light from behind.
// The materials of three.js can do far more, and cost a processor that draws several times as much:
// here a fragment has a dozen multiplications, and colours are those of the screen from the start
// (to turn them from linear ones takes three powers a fragment).

import * as THREE from "three";

/** lit(colour, nhat_W): what is seen of a surface with that unit normal in the world. */
export const litFunction = `
vec3 lit(vec3 colour, vec3 nhat) {
  vec3 light = vec3(0.70, 0.70, 0.71) + vec3(0.095, 0.105, 0.12) * nhat.y;
  light += vec3(0.24, 0.23, 0.21) * max(0.0, dot(nhat, vec3(0.427, 0.855, 0.299)));
  light += vec3(0.09, 0.09, 0.11) * max(0.0, dot(nhat, vec3(-0.768, 0.329, -0.549)));
  return colour * light;
}`;

/** The screen's own numbers for a colour, for the shaders here. */
export function setScreenColour(target: THREE.Color, colour: string): void {
  new THREE.Color(colour).getRGB(target, THREE.SRGBColorSpace);
}

/**
 * Of links: each vertex belongs to one, has that bone's transform and that link's colour. With
 * facets every triangle is flat, and seen from both sides: things need not be round, nor closed.
 */
export function linkMaterial(colour: "links" | "one", rest: THREE.ShaderMaterialParameters = {}, hasFacets = false): THREE.ShaderMaterial {
  return new THREE.ShaderMaterial({
    ...rest,
    side: hasFacets ? THREE.DoubleSide : THREE.FrontSide,
    uniforms: { colours: { value: null }, colour: { value: new THREE.Color() }, opacity: { value: rest.opacity ?? 1 } },
    vertexShader: `
#include <common>
#include <skinning_pars_vertex>
uniform sampler2D colours;
uniform vec3 colour;
varying vec3 vNormal;
varying vec3 vColour;
varying vec3 vPlace;
void main() {
  mat4 bone = getBoneMatrix(skinIndex.x);
  vNormal = mat3(bone) * normal;
  vColour = ${colour === "links" ? "texelFetch(colours, ivec2(int(skinIndex.x), 0), 0).rgb" : "colour"};
  vec4 place = bone * vec4(position, 1.0);
  vPlace = place.xyz;
  gl_Position = projectionMatrix * viewMatrix * place;
}`,
    fragmentShader: `
varying vec3 vNormal;
varying vec3 vColour;
varying vec3 vPlace;
uniform float opacity;
${litFunction}
void main() {
  gl_FragColor = vec4(lit(vColour, normalize(${hasFacets ? "cross(dFdx(vPlace), dFdy(vPlace))" : "vNormal"})), opacity);
}`,
  });
}

/** Of one colour; the normals are those of the triangles. */
export function facetMaterial(opacity: number): THREE.ShaderMaterial {
  return new THREE.ShaderMaterial({
    transparent: true,
    depthWrite: false,
    uniforms: { colour: { value: new THREE.Color() }, opacity: { value: opacity } },
    vertexShader: `
varying vec3 vPlace;
void main() {
  vec4 place = modelMatrix * vec4(position, 1.0);
  vPlace = place.xyz;
  gl_Position = projectionMatrix * viewMatrix * place;
}`,
    fragmentShader: `
varying vec3 vPlace;
uniform vec3 colour;
uniform float opacity;
${litFunction}
void main() {
  gl_FragColor = vec4(lit(colour, normalize(cross(dFdx(vPlace), dFdy(vPlace)))), opacity);
}`,
  });
}
