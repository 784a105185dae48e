// Questions to a world: what plain arithmetic says of balls and boxes, the native program's answers,
// many at once as each alone, and refusals in words.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { existsSync } from "node:fs";
import { Foretouch, ForetouchError, stillScene } from "../foretouch.js";
import { program } from "./native.mjs";

const ft = await Foretouch.load(readFileSync(new URL("../foretouch.wasm", import.meta.url)));
const tolerance = 1e-9;
const ball = (radius) => ft.avatar([{ name: "ball", parent: null, offset: [0, 0, 0], lss: [{ a: [0, 0, 0], b: [0, 0, 0], radius }] }]);
const at = (x, y = 0, z = 0) => ({ rotations: [1, 0, 0, 0], translations: [x, y, z] });
const box = [0, 1, 2, 3, 4, 5, 6, 7].map((i) => [i & 1 ? 0.25 : -0.25, i & 2 ? 0.25 : -0.25, i & 4 ? 0.25 : -0.25]);
const pyramid = { positions: [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1], indices: [0, 1, 2, 0, 1, 3, 0, 2, 3, 1, 2, 3], objectNames: ["pyramid"] };
/** Never farther than it is, and at most a nanometre nearer. */
const isAt = (distance, expected) => assert.ok(distance <= expected && distance >= expected - 2 * tolerance, `${distance} beside ${expected}`);
const near = (values, expected) => values.forEach((value, i) => assert.ok(Math.abs(value - expected[i]) <= 1e-8, `${values} beside ${expected}`));
const refuses = (call, words) => assert.throws(call, (error) => error instanceof ForetouchError && words.test(error.message));

/** As the module has them: in lexicographic order. */
const corners = [[2, -9, -9], [2, 0, 9], [2, 9, -9]];

/** A wall at x = 2 and a ball that goes from 0 to 1 in a second. */
function hall() {
  const world = ft.world(ft.scene({ positions: [2, -9, -9, 2, 9, -9, 2, 0, 9], indices: [0, 1, 2], objectNames: ["wall"] }));
  const body = world.add(ball(0.5), { group: 3 });
  world.push(body, 0, at(0));
  world.push(body, 1_000_000, at(1));
  return { world, body };
}

test("rays, casts, overlaps and the nearest, now and then", () => {
  const { world, body } = hall();
  const ray = { direction: [-2, 0, 0] };
  for (const us of [0, 250_000, 1_000_000]) {
    const { verdict, hits, isComplete } = world.probe(us, [1.75, 0, 0], ray);
    assert.deepEqual([verdict, hits.length, isComplete, hits[0].what.body, hits[0].what.link], ["hit", 1, true, body, 0]);
    isAt(hits[0].distance, 1.75 - 0.5 - us / 1e6);
    assert.deepEqual(hits[0].normal, [1, 0, 0]);
    near(hits[0].what.point, [0.5 + us / 1e6, 0, 0]);
  }
  const all = world.probe([500_000, 0.5], [-3, 0, 0], { direction: [1, 0, 0], which: "all" });
  assert.deepEqual(all.hits.map(({ what }) => [what.body, what.object]), [[body, -1], [stillScene, 0]]);
  const [wall] = world.probe(0, [-3, 0.25, 0.375], { direction: [1, 0, 0], only: [{ object: 0 }] }).hits;
  near(wall.what.point, [2, 0.25, 0.375]);
  near([0, 1, 2].map((axis) => wall.weights[0] * corners[0][axis] + wall.weights[1] * corners[1][axis] + wall.weights[2] * corners[2][axis]), wall.what.point);
  isAt(world.probe(0, { a: [-3, 0, 0], radius: 0.25 }, { direction: [1, 0, 0] }).hits[0].distance, 2.25);
  isAt(world.probe(0, { a: [0, 1, 0], b: [0, 2, 0], radius: 0.25 }, { within: 5 }).hits[0].distance, 0.25);
  assert.equal(world.probe(0, { a: [0, 1, 0], radius: 0.6 }).verdict, "hit");
  assert.equal(world.probe(0, { a: [0, 1, 0], radius: 0.4 }).verdict, "clear");
  // What a question is about.
  const onWall = (options) => assert.equal(world.probe(0, [-3, 0, 0], { direction: [1, 0, 0], ...options }).hits[0].what.body, stillScene);
  onWall({ without: [body] });
  onWall({ without: [{ body, link: 0 }] });
  onWall({ groups: [0, 31] });
  onWall({ only: [{ object: 0 }] });
  assert.equal(world.probe(0, [-3, 0, 0], { direction: [1, 0, 0], without: [body], still: false }).verdict, "clear");
  isAt(world.probe(0, [-3, 0, 0], { direction: [1, 0, 0], instants: new Map([[body, [999_999, 0.5]]]) }).hits[0].distance, 3.4999995);
});

