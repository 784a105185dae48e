// The scene: one flat-shaded mesh in neutral tones, with its sharp edges drawn where that is cheap.

import * as THREE from "three";
import type { Scene } from "../data/document.js";
import type { Cutaway } from "./cutaway.js";
import { coarsened } from "./coarse.js";
import type { Palette } from "./palette.js";

/** Finding edges takes time and memory; scans have no sharp ones worth it. */
const maxTrianglesWithEdges = 40000;
const edgeAngleDegrees = 25;
/** While drawing is slow. */
const maxCoarseTriangles = 30000;
/** How much lighter or darker than the tone of the scene an object may be. */
const toneRange = 0.12;

export class Scenery {
  readonly group = new THREE.Group();
  private readonly faces: THREE.MeshLambertMaterial;
  private readonly edges = new THREE.LineBasicMaterial();

  private readonly thin = new THREE.LineBasicMaterial();
  private fine: THREE.Group | null = null;
  private coarse: THREE.Group | null = null;

  constructor(
    private readonly scene: Scene,
    cutaway: Cutaway,
  ) {
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
    cutaway.applyTo(this.thin);
    if (scene.indices.length === 0) return;
    const geometry = sceneGeometry(scene);
    this.fine = new THREE.Group().add(new THREE.Mesh(geometry, this.faces));
    if (scene.indices.length / 3 <= maxTrianglesWithEdges) {
      this.fine.add(new THREE.LineSegments(new THREE.EdgesGeometry(geometry, edgeAngleDegrees), this.edges));
    }
    this.group.add(this.fine);
  }

  /** In fewer triangles, which are found when first asked for. */
  set isCoarse(isCoarse: boolean) {
    if (isCoarse && this.coarse === null && this.scene.indices.length / 3 > maxCoarseTriangles) this.addCoarse();
    if (this.fine === null || this.coarse === null) return;
    this.fine.visible = !isCoarse;
    this.coarse.visible = isCoarse;
  }

  private addCoarse(): void {
    const { positions, indices } = this.scene;
    const { triangles, lines } = coarsened(positions, indices, maxCoarseTriangles);
    const over = (index: Uint32Array): THREE.BufferGeometry => {
      const geometry = (this.fine?.children[0] as THREE.Mesh).geometry.clone();
      return geometry.setIndex(new THREE.BufferAttribute(index, 1));
    };
    this.coarse = new THREE.Group().add(new THREE.Mesh(over(triangles), this.faces), new THREE.LineSegments(over(lines), this.thin));
    this.group.add(this.coarse);
  }

  paint(palette: Palette): void {
    this.faces.color.set(palette.scene);
    this.edges.color.set(palette.sceneEdge);
    this.thin.color.set(palette.scene);
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
