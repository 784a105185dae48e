// A hand of WebXR in three.js, without a page: it meets a board, a drawer and a platform, hears of it,
// and passes through nothing.

import assert from "node:assert/strict";
import { test } from "node:test";
import * as THREE from "three";
import { TouchHelper, TouchWorld } from "../index.js";
import { box, frames, ft, handSpace, lead, tickMs } from "./things.mjs";

const heard = (toucher) => {
  const all = [];
  for (const type of ["enter", "leave", "starts_inside"]) toucher.addEventListener(type, (event) => all.push(event));
  return all;
};

test("led through a board of 4 mm in one frame, it stays before it, and both are told", () => {
  const room = new THREE.Scene(), board = box("board", [0.004, 2, 2], [0.5, 0, 0], room), space = handSpace();
  const world = new TouchWorld(ft, room), hand = world.addHand(space), told = heard(hand), toldByWorld = heard(world);
  room.add(hand.shown);
  assert.equal(hand.state, null);
  let now = frames(world, 10, () => lead(space, [0, 0, 0]));
  assert.equal(hand.state, "equal");
  assert.ok(hand.shown.visible);
  now = frames(world, 1, () => lead(space, [1, 0, 0]), now);
  now = frames(world, 60, undefined, now);
  assert.equal(hand.state, "held");
  assert.ok(hand.tick.tick.isCertified);
  for (const { position, jointRadius } of Object.values(hand.shown.joints)) assert.ok(position.x + jointRadius < 0.498, `a joint at ${position.x}`);
  assert.ok(hand.presses.length > 0 && hand.presses.every(({ object, push, normal }) => object === board && push > 0 && normal.x < -0.99));
  assert.ok(hand.presses.reduce((sum, { push }) => sum + push, 0) > 0.1);
  assert.ok(told.length > 0 && told.every(({ type, object }) => type === "enter" && object === board));
  assert.equal(toldByWorld.length, told.length);
  assert.ok(told[0].point instanceof THREE.Vector3 && Math.abs(told[0].point.x - 0.498) < 5e-3 && told[0].normal.x < -0.99);
  assert.ok(told[0].time > 1e-3 * 10 * tickMs && told[0].time < 1e-3 * now);
  now = frames(world, 60, () => lead(space, [0, 0, 0]), now);
  assert.equal(hand.state, "equal");
  assert.equal(told.filter(({ type }) => type === "leave").length, told.filter(({ type }) => type === "enter").length);
  assert.deepEqual(new Set(told.filter(({ type }) => type === "leave").map(({ cause }) => cause)), new Set(["apart"]));
});

test("a press that trembles, as trackers do, is held; one that is led along slides", () => {
  const room = new THREE.Scene(), space = handSpace();
  box("table", [2, 0.1, 2], [0, 0, 0], room);
  const world = new TouchWorld(ft, room), hand = world.addHand(space);
  let seed = 1;
  const noise = () => ((seed = (seed * 16807) % 2147483647) / 2147483647 - 0.5) * 2e-4;
  let now = frames(world, 40, (i) => lead(space, [0, 0.3 - 0.01 * i, 0]));
  now = frames(world, 40, () => lead(space, [noise(), -0.1 + noise(), noise()]), now);
  const states = [];
  now = frames(world, 40, () => (lead(space, [noise(), -0.1 + noise(), noise()]), states.push(hand.state)), now);
  assert.deepEqual(new Set(states), new Set(["held"]));
  now = frames(world, 10, (i) => lead(space, [0.01 * i, -0.1, 0]), now);
  assert.equal(hand.state, "sliding");
});

test("a drawer that is part of the room pushes it, and a platform lifts it", () => {
  const room = new THREE.Scene(), drawer = new THREE.Group(), platform = new THREE.Group(), space = handSpace();
  drawer.name = "drawer";
  box("front", [0.4, 0.3, 0.02], [0, 0, 0], drawer);
  box("floor", [8, 0.1, 8], [0, -2, 0], room);
  room.add(drawer, platform);
  box("plate", [1, 0.02, 1], [0, 0, 0], platform);
  drawer.position.z = -0.5;
  platform.position.y = -0.4;
  const world = new TouchWorld(ft, room);
  world.addMoving(drawer);
  world.addMoving(platform);
  const hand = world.addHand(space), told = heard(hand);
  // Into the hand, whose foremost tip is at z = -0.12: 60 cm in a second.
  let now = frames(world, 72, (i) => {
    lead(space, [0, 0, 0]);
    drawer.position.z = -0.5 + (0.6 * i) / 72;
  });
  assert.equal(told[0].object.name, "front");
  const foremost = Math.min(...Object.values(hand.shown.joints).map(({ position }) => position.z));
  assert.ok(foremost > 0.1 + 0.01 + 0.006, `the tip is at ${foremost}`);
  assert.ok(hand.presses.some(({ object }) => object.name === "front"));
  drawer.position.z = -5;
  world.restart();
  now = frames(world, 20, undefined, now);
  now = frames(world, 72, (i) => (platform.position.y = -0.4 + (0.7 * i) / 72), now);
  const lowest = Math.min(...Object.values(hand.shown.joints).map(({ position, jointRadius }) => position.y - jointRadius));
  assert.ok(lowest >= 0.3 + 0.01 - 1e-6, `a joint is at ${lowest}`);
  assert.ok(told.some(({ type, object }) => type === "enter" && object.name === "plate"));
});

