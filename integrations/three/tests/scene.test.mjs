// Object3D trees and skeletons of three.js: what is read of them, what is answered, and what is said of
// bad habits.

import assert from "node:assert/strict";
import { test } from "node:test";
import * as THREE from "three";
import { clone } from "three/addons/utils/SkeletonUtils.js";
import { ForetouchError } from "foretouch";
import { TouchWorld, three } from "../index.js";
import { box, frames, ft, handSpace, lead, worm } from "./things.mjs";

const silent = () => undefined;
const worldOf = (still, notes = []) => new TouchWorld(ft, still, { note: (words, of) => notes.push([words, of]) });
const refuses = (call, words) => assert.throws(call, (error) => error instanceof ForetouchError && words.test(error.message));

test("a tree's shown meshes, instances and interleaved vertices are where three.js draws them", () => {
  const root = new THREE.Group(), inner = new THREE.Group();
  root.position.set(1, 2, 3);
  root.rotation.set(0.3, 0.4, 0.5);
  root.scale.set(1, 2, -3);
  root.add(inner);
  inner.rotation.z = 1;
  const plain = box("plain", [1, 1, 1], [0, 1, 0], inner);
  box("hidden", [1, 1, 1], [0, 5, 0], inner).visible = false;
  const instances = new THREE.InstancedMesh(new THREE.TetrahedronGeometry(1), new THREE.MeshBasicMaterial(), 2);
  instances.setMatrixAt(0, new THREE.Matrix4().makeTranslation(4, 0, 0));
  instances.setMatrixAt(1, new THREE.Matrix4().makeTranslation(0, 4, 0));
  inner.add(instances);
  const buffer = new THREE.InterleavedBuffer(new Float32Array([0, 0, 0, 9, 1, 0, 0, 9, 0, 1, 0, 9]), 4), flat = new THREE.BufferGeometry();
  flat.setAttribute("position", new THREE.InterleavedBufferAttribute(buffer, 3, 0));
  const woven = new THREE.Mesh(flat, new THREE.MeshBasicMaterial());
  inner.add(woven, new THREE.Points(new THREE.BoxGeometry()), new THREE.Sprite(new THREE.SpriteMaterial()));
  const meshes = three.meshesOf(root, silent, () => false);
  assert.deepEqual(meshes.map(({ object }) => object), [plain, instances, instances, woven]);
  const at = ({ positions, matrix }, i) => new THREE.Vector3(positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]).applyMatrix4(new THREE.Matrix4().fromArray(matrix));
  for (const { object, ...mesh } of meshes) {
    const vertex = new THREE.Vector3().fromBufferAttribute(object.geometry.attributes.position, 2);
    if (object === instances) vertex.add(mesh === undefined ? null : new THREE.Vector3(...(meshes.find(({ matrix }) => matrix === mesh.matrix) === meshes[1] ? [4, 0, 0] : [0, 4, 0])));
    assert.ok(object.localToWorld(vertex).distanceTo(at(mesh, 2)) < 1e-6);
  }
});

test("a worm's capsules contain its skin, whatever its scale; a bone that turns meets what it turns into", async () => {
  for (const scale of [1, 0.01, 3]) {
    const mesh = worm(5, scale), room = new THREE.Scene(), post = box("post", [0.1 * scale, 0.1 * scale, 0.1 * scale], [0.3 * scale, 0.3 * scale, 0], room);
    room.add(mesh);
    const world = worldOf(room), body = await world.addBody(mesh), told = [];
    for (const type of ["enter", "leave"]) body.addEventListener(type, (event) => told.push(event));
    frames(world, 3);
    const { links, tracked } = body.member;
    assert.deepEqual(links.map(({ name, parent }) => [name, parent]), [0, 1, 2, 3, 4].map((i) => [`bone${i}`, i === 0 ? null : `bone${i - 1}`]));
    const { position } = mesh.geometry.attributes, vertex = new THREE.Vector3();
    let deepest = 0;
    room.updateMatrixWorld(true);
    for (let i = 0; i < position.count; ++i) {
      mesh.getVertexPosition(i, vertex).applyMatrix4(mesh.matrixWorld);
      const out = links.flatMap(({ lss }, link) => lss.map(({ a, b, radius }) => {
        const frame = new THREE.Matrix4().compose(new THREE.Vector3(...tracked.places.subarray(3 * link, 3 * link + 3)), new THREE.Quaternion(...[1, 2, 3, 0].map((k) => tracked.rotations[4 * link + k])), new THREE.Vector3(1, 1, 1));
        const [p, q] = [a, b].map((end) => new THREE.Vector3(...end).applyMatrix4(frame));
        return new THREE.Line3(p, q).closestPointToPoint(vertex, true, new THREE.Vector3()).distanceTo(vertex) - radius;
      }));
      deepest = Math.max(deepest, Math.min(...out));
    }
    assert.ok(deepest < 1e-6 * scale, `a vertex is ${deepest} outside`);
    // A quarter of a turn in one frame, which no check of the poses sees.
    mesh.skeleton.bones[2].rotation.z = -Math.PI / 2 - 0.3;
    frames(world, 1, undefined, 3 * (1000 / 72));
    assert.ok(told.some(({ type, object, link }) => type === "enter" && object === post && link >= "bone2"), `scale ${scale}: ${told.map(({ type, link }) => `${type} ${link}`)}`);
    assert.ok(told.some(({ type }) => type === "leave"));
  }
});