test("what is not known is no miss", () => {
  const { world, body } = hall();
  const { verdict, hits, unknown, isComplete } = world.probe(2_000_000, [0, 5, 0], { direction: [0, 1, 0] });
  assert.deepEqual([verdict, hits, unknown, isComplete], ["unknown", [], [{ body, why: "silent", object: -1 }], false]);
  assert.equal(world.probe(-1, [0, 5, 0], { direction: [0, 1, 0] }).unknown[0].why, "not_there");
  world.forgetBefore(500_000);
  refuses(() => world.probe(499_999, [0, 5, 0], { direction: [0, 1, 0] }), /forgotten/);
});

test("the past is thinned, and kept within bytes", () => {
  const { world, body } = hall();
  for (let i = 1; i <= 50; ++i) world.push(body, 1_000_000 + 1000 * i, at(1 + 0.001 * i));
  const all = world.poseBytes();
  assert.equal(all, 52 * (56 + 256));
  world.thinBefore(1_050_000, 1e-6);
  assert.ok(world.poseBytes() < all / 4);
  isAt(world.probe(1_025_000, [-3, 0, 0], { direction: [1, 0, 0] }).hits[0].distance, 3.525);
  refuses(() => world.thinBefore(0, -1), /metres/);
  refuses(() => world.thinBefore(0, "1"), /metres/);
  const untilUs = world.forgetBeyond(2 * (56 + 256));
  assert.ok(untilUs > 0 && world.poseBytes() <= 2 * (56 + 256));
  refuses(() => world.probe(untilUs - 1, [0, 5, 0], { direction: [0, 1, 0] }), /forgotten/);
});

test("boxes are cast, overlap and are near; points are inside of what is closed", () => {
  const { world, body } = hall();
  isAt(world.probe(0, { hull: box, a: [-3, 0, 0] }, { direction: [1, 0, 0] }).hits[0].distance, 2.25);
  isAt(world.probe(0, { hull: box, a: [-3, 0, 0], radius: 0.125 }, { direction: [1, 0, 0] }).hits[0].distance, 2.125);
  isAt(world.probe(0, { hull: box.map(([x, y, z]) => [x, y + 2, z]) }, { within: 3 }).hits[0].distance, 1.25);
  assert.equal(world.probe(0, { hull: box, a: [0.7, 0, 0] }).hits[0].what.body, body);
  assert.equal(world.probe(0, { hull: box, a: [0.8, 0, 0] }).verdict, "clear");
  for (const isClosed of [true, false]) {
    const room = ft.world(ft.scene(isClosed ? pyramid : { ...pyramid, indices: pyramid.indices.slice(3) }));
    const within = room.probe(0, [0.1, 0.1, 0.1], { solids: true });
    if (isClosed) assert.deepEqual([within.hits[0].distance, within.hits[0].what.object, within.hits[0].what.triangle], [0, 0, -1]);
    else assert.deepEqual([within.verdict, within.unknown], ["unknown", [{ body: stillScene, why: "open", object: 0 }]]);
    assert.equal(room.probe(0, [0.1, 0.1, 0.1]).verdict, "clear");
    assert.equal(room.probe(0, [1, 1, 1.5], { solids: true }).verdict, "clear");
  }
});

