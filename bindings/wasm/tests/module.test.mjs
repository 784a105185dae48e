// foretouch.wasm through foretouch.js, in node: the native program's answers, refusals in words, and
// a solid avatar that passes through nothing.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { Foretouch, ForetouchError } from "../foretouch.js";
import { example, nativeReplay, parseObj, skip } from "./native.mjs";

const module = readFileSync(new URL("../foretouch.wasm", import.meta.url));
const ft = await Foretouch.load(module);

const ball = [{ name: "Ball", parent: null, offset: [0, 0, 0], lss: [{ a: [0, 0, 0], b: [0, 0, 0], radius: 0.1 }] }];
const at = (x, y, z) => ({ rotations: Float64Array.of(1, 0, 0, 0), translations: Float64Array.of(x, y, z) });
const wallAtOne = { positions: [1, -5, -5, 1, 5, -5, 1, 5, 5, 1, -5, 5], indices: [0, 1, 2, 0, 2, 3] };

const tolerance = 1e-3;

for (const [scene, avatar, motion] of [["desk.obj", "hand.avatar.json", "hand.bvh"], ["room.obj", "dancer.avatar.json", "dancer.bvh"]]) {
  test(`${motion} in ${scene}: what the native program says`, { skip }, () => {
    const { names, steps } = nativeReplay({ scene, avatar, motion });
    const room = parseObj(example(scene));
    const body = ft.avatar(example(avatar));
    assert.deepEqual(body.links.map(({ name }) => name), names);
    const query = ft.query(ft.scene(room), body, { tolerance });
    const clip = ft.clip(example(motion), { avatar: body });
    assert.equal(clip.frames, steps.length + 1);
    let contacts = 0;
    for (const { step, contacts: theirs } of steps) {
      const ours = query.step(clip.pose(step), clip.pose(step + 1)).filter(({ verdict }) => verdict !== "clear");
      assert.deepEqual(new Set(ours.map(({ link }) => names[link])), new Set(theirs.map(({ link }) => link)), `step ${step}`);
      for (const their of theirs) {
        const our = ours.find(({ link }) => names[link] === their.link);
        assert.equal(our.verdict, their.verdict);
        // Either may stop anywhere within the tolerance, and so before another object (docs/machines.md).
        for (const { separation } of [our, their]) assert.ok(separation >= 0 && separation <= tolerance);
        assert.ok(Math.abs(our.toi - their.toi) < 0.05, `step ${step}, ${their.link}: ${our.toi} beside ${their.toi}`);
        ++contacts;
      }
    }
    assert.ok(contacts > 50, `${contacts} contacts`);
  });
}

test("a ball that moves past a wall, and one that meets it", () => {
  const query = ft.query(ft.scene(wallAtOne), ft.avatar(ball), { tolerance: 1e-4 });
  assert.equal(query.step(at(0, 0, 0), at(0, 3, 0))[0].verdict, "clear");
  const [hit] = query.step(at(0, 0, 0), at(2, 0, 0));
  assert.equal(hit.verdict, "contact");
  assert.ok(hit.toi <= 0.45 && hit.toi > 0.45 - 1e-4, `${hit.toi}`);
  assert.ok(Math.abs(hit.pointScene[0] - 1) < 1e-9);
  assert.ok(hit.normal[0] < -0.999);
  assert.equal(query.step(at(0.95, 0, 0), at(2, 0, 0))[0].verdict, "starts_in_contact");
});

test("a clear link has a certificate, and one that touches has none", () => {
  const query = ft.query(ft.scene(wallAtOne), ft.avatar(ball));
  query.step(at(0, 0, 0), at(0, 3, 0));
  assert.match(query.certificate(0), /^step 0\nlink 0\nlss 0\nspan \d+ \d+\n/);
  query.step(at(0, 0, 0), at(2, 0, 0));
  assert.doesNotMatch(query.certificate(0), /lss 0/);
});

