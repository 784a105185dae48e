// Every answer beside those of the package's own calls, bit for bit: the bundled clip by a Skeleton of
// three.js, a solid hand by the library called by itself, and the same in a worker.
//   FORETOUCH_EXAMPLES  the folder of the bundled examples

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import * as THREE from "three";
import { FarEngine, framesOf, localPose, poseRoom, readRig, rigOf, serve } from "foretouch/host";
import { TouchWorld, three } from "../index.js";
import { box, ft, handSpace, lead, module, tickMs } from "./things.mjs";

const folder = process.env.FORETOUCH_EXAMPLES ?? "";
const skip = folder === "" ? "there is no folder of examples (FORETOUCH_EXAMPLES)" : false;
const example = (name) => readFileSync(join(folder, name), "utf8");

test("the bundled dancer as bones: the clip's poses come back, and every link-step has the same bits", { skip }, () => {
  const { OBJ } = objOf(example("room.obj")), avatar = ft.avatar(example("dancer.avatar.json")), clip = ft.clip(example("dancer.bvh"), { avatar });
  const bones = avatar.links.map(({ name }) => Object.assign(new THREE.Bone(), { name })), root = new THREE.Group();
  avatar.links.forEach(({ offset }, i) => {
    bones[i].position.set(...offset);
    (avatar.parents[i] < 0 ? root : bones[avatar.parents[i]]).add(bones[i]);
  });
  root.updateMatrixWorld(true);
  const rig = rigOf(bones.map((bone, i) => ({ name: bone.name, parent: avatar.parents[i], matrix: bone.matrixWorld.elements })), 1);
  assert.deepEqual(rig.links.map(({ name }) => name), avatar.links.map(({ name }) => name));
  const scene = ft.scene(OBJ), query = ft.query(scene, avatar), bare = ft.query(scene, avatar), frames = framesOf(bones.length);
  let before = null, linkSteps = 0, contacts = 0, off = 0, otherwise = 0;
  for (let frame = 0; frame < clip.frames; ++frame) {
    const { rotations, translations } = clip.pose(frame);
    bones.forEach((bone, i) => {
      bone.quaternion.set(rotations[4 * i + 1], rotations[4 * i + 2], rotations[4 * i + 3], rotations[4 * i]);
      bone.position.fromArray(translations, 3 * i);
    });
    root.updateMatrixWorld(true);
    const read = localPose(rig.parents, readRig(rig, bones.map(({ matrixWorld }) => matrixWorld.elements), frames), poseRoom(bones.length));
    for (let i = 0; i < translations.length; ++i) off = Math.max(off, Math.abs(translations[i] - read.translations[i]));
    for (let i = 0; i < rotations.length; i += 4) off = Math.max(off, 1 - Math.abs([0, 1, 2, 3].reduce((sum, k) => sum + rotations[i + k] * read.rotations[i + k], 0)));
    if (before !== null) {
      const ours = query.step(before.read, read), theirs = bare.step(before.read, { rotations: Array.from(read.rotations), translations: Array.from(read.translations) });
      assert.deepEqual(ours, theirs);
      linkSteps += ours.length;
      contacts += ours.filter(({ verdict }) => verdict !== "clear").length;
      // The clip's own poses, which differ by roundings of a matrix: nearly touching may be touching.
      bare.step(before.clip, { rotations, translations }).forEach(({ verdict }, link) => (otherwise += verdict === ours[link].verdict ? 0 : 1));
    }
    before = { read, clip: { rotations, translations } };
  }
  assert.ok(off < 1e-12, `off by ${off}`);
  assert.equal(otherwise, 0);
  assert.ok(linkSteps > 20_000 && contacts > 500, `${linkSteps} link-steps, ${contacts} not clear`);
  console.log(`${linkSteps} link-steps, ${contacts} not clear: the same bits; poses within ${off.toExponential(1)}`);
});

/** The bundled scene as a mesh of three.js, and as the library's arrays. */
function objOf(text) {
  const positions = [], indices = [];
  for (const line of text.split("\n")) {
    const [word, ...rest] = line.trim().split(/\s+/);
    if (word === "v") positions.push(...rest.map((number) => Math.fround(Number(number))));
    if (word !== "f") continue;
    const corners = rest.map((corner) => Number.parseInt(corner, 10) - 1);
    for (let i = 2; i < corners.length; ++i) indices.push(corners[0], corners[i - 1], corners[i]);
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(positions, 3));
  geometry.setIndex(indices);
  return { OBJ: { positions, indices }, mesh: new THREE.Mesh(geometry) };
}

/** A hand that wanders through a room and a swinging door; what is shown and reported at each tick, by `update`. */
function wander(world, hand, space, door, count, each) {
  const turn = new THREE.Euler();
  for (let i = 1; i <= count; ++i) {
    const s = i / 72;
    lead(space, [0.9 * Math.sin(1.1 * s), 0.3 * Math.sin(2 * s), 0.5 * Math.cos(s)], turn.set(s, 0.5 * s, 0));
    door.rotation.y = Math.sin(2 * s);
    each(i * tickMs);
  }
}

