// Rays and casts of ours beside three.js', three-mesh-bvh's and Rapier's: in a room that stands still, at one
// skinned figure, and at a crowd whose poses are those of another instant for every ray.
//   node bindings/wasm/tests/rays.mjs [--rays N] [--json FILE]
// Ends with 1 where ours misses what another one hits clearly.

import { readFileSync, writeFileSync } from "node:fs";
import { parseArgs } from "node:util";
import RAPIER from "@dimforge/rapier3d-compat";
import * as THREE from "three";
import { MeshBVH, StaticGeometryGenerator } from "three-mesh-bvh";
import { Foretouch } from "../foretouch.js";
import { axisTurn, seeded } from "./hand.mjs";
import { example, parseObj } from "./native.mjs";

const { values: asked } = parseArgs({ options: { rays: { type: "string", default: "2000" }, json: { type: "string" } } });
const rays = Number(asked.rays), radius = 0.1, far = 100;
const crowd = 100, joints = 22, ring = 32, rows = 14; // 22 links of 2 * 32 * 14 triangles and two lids: about 20,000
const ft = await Foretouch.load(readFileSync(new URL("../foretouch.wasm", import.meta.url)));
await RAPIER.init();

const rounded = (value) => (value >= 100 ? Math.round(value) : Math.round(100 * value) / 100);

/** Shares of a sorted list, in microseconds. */
function summary(times) {
  const sorted = Float64Array.from(times).sort(), at = (share) => sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))];
  return { p50_us: rounded(at(0.5)), p90_us: rounded(at(0.9)), p99_us: rounded(at(0.99)), mean_us: rounded(times.reduce((sum, time) => sum + time, 0) / times.length) };
}

/** Asks all, once to warm up; how long each took, and what it said. */
function timed(questions, ask) {
  const times = [], said = [];
  for (const question of questions.slice(0, 100)) ask(question);
  for (const question of questions) {
    const begin = performance.now();
    said.push(ask(question));
    times.push(1e3 * (performance.now() - begin));
  }
  return { times, said };
}

/** A hundred in one call: each one's share of it. */
function timedTogether(world, questions) {
  const times = [], said = [], each = 100;
  for (let i = 0; i < questions.length; i += each) {
    const some = questions.slice(i, i + each), begin = performance.now(), answers = world.probeMany(some);
    times.push(...some.map(() => (1e3 * (performance.now() - begin)) / some.length));
    said.push(...answers.map(distanceOf));
  }
  return { times, said };
}

/** Ours missed what another one hits, by more than rounding of floats. */
let missed = 0;
function row(question, by, { times, said }, ours) {
  const off = said.reduce((sum, distance, i) => {
    const own = ours[i], differs = (own === null) !== (distance === null) || (own !== null && Math.abs(own - distance) > 1e-3);
    return sum + (differs ? 1 : 0);
  }, 0);
  const percent = (count) => Math.round((1e4 * count) / said.length) / 100;
  return { question, by, ...summary(times), hit_percent: percent(said.filter((distance) => distance !== null).length), off_percent: percent(off) };
}

const distanceOf = ({ hits }) => (hits.length > 0 ? hits[0].distance : null);

