// What the tests are made of: a room, a hand as three.js has it of WebXR, a worm of bones.

import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import * as THREE from "three";
import { Foretouch } from "foretouch";
import { handJoints } from "foretouch/host";

export const module = readFileSync(createRequire(import.meta.url).resolve("foretouch/foretouch.wasm"));
export const ft = await Foretouch.load(module);
export const tickMs = 1000 / 72;

export function box(name, size, place, parent) {
  const mesh = new THREE.Mesh(new THREE.BoxGeometry(...size), new THREE.MeshBasicMaterial());
  mesh.name = name;
  mesh.position.set(...place);
  parent?.add(mesh);
  return mesh;
}

/** Joints at rest, fingers along -z, in the hand's own space: place and radius of each. */
function restOf(joint) {
  const { name } = handJoints[joint], finger = ["thumb", "index", "middle", "ring", "pinky"].findIndex((one) => name.startsWith(one));
  if (finger < 0) return { place: [0, 0, 0], radius: 0.02 };
  const along = ["metacarpal", "proximal", "intermediate", "distal", "tip"].findIndex((one) => name.endsWith(one));
  return { place: [0.02 * (finger - 2), 0, -0.02 - 0.025 * along], radius: 0.011 - 0.001 * along };
}

/** As renderer.xr.getHand() has it once it is tracked. */
export function handSpace() {
  const space = new THREE.Group();
  space.matrixAutoUpdate = false;
  space.name = "hand";
  space.joints = {};
  handJoints.forEach(({ name }, joint) => {
    const group = new THREE.Group();
    group.matrixAutoUpdate = false;
    group.visible = false;
    group.jointRadius = restOf(joint).radius;
    space.joints[name] = group;
    space.add(group);
  });
  return space;
}

/** All joints, led as a whole. */
export function lead(space, place, turn = new THREE.Euler()) {
  const whole = new THREE.Matrix4().compose(new THREE.Vector3(...place), new THREE.Quaternion().setFromEuler(turn), new THREE.Vector3(1, 1, 1));
  handJoints.forEach(({ name }, joint) => {
    const group = space.joints[name];
    group.matrix.copy(whole).multiply(new THREE.Matrix4().makeTranslation(...restOf(joint).place));
    group.matrixWorldNeedsUpdate = group.visible = true;
  });
}

/** A tube of 1 m along y on so many bones, two per ring of its vertices. */
export function worm(bones = 5, scale = 1) {
  const geometry = new THREE.CylinderGeometry(0.05, 0.05, 1, 12, 4 * bones), { position } = geometry.attributes;
  const index = [], weight = [];
  for (let i = 0; i < position.count; ++i) {
    const at = (position.getY(i) + 0.5) * (bones - 1), below = Math.min(bones - 2, Math.floor(at));
    index.push(below, below + 1, 0, 0);
    weight.push(1 - (at - below), at - below, 0, 0);
  }
  geometry.setAttribute("skinIndex", new THREE.Uint16BufferAttribute(index, 4));
  geometry.setAttribute("skinWeight", new THREE.Float32BufferAttribute(weight, 4));
  const all = Array.from({ length: bones }, (_, i) => {
    const bone = new THREE.Bone();
    bone.name = `bone${i}`;
    bone.position.y = i === 0 ? -0.5 : 1 / (bones - 1);
    return bone;
  });
  all.forEach((bone, i) => i > 0 && all[i - 1].add(bone));
  const mesh = new THREE.SkinnedMesh(geometry, new THREE.MeshBasicMaterial());
  mesh.name = "worm";
  mesh.add(all[0]);
  mesh.bind(new THREE.Skeleton(all));
  mesh.scale.setScalar(scale);
  return mesh;
}

/** Updates, so many frames, `each` before every one; the clock goes on from `fromMs`. */
export function frames(world, count, each, fromMs = 0) {
  for (let i = 1; i <= count; ++i) {
    each?.(i);
    world.update(fromMs + i * tickMs);
  }
  return fromMs + count * tickMs;
}
