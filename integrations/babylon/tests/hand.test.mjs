// Babylon.js without a page: left-handed and right-handed scenes, hands of WebXR, skeletons, and what is
// said of bad habits. What is not Babylon's own is tested by foretouch-three.

import assert from "node:assert/strict";
import { test } from "node:test";
import { Quaternion, Vector3 } from "@babylonjs/core/Maths/math.vector.js";
import { TransformNode } from "@babylonjs/core/Meshes/transformNode.js";
import { TouchViewer, TouchWorld, babylon } from "../index.js";
import { box, experience, frames, ft, sceneOf, worm } from "./things.mjs";

const heard = (toucher) => {
  const all = [];
  toucher.onEnterObservable.add((touch) => all.push(touch));
  toucher.onLeaveObservable.add((touch) => all.push(touch));
  return all;
};

for (const isRightHanded of [false, true]) {
  test(`a hand led through a board stays before it, ${isRightHanded ? "right" : "left"}-handed`, () => {
    const scene = sceneOf();
    scene.useRightHandedSystem = isRightHanded;
    // Before the hand, whose fingers point to the person's front: -z of WebXR, which Babylon has as +z.
    const front = isRightHanded ? -1 : 1, board = box(scene, "board", [2, 2, 0.004], [0, 0, front * 0.5]), xr = experience();
    const world = new TouchWorld(ft, scene), hand = world.addHand(xr, "right"), told = heard(hand), toldByWorld = heard(world), viewer = new TouchViewer(hand, scene);
    assert.equal(hand.state, null);
    let now = frames(world, 10, () => xr.lead([0, 0, 0]));
    assert.equal(hand.state, "equal");
    assert.ok(Math.abs(hand.joints["middle-finger-tip"].position.z - front * 0.12) < 1e-12);
    now = frames(world, 60, () => xr.lead([0, 0, -1]), now);
    assert.ok(["held", "sliding"].includes(hand.state), hand.state);
    for (const [name, { position }] of Object.entries(hand.joints)) assert.ok(front * position.z + hand.radii.get(name) < 0.498, `${name} at ${position.z}`);
    assert.ok(told.length > 0 && told.every(({ object }) => object === board) && toldByWorld.length === told.length);
    assert.ok(told[0].point instanceof Vector3 && Math.abs(told[0].point.z - front * 0.498) < 5e-3 && front * told[0].normal.z < -0.99);
    assert.ok(hand.presses.length > 0 && hand.presses.every(({ object, normal }) => object === board && front * normal.z < -0.9));
    viewer.update();
    const lines = scene.getMeshByName("Foretouch capsules").getVerticesData("position");
    assert.ok(lines.length > 1000 && lines.every((value, i) => i % 3 !== 2 || front * value < 0.498));
    viewer.update();
    viewer.dispose();
    now = frames(world, 60, () => xr.lead([0, 0, 0]), now);
    assert.equal(hand.state, "equal");
  });
}

test("a drawer pushes it, a platform that carries the camera carries it", () => {
  const scene = sceneOf(), xr = experience(), platform = new TransformNode("platform", scene), drawer = box(scene, "drawer", [0.4, 0.3, 0.02], [0, 0, 0.5]);
  box(scene, "plate", [1, 0.02, 1], [0, -0.5, 0], platform);
  xr.camera.parent = platform;
  const world = new TouchWorld(ft, scene, { still: null });
  world.addMoving(drawer);
  world.addMoving(platform);
  const hand = world.addHand(xr, "right"), told = heard(hand);
  let now = frames(world, 72, (i) => {
    xr.lead([0, 0, 0]);
    drawer.position.z = 0.5 - (0.6 * i) / 72;
  });
  assert.equal(told[0].object, drawer);
  assert.ok(Math.max(...Object.values(hand.joints).map(({ position }) => position.z)) < -0.1);
  drawer.position.z = 5;
  world.restart();
  now = frames(world, 100, (i) => (platform.position.y = 0.02 * i), now);
  assert.ok(Math.abs(hand.joints.wrist.position.y - 2) < 1e-6, `${hand.joints.wrist.position.y}`);
});

test("a worm's bones meet what they turn into; its shown copy stays before a wall", async () => {
  const scene = sceneOf(), tracked = worm(scene), post = box(scene, "post", [0.1, 0.1, 0.1], [0.3, 0.3, 0]), world = new TouchWorld(ft, scene), body = await world.addBody(tracked), told = heard(body);
  let now = frames(world, 3);
  const { links } = body.member, points = Array.from({ length: 8 }, (_, i) => tracked.getVerticesData("position").slice(30 * i, 30 * i + 3));
  assert.ok(links.every(({ lss }) => lss.length > 0));
  for (const point of points) {
    const out = links.flatMap(({ lss }, link) => lss.map(({ a, b, radius }) => {
      const local = point.map((value, i) => (i === 2 ? -1 : 1) * value - body.member.tracked.places[3 * link + i]), along = b.map((value, i) => value - a[i]);
      const t = Math.min(1, Math.max(0, local.reduce((sum, value, i) => sum + (value - a[i]) * along[i], 0) / (along.reduce((sum, value) => sum + value * value, 0) || 1)));
      return Math.hypot(...local.map((value, i) => value - a[i] - t * along[i])) - radius;
    }));
    assert.ok(Math.min(...out) < 1e-6, `a vertex is ${Math.min(...out)} outside`);
  }
  tracked.skeleton.bones[2].rotationQuaternion = Quaternion.RotationAxis(new Vector3(0, 0, 1), -Math.PI / 2 - 0.3);
  now = frames(world, 1, undefined, now);
  assert.ok(told.some(({ kind, object, link }) => kind === "enter" && object === post && link >= "bone2"), told.map(({ kind, link }) => `${kind} ${link}`).join());

  const room = sceneOf(), lead = worm(room, "lead"), shown = worm(room, "shown");
  box(room, "wall", [0.01, 4, 4], [0.5, 0, 0]);
  const solid = new TouchWorld(ft, room), follower = await solid.addBody(lead, { shown, liftsFeet: false });
  now = frames(solid, 5);
  assert.equal(follower.state, "equal");
  now = frames(solid, 100, (i) => (lead.position.x = 0.01 * i), now);
  for (const bone of shown.skeleton.bones) {
    bone.computeAbsoluteMatrices();
    assert.ok(bone.getAbsolutePosition(shown).x < 0.495 - 0.05, `${bone.name} at ${bone.getAbsolutePosition(shown)}`);
  }
});

