// Hands led at a board of 4 mm, ours beside Rapier's and Havok's, and what two hands cost in a furnished room.
//   node bindings/wasm/tests/hands.mjs [--paths N] [--seconds S] [--json FILE]
// Ends with 1 where one of ours touches the board on its way.

import { readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { parseArgs } from "node:util";
import HavokPhysics from "@babylonjs/havok";
import RAPIER from "@dimforge/rapier3d-compat";
import { Foretouch } from "../foretouch.js";
import { bonesAt, handLinks, handPose, axisTurn, seeded } from "./hand.mjs";
import { example, parseObj } from "./native.mjs";

const { values: asked } = parseArgs({ options: { paths: { type: "string", default: "10000" }, seconds: { type: "string", default: "60" }, json: { type: "string" } } });
const paths = Number(asked.paths), seconds = Number(asked.seconds);
const rate = 72, thickness = 0.004, halfWidth = 3, instants = 20;
const links = handLinks();
const ft = await Foretouch.load(readFileSync(new URL("../foretouch.wasm", import.meta.url)));
const avatar = ft.avatar(links);

/** Front at x = 0, back at x = 4 mm. */
function board() {
  const positions = [];
  for (const x of [0, thickness]) for (const y of [-halfWidth, halfWidth]) for (const z of [-halfWidth, halfWidth]) positions.push(x, y, z);
  return { positions, indices: [0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1, 2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3] };
}

/** A hand's way at up to 10 m/s, from before the board to behind it, where it stays for ten ticks. */
function path(random) {
  const axis = [random() - 0.5, random() - 0.5, random() - 0.5], length = Math.hypot(...axis);
  const unit = axis.map((value) => value / length);
  const speed = 0.5 + 9.5 * random(), beyond = 0.05 + random(), sideways = 2 * (random() - 0.5);
  const first = 6 * random(), spin = 8 * (random() - 0.5), bend = 0.7 * random(), grip = 2 * (random() - 0.5);
  const poses = [];
  for (let tick = 0, rest = 0; rest < 10; ++tick) {
    const time = tick / rate, x = Math.min(beyond, -0.35 + speed * time);
    if (x === beyond) ++rest;
    const place = [x, 0.3 * sideways * time, 0.2 * Math.sin(3 * time + first)];
    poses.push(handPose(links, place, axisTurn(unit, first + spin * time), Math.min(0.9, Math.max(0, bend + grip * time))));
  }
  return poses;
}

/** How far the foremost bone is from the board's front; below 0: in it, or behind it. */
function gapAt(from, to, u) {
  return Math.min(...bonesAt(links, from, to, u).map(({ a, b, radius }) => -Math.max(a[0], b[0]) - radius));
}

function ours(tracked, scene) {
  const solid = ft.solid(scene, avatar, { liftsFeet: false });
  let before = null, least = Infinity;
  for (const pose of tracked) {
    const tick = solid.follow(pose, 1 / rate);
    for (let piece = 0; piece < tick.wayCount; ++piece) {
      const next = solid.way(piece).pose;
      for (let i = 1; i <= instants; ++i) least = Math.min(least, gapAt(before ?? next, next, i / instants));
      before = next;
    }
    if (!tick.isCertified) least = Math.min(least, -1);
  }
  solid.dispose();
  return least;
}

/** The bones of a straight hand: what the fingers bend is left out. */
const straight = (() => {
  const pose = handPose(links, [0, 0, 0], [1, 0, 0, 0], 0);
  return bonesAt(links, pose, pose, 0);
})();

/** Whether most of Rapier's hand, one body of 25 capsules, is behind the board in the end. */
function rapiers(tracked, isKinematic) {
  const world = new RAPIER.World({ x: 0, y: 0, z: 0 });
  world.timestep = 1 / rate;
  world.createCollider(RAPIER.ColliderDesc.cuboid(thickness / 2, halfWidth, halfWidth).setTranslation(thickness / 2, 0, 0));
  const kind = isKinematic ? RAPIER.RigidBodyDesc.kinematicPositionBased() : RAPIER.RigidBodyDesc.dynamic();
  const [w, x, y, z] = tracked[0].rotations;
  const [px, py, pz] = tracked[0].translations;
  const body = world.createRigidBody(kind.setCcdEnabled(true).setTranslation(px, py, pz).setRotation({ w, x, y, z }));
  for (const { a, b, radius } of straight) {
    const half = Math.hypot(...a.map((value, i) => value - b[i])) / 2, middle = a.map((value, i) => (value + b[i]) / 2);
    // Along -z, as straight bones are.
    world.createCollider(RAPIER.ColliderDesc.capsule(half, radius).setTranslation(...middle).setRotation({ w: Math.SQRT1_2, x: Math.SQRT1_2, y: 0, z: 0 }), body);
  }
  for (const { rotations, translations } of tracked) {
    const [tw, tx, ty, tz] = rotations, [cx, cy, cz] = translations;
    if (isKinematic) {
      body.setNextKinematicTranslation({ x: cx, y: cy, z: cz });
      body.setNextKinematicRotation({ w: tw, x: tx, y: ty, z: tz });
    } else {
      const at = body.translation();
      body.setLinvel({ x: (cx - at.x) * rate, y: (cy - at.y) * rate, z: (cz - at.z) * rate }, true);
      body.setAngvel({ x: 0, y: 0, z: 0 }, true);
      body.setRotation({ w: tw, x: tx, y: ty, z: tz }, true);
    }
    world.step();
  }
  const isBehind = body.translation().x > thickness;
  world.free();
  return isBehind;
}

/** The same of Havok's: kinematic, led by targets; or driven by velocities, as fast as they are. */
function havoks(HK, tracked, isKinematic) {
  const made = ([, thing]) => thing, none = [0, 0, 0, 1];
  const world = made(HK.HP_World_Create()), board = made(HK.HP_Body_Create()), hand = made(HK.HP_Body_Create()), shapes = made(HK.HP_Shape_CreateContainer());
  HK.HP_World_SetGravity(world, [0, 0, 0]);
  HK.HP_World_SetIdealStepTime(world, 1 / rate);
  HK.HP_World_SetSpeedLimit(world, 100, 100);
  const box = made(HK.HP_Shape_CreateBox([0, 0, 0], none, [thickness, 2 * halfWidth, 2 * halfWidth]));
  HK.HP_Body_SetShape(board, box);
  HK.HP_Body_SetMotionType(board, HK.MotionType.STATIC);
  HK.HP_Body_SetQTransform(board, [[thickness / 2, 0, 0], none]);
  for (const { a, b, radius } of straight) {
    const capsule = made(HK.HP_Shape_CreateCapsule(a, b, radius));
    HK.HP_Shape_AddChild(shapes, capsule, [[0, 0, 0], none, [1, 1, 1]]);
    HK.HP_Shape_Release(capsule);
  }
  const place = ({ rotations: [w, x, y, z], translations: [px, py, pz] }) => [[px, py, pz], [x, y, z, w]];
  HK.HP_Body_SetShape(hand, shapes);
  HK.HP_Body_SetMotionType(hand, isKinematic ? HK.MotionType.KINEMATIC : HK.MotionType.DYNAMIC);
  HK.HP_Body_SetMassProperties(hand, made(HK.HP_Shape_BuildMassProperties(shapes)));
  HK.HP_Body_SetQTransform(hand, place(tracked[0]));
  for (const body of [board, hand]) HK.HP_World_AddBody(world, body, false);
  for (const pose of tracked) {
    const [at, turn] = place(pose);
    if (isKinematic) HK.HP_Body_SetTargetQTransform(hand, [at, turn]);
    else {
      const from = made(HK.HP_Body_GetPosition(hand));
      HK.HP_Body_SetOrientation(hand, turn);
      HK.HP_Body_SetAngularVelocity(hand, [0, 0, 0]);
      HK.HP_Body_SetLinearVelocity(hand, at.map((value, i) => (value - from[i]) * rate));
    }
    HK.HP_World_Step(world, 1 / rate);
  }
  const isBehind = made(HK.HP_Body_GetPosition(hand))[0] > thickness;
  for (const body of [board, hand]) HK.HP_Body_Release(body);
  for (const shape of [box, shapes]) HK.HP_Shape_Release(shape);
  HK.HP_World_Release(world);
  return isBehind;
}

/** Shares of a sorted list. */
const at = (sorted, share) => sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))];