/** A ribbon on an arm along x, whose two links bend in the middle of it: there its vertices follow both alike. */
const ribbon = {
  triangles: [0, 1, 2, 1, 3, 2, 2, 3, 4, 3, 5, 4],
  triangleLinks: [0, 0, 1, 1],
  influences: 2,
  links: [0, 0, 0, 0, 0, 1, 0, 1, 1, 0, 1, 0],
  weights: [1, 0, 1, 0, 0.5, 0.5, 0.5, 0.5, 1, 0, 1, 0],
  points: [0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, -1, 0, 0, -1, 1, 0, 1, 0, 0, 1, 1, 0, -1, 0, 0, 0, 1, 0, 1, 0, 0, 0],
};
const arm = () => ft.avatar([0, 1].map((link) => ({ name: `link${link}`, parent: link === 0 ? null : "link0", offset: [link, 0, 0], lss: [{ a: [0, 0, 0], b: [1, 0, 0], radius: 0.01 }] })));

test("a skin is met as it is bent at the instant, and by bodies that are added later", () => {
  const world = ft.world(), avatar = arm(), bare = world.add(avatar, { group: 1 });
  avatar.setSkin(ribbon);
  const body = world.add(avatar), turn = Math.PI / 4;
  for (const one of [bare, body]) {
    world.push(one, 0, { rotations: [1, 0, 0, 0, 1, 0, 0, 0], translations: [0, 0, 0, 1, 0, 0] });
    world.push(one, 1_000_000, { rotations: [1, 0, 0, 0, Math.cos(turn), 0, 0, Math.sin(turn)], translations: [0, 0, 0, 1, 0, 0] });
  }
  const from = (x, us) => world.probe(us, [x, 5, 0.5], { direction: [0, -1, 0] });
  assert.equal(world.probe(0, [0.5, 5, 0.5], { direction: [0, -1, 0], groups: [1] }).verdict, "clear");
  for (const [us, bent] of [[0, 0], [500_000, turn], [1_000_000, 2 * turn]]) {
    // From the middle, at x = 1, it goes on at the second link's angle: up to one metre.
    const x = 1 + 0.5 * Math.cos(bent), [hit] = from(us === 1_000_000 ? 0.5 : x, us).hits;
    isAt(hit.distance, us === 1_000_000 ? 5 : 5 - 0.5 * Math.sin(bent));
    assert.deepEqual([hit.what.body, hit.what.link], [body, us === 1_000_000 ? 0 : 1]);
  }
  const flight = world.fly(0, 1000, { a: [0.5, 1, 0.5], radius: 0.1 }, [0, -2, 0], { groups: [0] });
  assert.deepEqual([flight.verdict, flight.unknown], ["unknown", [{ body, why: "unresolved", object: -1 }]]);
  const refused = (change, words) => refuses(() => arm().setSkin({ ...ribbon, ...change }), words);
  refused({ influences: 0 }, /^influences/);
  refused({ influences: 5 }, /^weights: expected 5 per vertex/);
  refused({ points: [0] }, /^weights/);
  refused({ weights: ribbon.weights.map(() => Number.NaN) }, /weight/);
  refused({ weights: ribbon.weights.map((weight) => 2 * weight) }, /weights that sum to one/);
  refused({ triangles: [0, 1, 2] }, /^triangles/);
  refused({ triangles: ribbon.triangles.map(() => 9) }, /vertices/);
  refused({ triangles: ribbon.triangles.map(() => 0.5) }, /^triangles/);
  refused({ triangleLinks: [0, 0, 1, 7] }, /triangle_links|link 7/);
  refused({ links: ribbon.links.map(() => -1) }, /link/);
});

