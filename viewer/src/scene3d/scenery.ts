// The scene: one flat-shaded mesh in quiet tones, with its sharp edges drawn where that is cheap.

import * as THREE from "three";
import type { Scene } from "../data/document.js";
import type { ContactShadow } from "./contact_shadow.js";
import { shadowFunction } from "./contact_shadow.js";
import type { Cutaway } from "./cutaway.js";
import { cutDeclarations, cutTest } from "./cutaway.js";
import { coarsened } from "./coarse.js";
import type { Palette } from "./palette.js";
import { litFunction, setScreenColour } from "./shading.js";

/** Finding edges takes time and memory; scans have no sharp ones worth it. */
const maxTrianglesWithEdges = 40000;
const edgeAngleDegrees = 25;
/** How much lighter or darker, warmer or cooler than the tone of the scene an object may be. */
const toneRange = 0.1, warmthRange = 0.05;

export class Scenery {
  readonly group = new THREE.Group();
  private readonly faces: THREE.ShaderMaterial;
  /** For pictures that move where drawing is slow. */
  private readonly quickFaces: THREE.ShaderMaterial;
  private readonly edges = new THREE.LineBasicMaterial();

  private readonly thin = new THREE.LineBasicMaterial();
  private fine: THREE.Group | null = null;
  private readonly coarse = new Map<number, THREE.Group>();

  constructor(
    private readonly scene: Scene,
    cutaway: Cutaway,
    shadow: ContactShadow,
  ) {
    this.faces = facesMaterial(cutaway, shadow, true);
    this.quickFaces = facesMaterial(cutaway, shadow, false);
    cutaway.applyTo(this.edges);
    cutaway.applyTo(this.thin);
    if (scene.indices.length === 0) return;
    const geometry = sceneGeometry(scene);
    this.fine = new THREE.Group().add(new THREE.Mesh(geometry, this.faces));
    if (scene.indices.length / 3 <= maxTrianglesWithEdges) {
      this.fine.add(new THREE.LineSegments(new THREE.EdgesGeometry(geometry, edgeAngleDegrees), this.edges));
    }
    this.group.add(this.fine);
  }

  /** In at most so many triangles, which are found when first asked for; null for all of them. */
  set maxTriangles(most: number | null) {
    const count = this.scene.indices.length / 3;
    const coarse = most === null || count <= most ? null : this.coarse.get(most) ?? this.addCoarse(most);
    if (this.fine !== null) {
      this.fine.visible = coarse === null;
      (this.fine.children[0] as THREE.Mesh).material = most === null ? this.faces : this.quickFaces;
    }
    for (const group of this.coarse.values()) group.visible = group === coarse;
  }

  private addCoarse(most: number): THREE.Group {
    const { positions, indices } = this.scene;
    const { triangles, lines } = coarsened(positions, indices, most);
    const over = (index: Uint32Array): THREE.BufferGeometry => {
      const geometry = (this.fine?.children[0] as THREE.Mesh).geometry.clone();
      return geometry.setIndex(new THREE.BufferAttribute(index, 1));
    };
    const group = new THREE.Group().add(new THREE.Mesh(over(triangles), this.quickFaces), new THREE.LineSegments(over(lines), this.thin));
    this.coarse.set(most, group);
    this.group.add(group);
    return group;
  }

  paint(palette: Palette): void {
    for (const faces of [this.faces, this.quickFaces]) setScreenColour(faces.uniforms["tone"].value as THREE.Color, palette.scene);
    this.edges.color.set(palette.sceneEdge);
    this.thin.color.set(palette.scene);
  }
}

/** Normals are those of the triangles, as seen from either side. */
function facesMaterial(cutaway: Cutaway, shadow: ContactShadow, isSoft: boolean): THREE.ShaderMaterial {
  return new THREE.ShaderMaterial({
    side: THREE.DoubleSide,
    vertexColors: true,
    polygonOffset: true,
    polygonOffsetFactor: 1,
    polygonOffsetUnits: 1,
    uniforms: { ...cutaway.uniforms, ...shadow.uniforms, tone: { value: new THREE.Color() } },
    vertexShader: `
varying vec3 cutPosition;
varying vec3 shadowPosition;
varying vec3 vTone;
uniform vec3 tone;
void main() {
  shadowPosition = position;
  vTone = tone * color;
  vec4 seen = viewMatrix * vec4(position, 1.0);
  cutPosition = seen.xyz;
  gl_Position = projectionMatrix * seen;
}`,
    fragmentShader: `
varying vec3 vTone;
${cutDeclarations}
${shadowFunction(isSoft)}
${litFunction}
void main() {
  ${cutTest}
  vec3 nhat = normalize(cross(dFdx(shadowPosition), dFdy(shadowPosition)));
  gl_FragColor = vec4(lit(vTone, nhat) * contactShade(nhat), 1.0);
}`,
  });
}

function sceneGeometry(scene: Scene): THREE.BufferGeometry {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(scene.positions, 3));
  geometry.setAttribute("color", new THREE.BufferAttribute(tones(scene), 3));
  geometry.setIndex(new THREE.BufferAttribute(scene.indices, 1));
  return geometry;
}

/** A tone a vertex, by the object that it belongs to. */
function tones(scene: Scene): Float32Array {
  const colours = new Float32Array(scene.positions.length).fill(1);
  scene.objects.forEach((object, index) => {
    const tone = 1 + toneRange * (2 * scattered(index) - 1), warmth = warmthRange * (2 * scattered(3 * index + 1) - 1);
    for (let i = 3 * object.first; i < 3 * (object.first + object.count); ++i) {
      colours.set([tone + warmth, tone, tone - warmth], 3 * scene.indices[i]);
    }
  });
  return colours;
}

/** Numbers in [0,1) that lie far apart for neighbouring indices: multiples of the golden ratio. */
function scattered(index: number): number {
  return (index * 0.6180339887 + 0.5) % 1;
}