test("what is taken into the hand is solid with it", () => {
  const room = new THREE.Scene(), cup = box("cup", [0.04, 0.04, 0.04], [0, 0, -0.2]), space = handSpace();
  box("board", [0.004, 2, 2], [0.5, 0, 0], room);
  room.add(cup);
  const world = new TouchWorld(ft, room), moving = world.addMoving(cup), hand = world.addHand(space);
  let now = frames(world, 5, () => lead(space, [0, 0, 0]));
  world.hold(moving, hand, "wrist");
  now = frames(world, 60, (i) => lead(space, [0.02 * i, 0, 0]), now);
  assert.ok(Math.abs(cup.position.z + 0.2) < 0.05 && cup.position.x > 0.3, `the cup is at ${cup.position.toArray()}`);
  assert.ok(cup.position.x + 0.02 < 0.498);
  assert.ok(hand.tick.tools.length === 1);
  world.letGo(moving);
  now = frames(world, 10, (i) => lead(space, [0.4 - 0.02 * i, 0, 0]), now);
  assert.equal(hand.tick.tools.length, 0);
});

test("away for a minute is a gap: no wall is swept through, and what was touched is told to end", () => {
  const room = new THREE.Scene(), door = box("door", [0.02, 2, 1], [1, 0, 0], room), space = handSpace();
  box("board", [0.004, 2, 2], [0.5, 0, 0], room);
  const world = new TouchWorld(ft, room), hand = world.addHand(space), told = heard(hand);
  world.addMoving(door);
  let now = frames(world, 5, () => lead(space, [0, 0, 0]));
  now = frames(world, 40, () => lead(space, [0.6, 0, 0]), now);
  const before = told.length, open = told.reduce((count, { type }) => count + (type === "enter" ? 1 : -1), 0);
  assert.ok(open > 0);
  // Meanwhile the door has gone through where the hand was, and the person has walked around the board.
  door.position.x = -1;
  now = frames(world, 3, () => lead(space, [1, 0, 0]), now + 60_000);
  assert.deepEqual(told.slice(before).map(({ type, cause }) => `${type} ${cause}`), Array(open).fill("leave gap"));
  assert.equal(hand.state, "equal");
  assert.ok(hand.shown.joints.wrist.position.x > 0.99);
});

test("a frame that takes a second lets no hand through: it goes on from where it is shown", () => {
  const room = new THREE.Scene(), space = handSpace();
  box("case", [0.6, 2, 2], [0.8, 0, 0], room);
  const world = new TouchWorld(ft, room), hand = world.addHand(space), foremost = () => Math.max(...Object.values(hand.shown.joints).map(({ position, jointRadius }) => position.x + jointRadius));
  let now = frames(world, 5, () => lead(space, [0, 0, 0]));
  now = frames(world, 20, () => lead(space, [0.8, 0, 0]), now);
  assert.ok(foremost() < 0.5);
  now = frames(world, 5, undefined, now + 1000);
  assert.ok(foremost() < 0.5 && foremost() > 0.4, `${foremost()}`);
  assert.ok(hand.state === "held" || hand.state === "sliding", hand.state);
  world.restart();
  now = frames(world, 3, undefined, now);
  assert.equal(hand.state, "equal");
});

test("a hand that is lost stays, and one above which the rig moves or is scaled follows", () => {
  const room = new THREE.Scene(), rig = new THREE.Group(), space = handSpace();
  box("floor", [8, 0.1, 8], [0, -4, 0], room);
  rig.add(space);
  rig.scale.setScalar(2);
  const world = new TouchWorld(ft, room), hand = world.addHand(space);
  let now = frames(world, 5, () => lead(space, [0, 0, 0]));
  rig.position.y = 1;
  now = frames(world, 1, undefined, now);
  assert.equal(hand.shown.joints.wrist.position.y, 1);
  assert.ok(Math.abs(hand.member.links[0].lss[0].radius - 0.022) < 1e-9, "twice as large");
  space.visible = false;
  now = frames(world, 2, () => lead(space, [0, 2, 0]), now);
  assert.equal(hand.shown.joints.wrist.position.y, 1);
  assert.ok(hand.tick.tick.joints.every(({ state }) => state === "lost"));
});

test("the helper draws its capsules and where it is pressed", () => {
  const room = new THREE.Scene(), space = handSpace();
  box("board", [0.004, 2, 2], [0.5, 0, 0], room);
  const world = new TouchWorld(ft, room), hand = world.addHand(space), helper = new TouchHelper(hand);
  helper.update();
  assert.equal(helper.visible, false);
  let now = frames(world, 5, () => lead(space, [0, 0, 0]));
  frames(world, 60, () => lead(space, [1, 0, 0]), now);
  helper.update();
  const [capsules, arrows] = helper.children.map(({ geometry }) => geometry.attributes.position);
  assert.ok(capsules.count > 25 * 24);
  for (let i = 0; i < capsules.count; ++i) assert.ok(capsules.getX(i) < 0.498);
  assert.equal(arrows.count, 2 * hand.presses.length);
});