test("what flies hits where the ball is by then", () => {
  const { world, body } = hall();
  // They close at 3 m/s, 2.4 m apart less both radii.
  const { verdict, hit, timeUs, timeFraction, unknown } = world.fly(0, 1_000_000, { a: [3, 0, 0], radius: 0.1 }, [-2, 0, 0], { still: false });
  assert.deepEqual([verdict, hit.what.body, unknown], ["hit", body, []]);
  const us = timeUs + timeFraction;
  assert.ok(us <= 800_000 && us > 800_000 - 0.01, `${us}`);
  isAt(hit.distance, 1.6);
  const passing = world.fly(0, 1_000_000, { a: [3, 5, 0], radius: 0.1 }, [-2, 0, 0], { still: false });
  assert.deepEqual([passing.verdict, passing.hit, passing.timeUs], ["clear", null, null]);
});

/** Numbers with few digits, so that a world file and the module get the same. */
function draws(seed) {
  let state = seed;
  return () => ((state = (state * 1103515245 + 12345) % 2147483648) / 2147483648) * 2 - 1;
}
const rounded = (x) => Math.round(x * 1024) / 1024;

test("many questions have the answers of each alone", () => {
  const { world, body } = hall();
  const random = draws(7), questions = [];
  for (let i = 0; i < 300; ++i) {
    const place = [3 * random(), 2 * random(), random()], way = [random(), random(), random()];
    const time = Math.floor(500_000 * (1 + random()));
    const shape = [place, { a: place, radius: 0.2 }, { hull: box, a: place }, { a: place, b: way, radius: 0.1 }][i % 4];
    const asks = [{ direction: way, reach: 3 }, { within: 1 }, {}][i % 3];
    questions.push({ time, shape, ...asks, which: i % 2 ? "all" : "closest", ...(i % 5 === 0 ? { instants: new Map([[body, 1000 * i]]) } : {}) });
  }
  const answers = world.probeMany(questions);
  answers.forEach((answer, i) => {
    const { time, shape, ...options } = questions[i];
    assert.deepEqual(answer, world.probe(time, shape, options));
  });
  const hits = answers.filter(({ verdict }) => verdict === "hit").length;
  assert.ok(hits > 50 && hits < 250, `${hits}`);
  assert.deepEqual(world.probeMany([]), []);
  refuses(() => world.probeMany([{ time: 0, shape: [0, 0, 0] }, { time: 0, shape: [0, 0, 0], direction: [0, 0, 0] }]), /question 1/);
});

/** Balls and a mesh that move without a turn, and the scene: by the native program and by the module. */
function stages(folder, random) {
  const scene = { positions: [], indices: [] }, lines = ["o clutter"];
  for (let i = 0; i < 30; ++i) {
    const middle = [2 * random(), 2 * random(), 2 * random()];
    for (let k = 0; k < 3; ++k) {
      const v = middle.map((x) => rounded(x + 0.7 * random()));
      scene.positions.push(...v);
      lines.push(`v ${v.join(" ")}`);
    }
    scene.indices.push(3 * i, 3 * i + 1, 3 * i + 2);
    lines.push(`f ${3 * i + 1} ${3 * i + 2} ${3 * i + 3}`);
  }
  writeFileSync(join(folder, "scene.obj"), `${lines.join("\n")}\n`);
  const world = ft.world(ft.scene({ ...scene, objectNames: ["clutter"] }));
  let file = 'format = "foretouch-world"\nversion = 1\n[scene]\nfile = "scene.obj"\n';
  for (let i = 0; i < 6; ++i) {
    const radius = rounded(0.2 + 0.1 * random()), body = world.add(ball(radius));
    file += `[[body]]\nname = "b${i}"\nsphere = ${radius}\n`;
    for (const us of [0, 500_000, 1_000_000]) {
      const position = [rounded(2 * random()), rounded(2 * random()), rounded(2 * random())];
      world.push(body, us, at(...position));
      file += `[[body.pose]]\ntime = ${us / 1e6}\nposition = [${position.join(", ")}]\n`;
    }
  }
  writeFileSync(join(folder, "world.toml"), file);
  return world;
}

