// What the tests are made of: a room, a session of WebXR as Babylon.js has it, a worm of bones.

import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { Bone } from "@babylonjs/core/Bones/bone.js";
import { Skeleton } from "@babylonjs/core/Bones/skeleton.js";
import { FreeCamera } from "@babylonjs/core/Cameras/freeCamera.js";
import { NullEngine } from "@babylonjs/core/Engines/nullEngine.js";
import { Matrix, Vector3 } from "@babylonjs/core/Maths/math.vector.js";
import { CreateBox } from "@babylonjs/core/Meshes/Builders/boxBuilder.js";
import { CreateCylinder } from "@babylonjs/core/Meshes/Builders/cylinderBuilder.js";
import "@babylonjs/core/Meshes/instancedMesh.js";
import { Scene } from "@babylonjs/core/scene.js";
import { Foretouch } from "foretouch";
import { handJoints } from "foretouch/host";

export const ft = await Foretouch.load(readFileSync(createRequire(import.meta.url).resolve("foretouch/foretouch.wasm")));
export const tickMs = 1000 / 72;

export function sceneOf() {
  const scene = new Scene(new NullEngine());
  new FreeCamera("camera", Vector3.Zero(), scene);
  return scene;
}

export function box(scene, name, [width, height, depth], place, parent = null) {
  const mesh = CreateBox(name, { width, height, depth }, scene);
  mesh.position.set(...place);
  mesh.parent = parent;
  return mesh;
}

/** Joints at rest, fingers along -z of WebXR. */
function restOf(joint) {
  const { name } = handJoints[joint], finger = ["thumb", "index", "middle", "ring", "pinky"].findIndex((one) => name.startsWith(one));
  if (finger < 0) return { place: [0, 0, 0], radius: 0.02 };
  const along = ["metacarpal", "proximal", "intermediate", "distal", "tip"].findIndex((one) => name.endsWith(one));
  return { place: [0.02 * (finger - 2), 0, -0.02 - 0.025 * along], radius: 0.011 - 0.001 * along };
}

/** As xr.baseExperience has it while a right hand is tracked; lead() moves it, in WebXR's own axes. */
export function experience() {
  let place = null;
  const hand = new Map(handJoints.map(({ name }, joint) => [name, joint]));
  const frame = {
    getJointPose(joint) {
      const rest = restOf(joint), [x, y, z] = rest.place.map((value, i) => value + place[i]);
      return { transform: { position: { x, y, z }, orientation: { x: 0, y: 0, z: 0, w: 1 } }, radius: rest.radius };
    },
  };
  return {
    sessionManager: { get currentFrame() { return place === null ? null : frame; }, referenceSpace: {}, session: { inputSources: [{ handedness: "right", hand }] } },
    camera: { parent: null },
    lead: (to) => (place = to),
  };
}

/** A tube of 1 m along y on so many bones. */
export function worm(scene, name = "worm", bones = 5) {
  const mesh = CreateCylinder(name, { height: 1, diameter: 0.1, tessellation: 12, subdivisions: 4 * bones }, scene), positions = mesh.getVerticesData("position");
  const indices = [], weights = [];
  for (let i = 0; i < positions.length / 3; ++i) {
    const at = (positions[3 * i + 1] + 0.5) * (bones - 1), below = Math.min(bones - 2, Math.floor(at));
    indices.push(below, below + 1, 0, 0);
    weights.push(1 - (at - below), at - below, 0, 0);
  }
  mesh.setVerticesData("matricesIndices", indices);
  mesh.setVerticesData("matricesWeights", weights);
  const skeleton = new Skeleton(name, name, scene);
  let parent = null;
  for (let i = 0; i < bones; ++i) parent = new Bone(`bone${i}`, skeleton, parent, Matrix.Translation(0, i === 0 ? -0.5 : 1 / (bones - 1), 0));
  mesh.skeleton = skeleton;
  return mesh;
}

export function frames(world, count, each, fromMs = 0) {
  for (let i = 1; i <= count; ++i) {
    each?.(i);
    world.update(fromMs + i * tickMs);
  }
  return fromMs + count * tickMs;
}
