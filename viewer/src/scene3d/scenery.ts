// The scene: one flat-shaded mesh in neutral tones, with its sharp edges drawn where that is cheap.

import * as THREE from "three";
import type { Scene } from "../data/document.js";
import type { Cutaway } from "./cutaway.js";
import type { Palette } from "./palette.js";

/** Finding edges takes time and memory; scans have no sharp ones worth it. */
const maxTrianglesWithEdges = 40000;
const edgeAngleDegrees = 25;
/** How much lighter or darker than the tone of the scene an object may be. */
const toneRange = 0.12;

export class Scenery {
  readonly group = new THREE.Group();
  private readonly faces: THREE.MeshLambertMaterial;
  private readonly edges = new THREE.LineBasicMaterial();

  constructor(scene: Scene, cutaway: Cutaway) {
    this.faces = new THREE.MeshLambertMaterial({
      flatShading: true,
      side: THREE.DoubleSide,
      vertexColors: true,
      polygonOffset: true,
      polygonOffsetFactor: 1,
      polygonOffsetUnits: 1,
    });
    cutaway.applyTo(this.faces);
    cutaway.applyTo(this.edges);
    if (scene.indices.length === 0) return;
    const geometry = sceneGeometry(scene);
    this.group.add(new THREE.Mesh(geometry, this.faces));
    if (scene.indices.length / 3 <= maxTrianglesWithEdges) {
      this.group.add(new THREE.LineSegments(new THREE.EdgesGeometry(geometry, edgeAngleDegrees), this.edges));
    }
  }

  paint(palette: Palette): void {
    this.faces.color.set(palette.scene);
    this.edges.color.set(palette.sceneEdge);
  }
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
    const tone = 1 + toneRange * (2 * scattered(index) - 1);
    for (let i = 3 * object.first; i < 3 * (object.first + object.count); ++i) {
      colours.fill(tone, 3 * scene.indices[i], 3 * scene.indices[i] + 3);
    }
  });
  return colours;
}

/** Numbers in [0,1) that lie far apart for neighbouring indices: multiples of the golden ratio. */
function scattered(index: number): number {
  return (index * 0.6180339887 + 0.5) % 1;
}