function stillRoom() {
  const room = parseObj(example("room.obj")), random = seeded(1);
  const low = [0, 1, 2].map((axis) => room.positions.reduce((least, value, i) => (i % 3 === axis ? Math.min(least, value) : least), Infinity));
  const high = [0, 1, 2].map((axis) => room.positions.reduce((most, value, i) => (i % 3 === axis ? Math.max(most, value) : most), -Infinity));
  const place = () => low.map((value, axis) => value + random() * (high[axis] - value));
  const questions = Array.from({ length: rays }, () => {
    const from = place(), way = place().map((value, axis) => value - from[axis]), length = Math.hypot(...way);
    return { from, way: way.map((value) => value / length), length };
  });
  const world = ft.world(ft.scene(room));
  const ourRays = timed(questions, ({ from, way, length }) => distanceOf(world.probe(0, from, { direction: way, reach: length })));
  const ourCasts = timed(questions, ({ from, way, length }) => distanceOf(world.probe(0, { a: from, radius }, { direction: way, reach: length })));

  const together = timedTogether(world, questions.map(({ from, way, length }) => ({ time: 0, shape: from, direction: way, reach: length })));

  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(Float32Array.from(room.positions), 3));
  geometry.setIndex(room.indices);
  const bvh = new MeshBVH(geometry), ray = new THREE.Ray();
  const bvhRays = timed(questions, ({ from, way, length }) => {
    ray.origin.set(...from);
    ray.direction.set(...way);
    return bvh.raycastFirst(ray, THREE.DoubleSide, 0, length)?.distance ?? null;
  });

  const rapier = new RAPIER.World({ x: 0, y: 0, z: 0 });
  rapier.createCollider(RAPIER.ColliderDesc.trimesh(Float32Array.from(room.positions), Uint32Array.from(room.indices)));
  rapier.step();
  const point = ([x, y, z]) => ({ x, y, z }), ball = new RAPIER.Ball(radius), none = { x: 0, y: 0, z: 0, w: 1 };
  const rapierRays = timed(questions, ({ from, way, length }) => rapier.castRay(new RAPIER.Ray(point(from), point(way)), length, true)?.timeOfImpact ?? null);
  const rapierCasts = timed(questions, ({ from, way, length }) => {
    const hit = rapier.castShape(point(from), none, point(way), ball, 0, length, true);
    return hit === null ? null : hit.time_of_impact ?? hit.timeOfImpact;
  });
  missed += ourRays.said.filter((own, i) => own === null && bvhRays.said[i] !== null && bvhRays.said[i] < questions[i].length - 1e-3).length;
  rapier.free();
  return [
    row("ray", "ours", ourRays, ourRays.said),
    row("ray", "ours, a hundred at once", together, ourRays.said),
    row("ray", "three-mesh-bvh (float)", bvhRays, ourRays.said),
    row("ray", "Rapier (float)", rapierRays, ourRays.said),
    row("sphere of 10 cm, cast", "ours", ourCasts, ourCasts.said),
    row("sphere of 10 cm, cast", "Rapier (float)", rapierCasts, ourCasts.said),
  ];
}

/** A figure of 22 links one after the other, 10 cm each, that bends. */
const links = Array.from({ length: joints }, (_, i) => ({ name: `link${i}`, parent: i === 0 ? null : `link${i - 1}`, offset: [0, i === 0 ? 0 : 0.1, 0], lss: [{ a: [0, 0, 0], b: [0, 0.1, 0], radius: 0.05 }] }));
function bent(place, time) {
  const rotations = new Float64Array(4 * joints), translations = new Float64Array(3 * joints);
  links.forEach(({ offset }, link) => {
    rotations.set(axisTurn([Math.sin(link), 0, Math.cos(link)], 0.15 * Math.sin(4 * time + link)), 4 * link);
    translations.set(link === 0 ? place : offset, 3 * link);
  });
  return { rotations, translations };
}