test("a swept surface is closed, and holds the whole way", () => {
  const query = ft.query(ft.scene(wallAtOne), ft.avatar(ball));
  query.step(at(0, 0, 0), at(0, 3, 0));
  const { positions, indices } = query.swept(0, 0, { error: 5e-3 });
  const edges = new Map();
  for (let i = 0; i < indices.length; i += 3) {
    for (let k = 0; k < 3; ++k) {
      const edge = `${indices[i + k]} ${indices[i + ((k + 1) % 3)]}`;
      edges.set(edge, (edges.get(edge) ?? 0) + 1);
    }
  }
  for (const [edge, count] of edges) assert.equal(edges.get(edge.split(" ").reverse().join(" ")), count);
  const heights = Array.from(positions).filter((_, i) => i % 3 === 1);
  assert.ok(Math.min(...heights) <= -0.1 && Math.max(...heights) >= 3.1);
});

test("a solid ball stays before the wall, and says how hard it is pressed", () => {
  const solid = ft.solid(ft.scene(wallAtOne), ft.avatar(ball));
  assert.equal(solid.follow(at(0, 0, 0), 0.01).state, "equal");
  const free = solid.follow(at(0.5, 0, 0), 0.01);
  assert.equal(free.state, "equal");
  assert.deepEqual(free.shown.translations, at(0.5, 0, 0).translations);
  let tick = free;
  for (let i = 0; i < 20; ++i) tick = solid.follow(at(1.4, 0, 0), 0.01);
  assert.ok(tick.isCertified);
  assert.ok(tick.shown.translations[0] < 0.9 && tick.shown.translations[0] > 0.89, `${tick.shown.translations[0]}`);
  assert.equal(tick.contacts.length, 1);
  assert.ok(Math.abs(tick.contacts[0].push - 0.5) < 0.02, `${tick.contacts[0].push}`);
  assert.equal(tick.joints[0].state, "held");
  const lost = solid.follow(at(-4, 0, 0), 0.01, [false]);
  assert.equal(lost.joints[0].state, "lost");
  assert.ok(lost.shown.translations[0] > 0.8);
  const back = solid.follow(at(0, 0, 0), 1);
  assert.equal(back.state, "equal");
});

test("a still press comes to be held, and stays so", () => {
  const solid = ft.solid(ft.scene(wallAtOne), ft.avatar(ball)), world = ft.solidWorld(ft.scene(wallAtOne), 0), body = world.add(ft.avatar(ball)), states = [];
  for (let i = 1; i <= 40; ++i) {
    const pressed = at(Math.min(1.4, 0.2 * i), 0, 0);
    states.push([solid.follow(pressed, 0.01).state, world.tick(10_000 * i, [{ body, pose: pressed }])[0].tick.state]);
  }
  assert.deepEqual(new Set(states.slice(-20).flat()), new Set(["held"]));
});

test("capsules that are fitted contain their triangles", () => {
  const triangles = Array.from({ length: 900 }, (_, i) => Math.sin(12.9898 * i) * [0.5, 0.1, 0.02][i % 3]), lss = ft.fit(triangles);
  assert.ok(lss.length >= 1 && lss.length <= 4);
  const outside = (p, { a, b, radius }) => {
    const along = b.map((value, i) => value - a[i]), square = along.reduce((sum, value) => sum + value * value, 0);
    const t = square === 0 ? 0 : Math.min(1, Math.max(0, along.reduce((sum, value, i) => sum + value * (p[i] - a[i]), 0) / square));
    return Math.hypot(...p.map((value, i) => value - a[i] - t * along[i])) - radius;
  };
  for (let i = 0; i < triangles.length; i += 9) {
    const corners = [0, 3, 6].map((k) => triangles.slice(i + k, i + k + 3));
    assert.ok(Math.min(...lss.map((one) => Math.max(...corners.map((corner) => outside(corner, one))))) < 1e-12);
  }
  assert.deepEqual(ft.fit([]), []);
});

