// What a step costs: two hands of WebXR (50 joints) and a Skeleton of 2 in a room of 105,914 triangles; and
// what three.js' objects add to the package's own calls with the same poses.
//   node tests/cost.mjs [FRAMES]; FORETOUCH_EXAMPLES names the folder of the bundled examples
// Time of the processor, of all of node's threads: what other programs take of it is not in it. Judges nothing.

import { readFileSync } from "node:fs";
import { join } from "node:path";
import * as THREE from "three";
import { handJoints } from "foretouch/host";
import { TouchWorld } from "../index.js";
import { ft, handSpace, lead, worm, tickMs } from "./things.mjs";

const count = Number(process.argv[2] ?? 2000), warm = 300;

function room() {
  const positions = [], indices = [];
  for (const line of readFileSync(join(process.env.FORETOUCH_EXAMPLES, "room.obj"), "utf8").split("\n")) {
    const [word, ...rest] = line.trim().split(/\s+/);
    if (word === "v") positions.push(...rest.map(Number));
    if (word !== "f") continue;
    const corners = rest.map((corner) => Number.parseInt(corner, 10) - 1);
    for (let i = 2; i < corners.length; ++i) indices.push(corners[0], corners[i - 1], corners[i]);
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(positions, 3));
  geometry.setIndex(indices);
  return new THREE.Mesh(geometry);
}

function summary(name, times) {
  const sorted = Float64Array.from(times).sort(), at = (share) => sorted[Math.floor(share * (sorted.length - 1))].toFixed(1);
  return { "": name, "median, us": at(0.5), "mean, us": (times.reduce((sum, time) => sum + time, 0) / times.length).toFixed(1), "99 in 100": at(0.99) };
}

const still = room(), spaces = [handSpace(), handSpace()], mesh = worm(2), world = new TouchWorld(ft, still);
mesh.position.set(0, 1.2, 0.4);
const hands = spaces.map((space) => world.addHand(space));
const body = await world.addBody(mesh);
const tracked = (i) => spaces.forEach((space, side) => {
  const s = i / 72, phase = 3 * side;
  lead(space, [1.6 * Math.sin(0.61 * s + phase), 1.1 + 0.35 * Math.sin(1.3 * s + phase), 1.4 * Math.cos(0.53 * s + 2 * phase)], new THREE.Euler(0, s + phase, 0));
});
// The same by the package alone with the same poses, in turns, and now one first and now the other.
const scene = ft.scene({ positions: still.geometry.attributes.position.array, indices: still.geometry.index.array });
const ours = [], bare = [], border = [], queried = [];
const timed = (call) => {
  const begin = process.cpuUsage();
  call();
  const { user, system } = process.cpuUsage(begin);
  return user + system;
};
tracked(1);
world.update(tickMs);
const members = [...hands, body].map(({ member }) => member), own = ft.solidWorld(scene, Math.round(1e3 * tickMs) - 1000);
const users = hands.map(({ member }) => own.add(ft.avatar(member.links), { liftsFeet: false })), other = own.world.add(ft.avatar(body.member.links));
const queries = hands.map(({ member }) => ft.query(scene, ft.avatar(member.links)));
for (const us of [Math.round(1e3 * tickMs) - 1000, Math.round(1e3 * tickMs)]) own.world.push(other, us, body.member.pose);
own.tick(Math.round(1e3 * tickMs), users.map((user, side) => ({ body: user, pose: hands[side].member.pose })));
own.follow();
let lastUs = Math.round(1e3 * tickMs), poses = members.map(({ pose }) => structuredClone(pose));
for (let i = 2; i <= count; ++i) {
  const us = Math.round(1e3 * i * tickMs), before = poses;
  const byThree = () => timed(() => world.update(i * tickMs));
  const byPackage = () => timed(() => {
    own.world.push(other, us, poses[2]);
    own.tick(us, users.map((user, side) => ({ body: user, pose: poses[side] })));
    own.follow();
    own.world.forgetBefore(lastUs);
  });
  tracked(i);
  members.forEach((member) => member.read());
  poses = members.map(({ pose }) => structuredClone(pose));
  const isFirst = i % 2 === 0, first = isFirst ? byThree() : byPackage(), second = isFirst ? byPackage() : byThree();
  lastUs = us;
  const asked = timed(() => queries.forEach((query, side) => query.step(before[side], poses[side])));
  if (i < warm) continue;
  ours.push(isFirst ? first : second);
  bare.push(isFirst ? second : first);
  border.push(ours.at(-1) - bare.at(-1));
  queried.push(asked);
}
// Hands alone, with an engine that answers at once: what is read and placed, and nothing between that takes the caches.
const ignored = () => undefined, atOnce = { fit: () => [], stands: ignored, shape: ignored, forget: ignored, begin: ignored, join: ignored, dispose: ignored };
const { tick: template } = hands[0], answered = ({ body, pose }) => ({ ...template, body, contacts: [], tick: { ...template.tick, shown: pose, contacts: [] } });
const alone = new TouchWorld({ ...atOnce, tick: ({ targets }) => ({ solids: targets.map(answered), events: [] }) }, null), shown = spaces.map((space) => alone.addHand(space));
const read = Array.from({ length: count }, (_, i) => (tracked(i), timed(() => alone.update((i + 1) * tickMs)))).slice(warm);
if (shown.some(({ state }) => state === null)) throw new Error("expected hands that are shown");
console.log(`${2 * handJoints.length + 2} joints in ${scene.triangles} triangles, ${ours.length} frames`);
console.table([summary("what both hands meet first (query.step)", queried), summary("solid: world.update()", ours), summary("solid: the package's own calls", bare), summary("what three.js' objects add, per frame", border), summary("of that, hands read and placed, by themselves", read)]);