/** A tube around the figure, bound to the two links that are nearest. */
function skinned() {
  const positions = [], indices = [], skinIndex = [], skinWeight = [], random = seeded(2), height = joints * 0.1, steps = joints * rows;
  for (let step = 0; step <= steps; ++step) {
    const y = (step / steps) * height, along = Math.min(joints - 1e-6, y / 0.1), link = Math.floor(along), above = Math.min(joints - 1, link + 1), share = 0.5 * Math.max(0, 2 * (along - link) - 1);
    for (let k = 0; k < ring; ++k) {
      positions.push(0.05 * Math.cos((2 * Math.PI * k) / ring), y, 0.05 * Math.sin((2 * Math.PI * k) / ring));
      skinIndex.push(link, above, 0, 0);
      skinWeight.push(1 - share, share, 0, 0);
      if (step === steps) continue;
      const a = step * ring + k, b = step * ring + ((k + 1) % ring);
      indices.push(a, b, a + ring, b, b + ring, a + ring);
    }
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(Float32Array.from(positions), 3));
  geometry.setAttribute("skinIndex", new THREE.BufferAttribute(Uint16Array.from(skinIndex), 4));
  geometry.setAttribute("skinWeight", new THREE.BufferAttribute(Float32Array.from(skinWeight), 4));
  geometry.setIndex(indices);
  const bones = links.map(({ offset }) => {
    const bone = new THREE.Bone();
    bone.position.set(...offset);
    return bone;
  });
  bones.forEach((bone, i) => i > 0 && bones[i - 1].add(bone));
  const mesh = new THREE.SkinnedMesh(geometry, new THREE.MeshBasicMaterial({ side: THREE.DoubleSide }));
  mesh.add(bones[0]);
  mesh.updateMatrixWorld(true);
  mesh.bind(new THREE.Skeleton(bones));
  const pose = (time) => {
    const { rotations } = bent([0, 0, 0], time);
    bones.forEach((bone, i) => bone.quaternion.set(rotations[4 * i + 1], rotations[4 * i + 2], rotations[4 * i + 3], rotations[4 * i]));
    mesh.updateMatrixWorld(true);
    mesh.skeleton.update();
  };
  const questions = Array.from({ length: Math.min(rays, 300) }, () => {
    const turn = 6.28 * random(), aim = [0.1 * (random() - 0.5), height * random(), 0.1 * (random() - 0.5)], from = [5 * Math.cos(turn), aim[1], 5 * Math.sin(turn)];
    const way = aim.map((value, axis) => value - from[axis]), length = Math.hypot(...way);
    return { time: 10 * random(), from, way: way.map((value) => value / length) };
  });
  const caster = new THREE.Raycaster(), triangles = indices.length / 3;
  const threes = timed(questions, ({ time, from, way }) => {
    pose(time);
    mesh.computeBoundingSphere(); // or it would be that of another pose
    caster.set(new THREE.Vector3(...from), new THREE.Vector3(...way));
    return caster.intersectObject(mesh, false)[0]?.distance ?? null;
  });
  const baker = new StaticGeometryGenerator(mesh);
  baker.attributes = ["position"];
  const baked = baker.generate(), bvh = new MeshBVH(baked), ray = new THREE.Ray();
  const refitted = timed(questions, ({ time, from, way }) => {
    pose(time);
    baker.generate(baked);
    bvh.refit();
    ray.origin.set(...from);
    ray.direction.set(...way);
    return bvh.raycastFirst(ray, THREE.DoubleSide)?.distance ?? null;
  });
  // Ours: each vertex where its links have it at rest, and poses so dense that what lies between is as bent as theirs.
  const avatar = ft.avatar(links), hz = 240, seconds = 10;
  avatar.setSkin({
    triangles: indices, influences: 4, links: skinIndex, weights: skinWeight,
    triangleLinks: Array.from({ length: triangles }, (_, i) => skinIndex[4 * indices[3 * i]]),
    points: skinIndex.flatMap((link, share) => [0, 1, 2].map((axis) => positions[3 * Math.floor(share / 4) + axis] - (axis === 1 ? 0.1 * link : 0))),
  });
  const world = ft.world(), figure = world.add(avatar);
  for (let tick = 0; tick <= hz * seconds; ++tick) world.push(figure, Math.round((1e6 * tick) / hz), bent([0, 0, 0], tick / hz));
  const ours = timed(questions, ({ time, from, way }) => distanceOf(world.probe(Math.round(1e6 * time), from, { direction: way, reach: far })));
  missed += ours.said.filter((own, i) => own === null && threes.said[i] !== null).length > questions.length / 100 ? 1 : 0;
  const name = `ray at a skinned figure of ${triangles.toLocaleString("en")} triangles, another instant each`;
  return [row(name, "ours", ours, ours.said), row(name, "three.js, SkinnedMesh.raycast", threes, ours.said), row(name, "three-mesh-bvh, baked and refitted", refitted, ours.said)];
}