test("load() says what a server sends in place of the module", async () => {
  const answer = (body, init) => Foretouch.load(new Response(body, init));
  await assert.rejects(answer("<h1>no</h1>", { status: 404, statusText: "Not Found" }), (error) => error instanceof ForetouchError && /^expected foretouch\.wasm, found 404 Not Found/.test(error.message));
  await assert.rejects(answer("<h1>home</h1>", { headers: { "content-type": "text/html" } }), (error) => error instanceof ForetouchError && /found text\/html/.test(error.message));
  assert.equal((await answer(module, { headers: { "content-type": "application/wasm" } })).version, ft.version);
});

test("one that is led on gives the same bytes again", () => {
  const run = () => {
    const solid = ft.solid(ft.scene(wallAtOne), ft.avatar(ball));
    return Array.from({ length: 40 }, (_, i) => solid.follow(at(0.05 * i, 0.01 * i, 0), 0.01).shown.translations.join());
  };
  assert.deepEqual(run(), run());
});

test("what cannot be used is refused in words", () => {
  const refuses = (call, words) => assert.throws(call, (error) => error instanceof ForetouchError && words.test(error.message));
  const scene = ft.scene(wallAtOne), avatar = ft.avatar(ball), query = ft.query(scene, avatar);
  refuses(() => ft.avatar("{"), /avatar:1: .*JSON/);
  refuses(() => ft.avatar([{ ...ball[0], lss: [{ a: [0, 0, 0], b: [0, 0, 0], radius: -1 }] }]), /radius/);
  refuses(() => ft.clip("HIERARCHY\n"), /clip:\d/);
  refuses(() => ft.scene({ positions: [] }), /1 to 50,000,000 triangles/);
  refuses(() => ft.scene({ positions: [0, 0, 0], indices: [0, 0, 1] }), /triangle 0: expected vertices 0 to 0, found 1/);
  refuses(() => ft.scene({ positions: new Array(9).fill(Number.NaN) }), /triangle/);
  refuses(() => ft.scene({ positions: new Array(9).fill(1e300) }), /1e\+?0?7/);
  refuses(() => ft.query(scene, avatar, { tolerance: 0 }), /tolerance/);
  refuses(() => ft.fit([1, 2]), /^triangles: expected nine numbers each/);
  refuses(() => ft.fit(new Array(9).fill(Number.NaN)), /^triangles: expected finite numbers/);
  refuses(() => ft.fit([], { most: 0 }), /^most: expected a whole number/);
  refuses(() => query.step(at(0, 0, 0), at(Number.NaN, 0, 0)), /^to/);
  refuses(() => query.step(at(0, 0, 0), { rotations: Float64Array.of(1), translations: Float64Array.of() }), /to: expected 1 joints/);
  refuses(() => ft.query(scene, avatar).certificate(0), /step\(\) to be answered before/);
  refuses(() => query.swept(0, 0), /step\(\) to be answered before/);
  query.step(at(0, 0, 0), at(0, 1, 0));
  refuses(() => query.swept(0, 7), /^lss: expected one of the 1 LSS/);
  refuses(() => query.swept(1, 0), /^link/);
  refuses(() => query.certificate(0.5), /^link/);
  refuses(() => ft.solid(scene, avatar, { skin: 1 }), /skin/);
  refuses(() => ft.solid(scene, avatar).follow(at(0, 0, 0), 0), /dt/);
  scene.dispose();
  refuses(() => ft.query(scene, avatar), /disposed/);
  // What stands on it lives on.
  assert.equal(query.step(at(0, 0, 0), at(0, 1, 0))[0].verdict, "clear");
});

test("a module that is another, or none, is refused", async () => {
  const empty = Uint8Array.of(0, 97, 115, 109, 1, 0, 0, 0);
  await assert.rejects(Foretouch.load(empty), /another module/);
  await assert.rejects(Foretouch.load(module.subarray(0, 1000)), WebAssembly.CompileError);
});