test("a shown copy of a skeleton stays before a wall, and is equal where it is free", async () => {
  const tracked = worm(5), shown = clone(tracked), room = new THREE.Scene();
  box("wall", [0.01, 4, 4], [0.5, 0, 0], room);
  room.add(tracked, shown);
  const world = worldOf(room), body = await world.addBody(tracked, { shown, liftsFeet: false });
  let now = frames(world, 20, (i) => (tracked.position.z = 0.01 * i));
  assert.equal(body.state, "equal");
  tracked.skeleton.bones.forEach((bone, i) => assert.ok(bone.getWorldPosition(new THREE.Vector3()).distanceTo(shown.skeleton.bones[i].getWorldPosition(new THREE.Vector3())) < 1e-12));
  now = frames(world, 100, (i) => (tracked.position.x = 0.01 * i), now);
  assert.ok(["held", "sliding"].includes(body.state), body.state);
  for (const bone of shown.skeleton.bones) assert.ok(bone.getWorldPosition(new THREE.Vector3()).x < 0.495 - 0.05);
});

test("what a host's bad habits are told, and what happens then", async () => {
  const room = new THREE.Scene(), notes = [];
  box("floor", [4, 0.1, 4], [0, -2, 0], room);
  const empty = new THREE.Mesh(new THREE.BufferGeometry());
  empty.name = "cloud";
  const skinned = worm();
  room.add(empty, skinned);
  const world = worldOf(room, notes);
  frames(world, 2);
  const told = () => new Set(notes.map(([words, of]) => `${of?.name}: ${words}`));
  assert.deepEqual(told(), new Set(["cloud: cloud has no vertices: nothing can touch it", "worm: SkinnedMesh worm is left out of what stands still: add it as a body, world.addBody(mesh)"]));

  const uneven = worm();
  uneven.skeleton.bones[1].scale.set(1, 2, 1);
  await assert.rejects(world.addBody(uneven), /Bone bone1: its scale in the world is \(1\.00, 2\.00, 1\.00\); expected the same along x, y and z/);
  await assert.rejects(world.addBody(new THREE.Group()), /Group \d+: expected a SkinnedMesh with a Skeleton, found none/);
  const bare = worm();
  bare.geometry.setIndex([]);
  await assert.rejects(world.addBody(bare), /expected a skinned mesh with triangles/);
  refuses(() => world.addMoving(new THREE.Group()), /Group \d+: expected meshes with triangles below it, found none/);
  const flat = box("flat", [1, 1, 1], [0, 0, 0]);
  flat.scale.y = 0;
  refuses(() => world.addMoving(flat), /flat: expected a scale other than 0/);
  refuses(() => world.addHand(new THREE.Group()), /expected a hand, renderer\.xr\.getHand\(0\)/);
  refuses(() => world.update(undefined), /expected milliseconds/);
  await assert.rejects(world.addBody(worm(5), { shown: worm(4) }), /worm: expected a copy with the bones of worm/);
  const broken = box("broken", [1, 1, 1], [0, 0, 0]);
  broken.geometry.index.array[0] = 99;
  refuses(() => world.addMoving(broken), /broken: its index names vertex 99, and it has 24 of them/);
  const nan = box("nan", [1, 1, 1], [Number.NaN, 0, 0]);
  refuses(() => worldOf(nan).update(0), /nan: its vertex 0 is at no place/);

  // A skeleton that changes: it is reported, that body stops, all others go on.
  const body = await world.addBody(skinned), space = handSpace(), hand = world.addHand(space);
  let now = frames(world, 5, () => lead(space, [1, 0, 0]), 1000);
  assert.ok(body.member.body >= 0 && hand.state === "equal");
  skinned.skeleton.bones.pop();
  now = frames(world, 5, undefined, now);
  assert.ok(told().has("worm: The Skeleton of worm has changed: it has 4 bones, and had 5; remove the body and add it anew"));
  assert.ok(body.member.body < 0 && hand.state === "equal");
  const prop = box("prop", [0.1, 0.1, 0.1], [2, 0, 0], room);
  world.addMoving(prop);
  now = frames(world, 3, undefined, now);
  prop.scale.y = 2;
  now = frames(world, 3, undefined, now);
  assert.ok(told().has("prop: prop: its scale has changed; expected the one that it was added with: remove it and add it anew"));
  assert.equal(hand.state, "equal");
});

test("who is told may remove what it touches, and itself", () => {
  const room = new THREE.Scene(), space = handSpace(), other = handSpace(), door = box("door", [0.02, 2, 2], [0.5, 0, 0], room);
  const world = worldOf(room), moving = world.addMoving(door), hand = world.addHand(space), gone = world.addHand(other), told = [];
  let now = frames(world, 5, () => [space, other].forEach((one, i) => lead(one, [0, i, 0])));
  gone.addEventListener("enter", () => world.remove(gone));
  now = frames(world, 20, () => lead(other, [1, 1, 0]), now);
  assert.ok(gone.member.body < 0 && hand.state === "equal");
  hand.addEventListener("enter", ({ object }) => (told.push(object), world.remove(moving)));
  hand.addEventListener("leave", ({ cause }) => told.push(cause));
  now = frames(world, 72, () => lead(space, [1, 0, 0]), now);
  assert.ok(told.includes(door) && told.at(-1) === "gap", "the touch ends with what is touched");
  assert.ok(hand.state === "equal" && hand.shown.joints.wrist.position.x > 0.99);
});