function summary(times) {
  const sorted = Float64Array.from(times).sort();
  return { mean_us: times.reduce((sum, time) => sum + time, 0) / times.length, p50_us: at(sorted, 0.5), p99_us: at(sorted, 0.99), longest_us: at(sorted, 1) };
}

/** Two hands at 72 Hz that wander through the furniture, up to 2 m/s: asked what they meet first, and led solid. */
function room(scene) {
  const query = ft.query(scene, avatar);
  const hands = [0, 1].map((side) => ({ solid: ft.solid(scene, avatar, { liftsFeet: false }), phase: 3 * side, before: null }));
  const steps = [], ticks = [];
  let touched = 0, held = 0;
  for (let tick = 0; tick < seconds * rate; ++tick) {
    const time = tick / rate;
    const targets = hands.map(({ phase }) => handPose(links, [1.6 * Math.sin(0.61 * time + phase), 1.1 + 0.35 * Math.sin(1.3 * time + phase), 1.4 * Math.cos(0.53 * time + 2 * phase)], axisTurn([0, 1, 0], time + phase), 0.3 + 0.3 * Math.sin(2 * time)));
    const begin = performance.now();
    const met = hands.map(({ before }, hand) => query.step(before ?? targets[hand], targets[hand]));
    const between = performance.now();
    const shown = hands.map(({ solid }, hand) => solid.follow(targets[hand], 1 / rate));
    const end = performance.now();
    hands.forEach((hand, index) => (hand.before = targets[index]));
    if (tick < rate) continue; // the engine still compiles the module
    steps.push(1e3 * (between - begin));
    ticks.push(1e3 * (end - between));
    if (met.flat().some(({ verdict }) => verdict !== "clear")) ++touched;
    if (shown.some(({ contacts }) => contacts.length > 0)) ++held;
  }
  const share = (count) => Math.round((100 * count) / ticks.length);
  return [
    { asked: "what they meet first", frames: steps.length, contact_percent: share(touched), ...summary(steps) },
    { asked: "solid", frames: ticks.length, contact_percent: share(held), ...summary(ticks) },
  ];
}

