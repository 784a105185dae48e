// Files that a person drops: scenes as triangles; clips and avatars are texts that the library reads.
// Nothing leaves the page.

import * as THREE from "three";
import { Refused } from "./engine.js";
import type { NamedScene } from "./room.js";

/** A file of more is refused before it is read, and a scene of more before it is asked: a page has not the memory. */
const mostBytes = 100e6, mostTriangles = 2_000_000;

export type Dropped =
  | { readonly kind: "scene"; readonly scene: NamedScene }
  | { readonly kind: "clip"; readonly text: string }
  | { readonly kind: "avatar"; readonly text: string };

export async function readDropped(file: File): Promise<Dropped> {
  const ending = (/\.([a-z0-9]+)$/i.exec(file.name)?.[1] ?? "").toLowerCase();
  if (!["bvh", "json", "obj", "glb", "gltf", "vrm"].includes(ending)) {
    throw new Refused(`${file.name}: expected a scene (.glb, .gltf, .vrm, .obj), a clip (.bvh) or an avatar (.json).`);
  }
  if (file.size > mostBytes) {
    throw new Refused(`${file.name}: expected at most ${mostBytes / 1e6} MB, found ${Math.round(file.size / 1e6)}. The program foretouch reads larger ones.`);
  }
  if (ending === "bvh") return { kind: "clip", text: await file.text() };
  if (ending === "json") return { kind: "avatar", text: await file.text() };
  const group = ending === "obj" ? await readObj(file) : await readGltf(file);
  return { kind: "scene", scene: trianglesOf(group, file.name) };
}

async function readObj(file: File): Promise<THREE.Object3D> {
  const { OBJLoader } = await import("three/examples/jsm/loaders/OBJLoader.js");
  return new OBJLoader().parse(await file.text());
}

async function readGltf(file: File): Promise<THREE.Object3D> {
  const { GLTFLoader } = await import("three/examples/jsm/loaders/GLTFLoader.js");
  try {
    const { scene } = await new GLTFLoader().parseAsync(await file.arrayBuffer(), "");
    return scene;
  } catch (reason) {
    throw new Refused(`${file.name}: expected glTF that holds all its data itself (${reason instanceof Error ? reason.message : String(reason)}).`);
  }
}

function trianglesOf(group: THREE.Object3D, name: string): NamedScene {
  group.updateMatrixWorld(true);
  const positions: number[] = [], indices: number[] = [], objects: number[] = [], objectNames: string[] = [];
  const corner = new THREE.Vector3();
  group.traverse((node) => {
    if (!(node instanceof THREE.Mesh)) return;
    const geometry = node.geometry as THREE.BufferGeometry, places = geometry.getAttribute("position"), first = positions.length / 3;
    if (places === undefined) return;
    for (let i = 0; i < places.count; ++i) {
      corner.fromBufferAttribute(places, i).applyMatrix4(node.matrixWorld);
      positions.push(corner.x, corner.y, corner.z);
    }
    const index = geometry.getIndex(), corners = index?.count ?? places.count;
    if (indices.length + corners > 3 * mostTriangles) {
      throw new Refused(`${name}: expected at most ${mostTriangles.toLocaleString("en")} triangles. The program foretouch reads larger scenes.`);
    }
    for (let i = 0; i + 2 < corners; i += 3) {
      for (let k = 0; k < 3; ++k) indices.push(first + (index === null ? i + k : index.getX(i + k)));
      objects.push(objectNames.length);
    }
    objectNames.push(node.name === "" ? `object ${objectNames.length}` : node.name);
  });
  if (indices.length === 0) throw new Refused(`${name}: expected triangles, found none.`);
  return { name, objectNames, positions: Float32Array.from(positions), indices: Uint32Array.from(indices), objects: Int32Array.from(objects) };
}