test("a mirrored root, as loaders of glTF make one, keeps its skeleton's shape", async () => {
  const scene = sceneOf(), root = new TransformNode("__root__", scene), mesh = worm(scene), world = new TouchWorld(ft, scene, { still: null });
  root.scaling.set(1, 1, -1);
  root.rotationQuaternion = Quaternion.RotationAxis(new Vector3(0, 1, 0), Math.PI);
  mesh.parent = root;
  mesh.skeleton.bones[1].rotationQuaternion = Quaternion.RotationAxis(new Vector3(1, 0, 0), 0.4);
  const body = await world.addBody(root);
  let now = frames(world, 2);
  mesh.skeleton.bones[2].rotationQuaternion = Quaternion.RotationAxis(new Vector3(0.6, 0, 0.8), 0.9);
  now = frames(world, 2, undefined, now);
  const tip = body.member.tracked.places.slice(12, 15), bone = mesh.skeleton.bones[4];
  bone.computeAbsoluteMatrices();
  const there = bone.getAbsolutePosition(mesh);
  assert.ok(Math.hypot(tip[0] - there.x, tip[1] - there.y, tip[2] + there.z) < 1e-5, `${tip} beside ${there}`);
});

test("instances stand where they are drawn; what is off or skinned is left out", () => {
  const scene = sceneOf(), notes = [], source = box(scene, "source", [1, 1, 1], [0, 0, 0]), instance = source.createInstance("instance");
  instance.position.x = 5;
  box(scene, "off", [1, 1, 1], [0, 0, 0]).setEnabled(false);
  const skinned = worm(scene), meshes = babylon(false).meshesOf(scene, (words, of) => notes.push([words, of]), () => false);
  assert.deepEqual(meshes.map(({ name, matrix }) => [name, ...Array.from(matrix).slice(12, 15)]), [["source", 0, 0, 0], ["instance", 5, 0, 0]]);
  assert.deepEqual(notes, [["worm has a skeleton and is left out of what stands still: add it as a body, world.addBody(mesh)", skinned]]);
});

test("bad habits are told in Babylon's words", async () => {
  const scene = sceneOf(), notes = [], world = new TouchWorld(ft, scene, { note: (words) => notes.push(words) });
  box(scene, "floor", [4, 0.1, 4], [0, -2, 0]);
  const uneven = worm(scene, "uneven");
  uneven.skeleton.bones[1].scaling = new Vector3(1, 2, 1);
  await assert.rejects(world.addBody(uneven), /Bone bone1: its scale in the world is \(1\.00, 2\.00, 1\.00\); expected the same/);
  await assert.rejects(world.addBody(new TransformNode("nothing", scene)), /nothing: expected a mesh with a skeleton, found none/);
  assert.throws(() => world.addMoving(new TransformNode("hinge", scene)), /hinge: expected meshes with triangles below it, found none/);
  uneven.dispose();
  const mesh = worm(scene), body = await world.addBody(mesh), xr = experience(), hand = world.addHand(xr, "right");
  let now = frames(world, 4, () => xr.lead([1, 0, 0]));
  assert.ok(body.member.body >= 0);
  mesh.skeleton.bones.pop();
  now = frames(world, 4, undefined, now);
  assert.deepEqual(notes, ["The skeleton of worm has changed: it has 4 bones, and had 5; remove the body and add it anew"]);
  assert.equal(hand.state, "equal");
});

test("what is disposed of by whoever is told is told of, and in nobody's way", async () => {
  const scene = sceneOf(), notes = [], xr = experience(), door = box(scene, "door", [2, 2, 0.02], [0, 0, 0.5]), tracked = worm(scene);
  tracked.position.x = 5;
  const world = new TouchWorld(ft, scene, { note: (words) => notes.push(words) });
  world.addMoving(door);
  await world.addBody(tracked);
  const hand = world.addHand(xr, "right");
  hand.onEnterObservable.add(() => (door.dispose(), tracked.dispose()));
  let now = frames(world, 5, () => xr.lead([0, 0, 0]));
  now = frames(world, 72, () => xr.lead([0, 0, -1]), now);
  assert.deepEqual(notes, ["door was disposed of; remove it from the world, too", "worm was disposed of; remove it from the world, too"]);
  assert.equal(hand.state, "equal");
});