function setting() {
  const room = new THREE.Scene(), door = new THREE.Group(), space = handSpace();
  box("board", [0.004, 2, 2], [0.5, 0, 0], room);
  box("panel", [0.8, 2, 0.03], [0.4, 0, 0], door);
  door.position.set(-0.6, 0, -0.4);
  room.add(door);
  return { room, door, space };
}

test("a hand, a door and a board: every shown pose and event as the package's own world has them", () => {
  const { room, door, space } = setting(), world = new TouchWorld(ft, room), told = [];
  world.addMoving(door);
  const hand = world.addHand(space);
  for (const type of ["enter", "leave"]) world.addEventListener(type, ({ time, point, link }) => told.push([type, time, ...point.toArray(), link]));
  const run = [];
  wander(world, hand, space, door, 400, (ms) => {
    world.update(ms);
    run.push({ ms, tracked: structuredClone(hand.member.pose), shown: hand.tick?.tick.shown ?? null, door: door.matrixWorld.clone() });
  });
  // By hand, with nothing of foretouch/host but what says where things are.
  const still = three.meshesOf(room, () => undefined, (object) => object === door)[0], panel = door.children[0];
  const placed = (mesh, matrix) => Array.from({ length: mesh.geometry.attributes.position.count }, (_, i) => new THREE.Vector3().fromBufferAttribute(mesh.geometry.attributes.position, i).applyMatrix4(matrix).toArray()).flat();
  const bare = ft.solidWorld(ft.scene({ positions: placed(still.object, still.object.matrixWorld), indices: still.indices }), Math.round(1e3 * run[0].ms) - 2000);
  const body = bare.world.add(ft.scene({ positions: placed(panel, panel.matrix), indices: panel.geometry.index.array })), user = bare.add(ft.avatar(hand.member.links), { liftsFeet: false }), events = [];
  run.forEach(({ ms, tracked, shown, door }, i) => {
    const turn = new THREE.Quaternion(), place = new THREE.Vector3(), us = Math.round(1e3 * ms);
    door.decompose(place, turn, new THREE.Vector3());
    for (const at of i === 0 ? [us - 2000, us - 1000, us] : [us]) bare.world.push(body, at, { rotations: [turn.w, turn.x, turn.y, turn.z], translations: place.toArray() });
    if (i === 0) bare.tick(us - 1000, [{ body: user, pose: tracked }]);
    const [{ tick }] = bare.tick(us, [{ body: user, pose: tracked }]);
    for (const { kind, timeUs, timeFraction, a, b } of bare.follow().events) {
      const [own] = [a, b].filter(({ body }) => body >= 0);
      if (kind === "enter" || kind === "leave") events.push([kind, 1e-6 * (timeUs + timeFraction), ...own.point, own.body === user ? hand.member.links[own.link].name : null]);
    }
    // The door's turn goes through a matrix here and there: its own roundings.
    tick.shown.translations.forEach((value, k) => assert.ok(Math.abs(value - shown.translations[k]) < 1e-6, `tick ${i}: ${value} beside ${shown.translations[k]}`));
  });
  assert.ok(told.length > 10);
  assert.deepEqual(told.map(([type, , , , , link]) => [type, link]), events.map(([type, , , , , link]) => [type, link]));
  told.forEach((event, i) => event.slice(1, 5).forEach((value, k) => assert.ok(Math.abs(value - events[i][k + 1]) < 1e-4)));
});

test("in a worker: the same bits, one frame after the other", async () => {
  const run = async (library) => {
    const { room, door, space } = setting(), world = new TouchWorld(library, room), all = [];
    world.addMoving(door);
    const hand = world.addHand(space), ticks = [];
    world.addEventListener("enter", ({ time, point }) => all.push(time, ...point.toArray()));
    wander(world, hand, space, door, 0, () => undefined);
    for (let i = 1; i <= 150; ++i) {
      lead(space, [0.9 * Math.sin(i / 20), 0, 0]);
      door.rotation.y = Math.sin(i / 40);
      await world.update(i * tickMs);
      ticks.push(Array.from(hand.tick?.tick.shown.translations ?? []));
    }
    return { all, ticks };
  };
  const { port1, port2 } = new MessageChannel();
  serve(port2);
  const far = await FarEngine.start(module, port1);
  assert.deepEqual(await run(far), await run(ft));
  await assert.rejects(far.tick({ timeUs: 1, moves: [], targets: [], holds: [] }), /ForetouchError: .*timeUs/);
  port1.close();
});

test("a worker that does not come is told, not waited for", async () => {
  const dead = { postMessage: () => queueMicrotask(() => dead.onerror({ message: "404" })), onmessage: null, onerror: null };
  await assert.rejects(FarEngine.start(module, dead), /expected a worker with Foretouch in it, but it stopped: 404/);
});