test("the native program's answers, but for the last digits of another compiler", { skip: existsSync(program) ? false : `there is no native program (FORETOUCH_PROGRAM: '${program}')` }, () => {
  const folder = mkdtempSync(join(tmpdir(), "foretouch-ask-"));
  try {
    const random = draws(11), world = stages(folder, random);
    let hits = 0, same = 0;
    for (let i = 0; i < 80; ++i) {
      const from = [rounded(3 * random()), rounded(3 * random()), rounded(3 * random())], way = from.map((x) => rounded(random() - x));
      const time = Math.round(500_000 * (1 + random())), radius = i % 2 ? rounded(0.1 + 0.05 * random()) : 0;
      const given = ["ask", join(folder, "world.toml"), "--json", "--at", `${time / 1e6}`, `--from=${from.join(",")}`, "--radius", `${radius}`];
      const kind = i % 4, shape = { a: from, radius };
      if (kind < 2) given.push(`--along=${way.join(",")}`, "--reach", "6", ...(i % 3 ? ["--all"] : []));
      if (kind === 2) given.push("--within", "1.5", "--all");
      const options = [{ direction: way, reach: 6, which: i % 3 ? "all" : "closest" }, { direction: way, reach: 6, which: i % 3 ? "all" : "closest" }, { within: 1.5, which: "all" }, { which: "all" }][kind];
      const theirs = JSON.parse(execFileSync(program, given, { encoding: "utf8" })), ours = world.probe(time, shape, options);
      assert.equal(ours.verdict, theirs.verdict);
      assert.equal(ours.hits.length, theirs.hits.length);
      ours.hits.forEach(({ distance, normal, what }, k) => {
        const their = theirs.hits[k];
        assert.ok(Math.abs(distance - their.distance) <= 1e-14 * (1 + distance), `${distance} beside ${their.distance}`);
        if (distance === their.distance) ++same;
        near(what.point, their.of.point);
        if (Math.hypot(...normal) > 0 && distance > 1e-6) near(normal, their.normal);
      });
      hits += ours.hits.length;
    }
    assert.ok(hits > 50 && same > 0.5 * hits, `${hits} hits, ${same} at the same distance`);
  } finally {
    rmSync(folder, { recursive: true });
  }
});

test("what cannot be asked is refused in words", () => {
  const { world, body } = hall();
  const asks = (shape, options, time = 0) => () => world.probe(time, shape, options);
  refuses(asks([0, 0, 0], { direction: [0, 0, 0] }), /^direction: expected a direction to cast along/);
  refuses(asks([0, 0, 0], { direction: [0, Number.NaN, 1] }), /^direction/);
  refuses(asks([0, 0, 0], { direction: [0, 0, 1], reach: Number.POSITIVE_INFINITY }), /^reach/);
  refuses(asks([0, 0, 0], { direction: [0, 0, 1], within: 1 }), /^within/);
  refuses(asks([0, 0], {}), /^shape: expected three numbers/);
  refuses(asks(null, {}), /^shape/);
  refuses(asks("here", {}), /^shape/);
  refuses(asks({ hull: [] }, {}), /^shape.hull: expected corners/);
  refuses(asks({ hull: [[0, 0]] }, {}), /^shape.hull\[0\]/);
  refuses(asks({ a: [0, 0, 0], radius: -1 }, {}), /^shape/);
  refuses(asks([0, 0, 0], { which: "first" }), /^which: expected one of closest/);
  refuses(asks([0, 0, 0], { without: [7] }), /without|body 7/);
  refuses(asks([0, 0, 0], { only: [{ body, link: 4 }] }), /link/);
  refuses(asks([0, 0, 0], { groups: [32] }), /^groups/);
  refuses(asks([0, 0, 0], { raech: 1 }), /'raech'/);
  refuses(asks([0, 0, 0], {}, 0.5), /^timeUs/);
  refuses(asks([0, 0, 0], {}, [0, 1]), /^time/);
  refuses(asks([0, 0, 0], { instants: new Map([[body, 2 ** 60]]) }), /^instants/);
  refuses(() => world.fly(10, 10, [0, 0, 0], [1, 0, 0]), /^toUs/);
  refuses(() => world.fly(0, 10, [0, 0, 0], [1, 0]), /^way/);
  world.dispose();
  refuses(asks([0, 0, 0], {}), /disposed/);
});