function crowded() {
  const random = seeded(3), world = ft.world(), avatar = ft.avatar(links), places = Array.from({ length: crowd }, (_, i) => [5 * (i % 10), 0, 5 * Math.floor(i / 10)]);
  const bodies = places.map(() => world.add(avatar)), hz = 60;
  for (let tick = 0; tick <= hz; ++tick) bodies.forEach((body, i) => world.push(body, Math.round((1e6 * tick) / hz), bent(places[i], tick / hz + i)));
  const questions = Array.from({ length: rays }, () => {
    const place = places[Math.floor(crowd * random())], turn = 6.28 * random(), aim = [place[0] + 0.2 * (random() - 0.5), 2 * random(), place[2] + 0.2 * (random() - 0.5)];
    const from = [aim[0] + 20 * Math.cos(turn), aim[1], aim[2] + 20 * Math.sin(turn)], way = aim.map((value, axis) => (value - from[axis]) / 20);
    return { us: Math.floor(1e6 * random()), from, way };
  });
  const ours = timed(questions, ({ us, from, way }) => distanceOf(world.probe(us, from, { direction: way, reach: far })));
  const rapier = new RAPIER.World({ x: 0, y: 0, z: 0 }), turn90 = new THREE.Quaternion();
  const colliders = places.flatMap(() => links.map(() => rapier.createCollider(RAPIER.ColliderDesc.capsule(0.05, 0.05))));
  // Kinematics of three.js; its matrices are doubles.
  const frame = new THREE.Matrix4(), local = new THREE.Matrix4(), q = new THREE.Quaternion(), p = new THREE.Vector3(), one = new THREE.Vector3(1, 1, 1);
  const theirs = timed(questions, ({ us, from, way }) => {
    // The poses between two ticks, body by body: as a server that rewinds does.
    const tick = (us * hz) / 1e6, before = Math.floor(tick), share = tick - before;
    let next = 0;
    for (let i = 0; i < crowd; ++i) {
      const a = bent(places[i], before / hz + i), b = bent(places[i], (before + 1) / hz + i);
      frame.identity();
      for (let link = 0; link < joints; ++link) {
        const of = ({ rotations }) => turn90.clone().set(rotations[4 * link + 1], rotations[4 * link + 2], rotations[4 * link + 3], rotations[4 * link]);
        frame.multiply(local.compose(p.set(a.translations[3 * link], a.translations[3 * link + 1], a.translations[3 * link + 2]), q.copy(of(a)).slerp(of(b), share), one));
        p.set(0, 0.05, 0).applyMatrix4(frame);
        q.setFromRotationMatrix(frame);
        const collider = colliders[next++];
        collider.setTranslation(p);
        collider.setRotation(q);
      }
    }
    rapier.step(); // which brings its tree to the places
    return rapier.castRay(new RAPIER.Ray({ x: from[0], y: from[1], z: from[2] }, { x: way[0], y: way[1], z: way[2] }), far, true)?.timeOfImpact ?? null;
  });
  missed += ours.said.filter((own, i) => own === null && theirs.said[i] !== null).length > questions.length / 100 ? 1 : 0;
  rapier.free();
  const name = `ray at ${crowd} figures of ${joints} capsules, another instant each`;
  return [row(name, "ours", ours, ours.said), row(name, "Rapier, moved there (float)", theirs, ours.said)];
}

const table = {
  name: "rays", title: `Rays and casts in JavaScript, ${rays} of each, at a skinned figure ${Math.min(rays, 300)}`, command: "./run npm --rays", date: new Date().toISOString().slice(0, 10),
  columns: Object.entries({ question: "question", by: "by", p50_us: "us p50", p90_us: "p90", p99_us: "p99", mean_us: "mean", hit_percent: "with a hit %", off_percent: "more than 1 mm from the first row %" }).map(([key, title]) => ({ key, title })),
  rows: [...stillRoom(), ...skinned(), ...crowded()],
};
console.table(table.rows.map((one) => Object.fromEntries(table.columns.map(({ key, title }) => [title, one[key]]))));
if (asked.json !== undefined) {
  const machine = { description: `node ${process.version}, what other work left of a shared cloud machine (x86-64)` };
  writeFileSync(asked.json, `${JSON.stringify({ format: "foretouch-figures", version: 1, title: "Rays in JavaScript", machine, tables: [table] }, null, 1)}\n`);
}
process.exitCode = missed > 0 ? 1 : 0;