const furnished = ft.scene(parseObj(example("room.obj"))); // before the long part: it may be missing
await RAPIER.init();
const HK = await HavokPhysics({ wasmBinary: readFileSync(createRequire(import.meta.url).resolve("@babylonjs/havok/lib/esm/HavokPhysics.wasm")) });
const random = seeded(1), scene = ft.scene(board());
const count = { paths: 0, touching: 0, gap_mm: Infinity, unseen: 0, kinematic: 0, dynamic: 0, havok_kinematic: 0, havok_dynamic: 0 };
for (let i = 0; i < paths; ++i) {
  const tracked = path(random);
  const least = ours(tracked, scene);
  ++count.paths;
  if (!(least > 0)) ++count.touching;
  count.gap_mm = Math.min(count.gap_mm, 1e3 * least);
  // A check of the poses alone: does any bone meet the board's 4 mm at any of them?
  const isSeen = tracked.some((pose) => bonesAt(links, pose, pose, 0).some(({ a, b, radius }) => Math.max(a[0], b[0]) + radius > 0 && Math.min(a[0], b[0]) - radius < thickness));
  if (!isSeen) ++count.unseen;
  if (rapiers(tracked, true)) ++count.kinematic;
  if (rapiers(tracked, false)) ++count.dynamic;
  if (havoks(HK, tracked, true)) ++count.havok_kinematic;
  if (havoks(HK, tracked, false)) ++count.havok_dynamic;
}
const hands = room(furnished);
const table = (name, title, columns, rows) => ({ name, title, command: "./run npm --hands", date: new Date().toISOString().slice(0, 10), columns: Object.entries(columns).map(([key, title]) => ({ key, title })), rows });
const tables = [
  table("board", `Hands of 25 joints led at a board of ${1e3 * thickness} mm at up to 10 m/s, ${rate} Hz`, {
    paths: "paths", touching: "ours that touch it", gap_mm: "ours: least gap, mm", unseen: "that no check of the poses sees", kinematic: "Rapier's kinematic hand, behind it", dynamic: "Rapier's driven hand with CCD, behind it",
    havok_kinematic: "Havok's kinematic hand, behind it", havok_dynamic: "Havok's driven hand, behind it",
  }, [count]),
  table("room", `Two such hands at ${rate} Hz in a room of 105,914 triangles, both per frame`, {
    asked: "asked", frames: "frames", contact_percent: "in contact, %", mean_us: "mean, us", p50_us: "median", p99_us: "99 in 100", longest_us: "longest",
  }, hands),
];
for (const { title, columns, rows } of tables) {
  console.log(title);
  console.table(rows.map((row) => Object.fromEntries(columns.map(({ key, title }) => [title, row[key]]))));
}
if (asked.json !== undefined) {
  const machine = { description: `node ${process.version}, what other work left of a shared cloud machine (x86-64)` };
  writeFileSync(asked.json, `${JSON.stringify({ format: "foretouch-figures", version: 1, title: "Hands in JavaScript", machine, tables }, null, 1)}\n`);
}
process.exitCode = count.touching > 0 ? 1 : 0;
