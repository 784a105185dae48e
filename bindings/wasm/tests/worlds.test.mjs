// Moving worlds and solid avatars in them, through foretouch.js: the native program's events, the
// examples' lines, what plain arithmetic says of balls, doors and presses, and refusals in words.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import { Foretouch, ForetouchError, stillScene } from "../foretouch.js";
import { skip } from "./native.mjs";
import { moduleWorld, nativeEvents } from "./world_file.mjs";

const module = readFileSync(new URL("../foretouch.wasm", import.meta.url));
const ft = await Foretouch.load(module);

const tickUs = 10_000, skin = 2e-3, tolerance = 1e-4, radius = 0.05;
const ball = (name, size) => ft.avatar([{ name, parent: null, offset: [0, 0, 0], lss: [{ a: [0, 0, 0], b: [0, 0, 0], radius: size }] }]);
/** A square across the x axis. */
const sheet = (x) => ft.scene({ positions: [x, -2, -2, x, 2, -2, x, 2, 2, x, -2, 2], indices: [0, 1, 2, 0, 2, 3], objectNames: ["sheet"] });
const at = (x, y = 0) => ({ rotations: [1, 0, 0, 0], translations: [x, y, 0] });
const exact = ({ timeUs, timeFraction }) => timeUs + timeFraction;
const near = (value, expected, within) => assert.ok(Math.abs(value - expected) <= within, `${value} beside ${expected}`);
const refuses = (call, words) => assert.throws(call, (error) => error instanceof ForetouchError && words.test(error.message));

/** A hand of 5 cm before a wall at x = 1. */
function room(options = {}) {
  const world = ft.solidWorld(sheet(1), 0, { tolerance, ...options });
  return { world, hand: world.add(ball("hand", radius), { skin }) };
}

const outputOf = (example, ...given) =>
  execFileSync(process.execPath, ["--no-experimental-fetch", fileURLToPath(new URL(`../example/${example}.mjs`, import.meta.url)), ...given], { encoding: "utf8" });
const recorded = (name) => readFileSync(new URL(`../../../tests/examples/${name}`, import.meta.url), "utf8");

for (const example of ["vr_hands", "swinging_door"]) {
  test(`${example}: the lines of the native program`, () => assert.equal(outputOf(example), recorded(`${example}.txt`)));
}

test("vr_hands: hands meet and leave where plain arithmetic has them shown", () => {
  const judge = fileURLToPath(new URL("../../../tests/examples/vr_hands_judge.py", import.meta.url));
  execFileSync("python3", [judge], { input: outputOf("vr_hands", "ways") });
});

test("a dancer, a door and a ball: the events of the native program", { skip }, () => {
  const { header, events: theirs } = nativeEvents();
  const { world, follower, room, dancer, bodies, triggers } = moduleWorld(ft);
  assert.equal(world.knownUntilUs, 1e6 * header.until);
  const told = follower.follow(world.knownUntilUs);
  const nameOf = ({ body, link, object }) => {
    if (body === stillScene) return room.objectNames[object];
    return `${bodies[body]} ${body === 0 ? dancer.links[link].name : ""}`;
  };
  const theirNameOf = ({ body, link, object }) => (body === undefined ? object : `${body} ${link ?? ""}`);
  /** What each two do, in order: the kinds, with all that is told. */
  const byPair = (events, pairOf) => {
    const pairs = new Map();
    for (const event of events) pairs.set(pairOf(event), [...(pairs.get(pairOf(event)) ?? []), event]);
    return pairs;
  };
  const ours = byPair(told.events.filter(({ a, b }) => a.body < 3 && b.body < 3), ({ a, b }) => `${nameOf(a)} and ${nameOf(b)}`);
  const native = byPair(theirs.filter(({ trigger }) => trigger === undefined), ({ a, b }) => `${theirNameOf(a)} and ${theirNameOf(b)}`);
  assert.deepEqual(new Set(ours.keys()), new Set(native.keys()));
  let count = 0;
  for (const [pair, events] of ours) {
    assert.deepEqual(events.map(({ kind }) => kind), native.get(pair).map(({ event }) => event), pair);
    events.forEach((our, i) => {
      const their = native.get(pair)[i];
      // Either may report an event anywhere within the tolerance (docs/machines.md).
      near(exact(our), their.utime + their.fraction, 1000);
      near(our.separation, their.separation, 2e-3);
      for (const axis of [0, 1, 2]) near(our.normal[axis], their.normal[axis], 0.05);
      near(our.approachSpeed, their.approach.speed, 0.05);
      if (Number.isFinite(our.effectiveMass)) near(our.effectiveMass / their.effective_mass, 1, 0.05);
      else assert.equal(their.effective_mass, null);
      assert.equal(our.cause, their.cause ?? "apart");
      ++count;
    });
  }
  assert.ok(count > 150, `${count} events`);
  const inside = theirs.filter(({ trigger }) => trigger !== undefined);
  assert.deepEqual(told.triggers.map(({ kind, trigger, body }) => [kind, triggers[trigger], bodies[body]]), inside.map(({ event, trigger, who }) => [event, trigger, who.body]));
  told.triggers.forEach((our, i) => near(exact(our), inside[i].utime + inside[i].fraction, 1000));
});

test("a window has the first contact of each two, at its instant", () => {
  const world = ft.world(sheet(1), { tolerance });
  const moving = world.add(ball("ball", radius)), door = world.add(sheet(0));
  assert.equal(world.knownUntilUs, null);
  world.push(moving, 0, at(0.5));
  world.push(door, 0, at(0));
  assert.equal(world.bodies, 2);
  world.push(moving, 1_000_000, at(1.5));
  assert.equal(world.knownUntilUs, 0);
  assert.equal(world.waitsFor, door);
  world.push(door, 1_000_000, at(0.6));
  const { contacts, silent, counters } = world.contacts(0, 1_000_000);
  assert.equal(contacts.length, 1);
  const [{ verdict, a, b, normal, separation, isAssumed }] = contacts;
  assert.deepEqual([verdict, a.body, a.link, b.body, b.object, isAssumed], ["contact", moving, 0, stillScene, 0, false]);
  assert.ok(exact(contacts[0]) <= 450_000 && exact(contacts[0]) >= 450_000 - 1e6 * tolerance - 1);
  assert.ok(separation <= tolerance && separation >= 0);
  assert.deepEqual(normal, [-1, 0, 0]);
  near(b.point[0], 1, 1e-12);
  assert.deepEqual(silent, []);
  assert.ok(counters.bodies > 0 && counters.spans > 0);
  world.askStill(0, false);
  assert.deepEqual(world.contacts(0, 1_000_000).contacts, []);
  world.forgetBefore(500_000);
  refuses(() => world.contacts(0, 1_000_000), /forgotten|before/);
});

test("a body that is silent is said to be", () => {
  const world = ft.world(sheet(1));
  const still = world.add(ball("ball", radius), { whenSilent: "hold-still" }), moving = world.add(ball("ball", radius), { group: 3 });
  world.push(still, 0, at(0));
  world.push(moving, 0, at(-0.5));
  world.push(moving, 1_000_000, at(0.5));
  const { contacts, silent } = world.contacts(0, 1_000_000);
  assert.deepEqual(silent, [{ body: still, sinceUs: 0, takenTo: "hold-still" }]);
  assert.ok(contacts[0].isAssumed);
  world.ask(0, 3, false);
  assert.deepEqual(world.contacts(0, 1_000_000).contacts, []);
});

test("who enters, stays and leaves, and how hard", () => {
  const world = ft.world(sheet(1), { tolerance });
  const moving = world.add(ball("ball", radius));
  const follower = world.follower(0);
  follower.weigh(moving, 2);
  for (let i = 0; i <= 200; ++i) world.push(moving, tickUs * i, at(0.5 + 0.48 * Math.sin((Math.PI * i) / 100)));
  const first = follower.follow(500_000);
  assert.deepEqual(first.events.map(({ kind }) => kind), ["enter"]);
  const [enter] = first.events;
  assert.ok(enter.approachLower <= enter.approachSpeed && enter.approachSpeed <= enter.approachUpper && enter.approachLower > 0);
  near(enter.effectiveMass, 2, 1e-9);
  assert.equal(enter.points.length > 0 && enter.points.length <= 4, true);
  assert.deepEqual(follower.open.map(({ kind, sinceUs, goesOn }) => [kind, sinceUs, goesOn]), [["contact", enter.timeUs, true]]);
  const rest = follower.follow(2_000_000);
  assert.deepEqual([rest.fromUs, rest.toUs, follower.followedUntilUs], [500_000, 2_000_000, 2_000_000]);
  assert.deepEqual(rest.events.map(({ kind, cause, sinceUs }) => [kind, cause, sinceUs]), [["leave", "apart", enter.timeUs]]);
  assert.ok(rest.parts[0].beganBefore && !rest.parts[0].goesOn);
  assert.deepEqual(follower.open, []);
});

test("volumes tell who is in them", () => {
  const world = ft.world();
  const moving = world.add(ball("ball", radius)), other = world.add(ball("ball", radius));
  const { triggers } = world, box = triggers.addBox([0.2, 1, 1]), sphere = triggers.addSphere(0.3, { byLink: true });
  assert.deepEqual([box, sphere, triggers.body(box), triggers.body(sphere)], [0, 1, 2, 3]);
  triggers.stand(box, 0, at(1));
  refuses(() => world.attach(triggers.body(sphere), moving, 0, at(0)), /not there/);
  world.push(moving, 0, at(0));
  world.attach(triggers.body(sphere), moving, 0, at(0));
  triggers.watch(box, moving);
  assert.deepEqual(triggers.occupants, []);
  const follower = world.follower(0);
  for (let i = 0; i <= 100; ++i) {
    if (i > 0) world.push(moving, tickUs * i, at(0.02 * i));
    world.push(other, tickUs * i, at(1));
  }
  const half = follower.follow(500_000);
  assert.deepEqual(half.triggers.map(({ kind, trigger, body, link }) => [kind, trigger, body, link]), [["enter", sphere, other, 0], ["enter", box, moving, 0]]);
  near(exact(half.triggers[1]), 375_000, 1000);
  assert.deepEqual(triggers.occupants.map(({ trigger, body, isUnresolved }) => [trigger, body, isUnresolved]), [[box, moving, false], [sphere, other, false]]);
  assert.deepEqual(follower.follow(1_000_000).triggers.map(({ kind, trigger }) => [kind, trigger]), [["leave", box], ["leave", sphere]]);
});

test("how deep, and which way out", () => {
  const world = ft.world(sheet(1));
  const one = world.add(ball("ball", 0.2)), other = world.add(ball("ball", 0.1));
  world.push(one, 0, at(0));
  world.push(other, 0, at(0.25));
  const { lower, upper, wayOut, isCertified, link } = world.depth(0, other, one);
  assert.ok(isCertified && lower <= 0.05 && upper >= 0.05 && upper - lower < 1e-6);
  assert.ok(wayOut[0] > 0.049);
  assert.equal(link, 0);
  assert.equal(world.depth(0, other).upper, 0);
});

test("a hand enters a wall that stops it, and leaves it", () => {
  const { world, hand } = room();
  const events = [];
  for (let k = 1; k <= 100; ++k) {
    const [{ body, tick, crushes }] = world.tick(tickUs * k, [{ body: hand, pose: at(0.5 + 0.012 * Math.min(k, 100 - k)) }]);
    assert.equal(body, hand);
    assert.ok(tick.isCertified && tick.shown.translations[0] <= 1 - radius);
    assert.deepEqual(crushes, []);
    if (k === 50) {
      assert.equal(tick.contacts[0].triangle >= 0, true);
      near(tick.contacts[0].push, 1.1 - (1 - radius), 0.01);
    }
    if (tick.wayCount > 0) assert.deepEqual(world.way(hand, tick.wayCount - 1).pose, tick.shown);
    events.push(...world.follow().events);
    world.world.forgetBefore(tickUs * k);
  }
  assert.deepEqual(events.map(({ kind, a, b }) => [kind, a.body, b.body, b.object]), [["enter", hand, stillScene, 0], ["leave", hand, stillScene, 0]]);
  // It reaches to its skin: tracked at 0.5 + 1.2 m/s.
  const reachedUs = ((1 - radius - skin - tolerance - 0.5) / 1.2) * 1e6;
  assert.ok(exact(events[0]) >= reachedUs - 1 && exact(events[0]) <= reachedUs + tickUs, `${exact(events[0])} after ${reachedUs}`);
  assert.equal(world.timeUs, 100 * tickUs);
});

test("a door pushes it, a press crushes it", () => {
  const { world, hand } = room();
  const door = world.world.add(sheet(0));
  world.world.push(door, 0, at(-1));
  const kinds = [], crushes = [];
  let pushed = 0, shown = 0, height = 0;
  for (let k = 1; k <= 120; ++k) {
    // The door also goes sideways, at 0.5 m/s.
    world.world.push(door, tickUs * k, at(Math.min(-1 + 0.02 * k, 0.94), 0.005 * k));
    const [told] = world.tick(tickUs * k, [{ body: hand, pose: at(0) }]);
    kinds.push(...world.follow().events.map(({ kind, b }) => [kind, b.body]));
    const rise = told.tick.shown.translations[1] - height;  // where the press begins to crush it, 0.1 mm
    height += rise;
    for (const contact of told.contacts) {
      assert.deepEqual([contact.body, contact.link, contact.object], [door, 0, 0]);
      near(contact.normal[0], 1, 1e-9);
      near(contact.slipSpeed, 0.5 - rise / (tickUs * 1e-6), 1e-6);
      pushed = Math.max(pushed, contact.push);
    }
    crushes.push(...told.crushes);
    shown = told.tick.shown.translations[0];
  }
  assert.deepEqual(kinds[0], ["enter", door]);
  assert.ok(pushed > 0 && shown > 0.9);
  assert.deepEqual(new Set(crushes.map(({ body, link, isOver }) => `${body} ${link} ${isOver}`)), new Set([`${door} 0 false`]));
  assert.ok(crushes.at(-1).depth > 0);
});

test("a ball in its hand stops it, and is let go of", () => {
  const { world, hand } = room();
  const held = world.world.add(ball("ball", 0.03));
  for (const us of [0, tickUs]) world.world.push(held, us, at(0.5, 0.1));
  world.tick(tickUs, [{ body: hand, pose: at(0.5) }]);
  world.world.attach(held, hand, tickUs, at(0, 0.1));
  let told;
  for (let k = 2; k < 80; ++k) [told] = world.tick(tickUs * k, [{ body: hand, pose: at(0.5 + 0.01 * k) }]);
  assert.deepEqual([told.tools, told.looseTools, told.letGo], [[held], [], []]);
  assert.ok(told.tick.shown.translations[0] + 0.03 <= 1);
  const there = told.tick.shown.translations[0];
  world.world.detach(held, 79 * tickUs, at(there, 0.1));
  world.world.push(held, 80 * tickUs, at(there, 0.5));
  [told] = world.tick(80 * tickUs, []);
  assert.deepEqual(told.tools, []);
});

test("lost trackers, targets that are left out, and reaching to the surface", () => {
  const { world, hand } = room({ reach: "surface" });
  const guest = world.add(ball("guest", radius));
  world.tick(tickUs, [{ body: hand, pose: at(0.5) }]);
  const [lost] = world.tick(2 * tickUs, [{ body: hand, pose: at(0.7), isTracked: [false] }]);
  assert.equal(lost.tick.joints[0].state, "lost");
  assert.equal(lost.tick.shown.translations[0], 0.5);
  assert.deepEqual(world.tick(3 * tickUs, []).map(({ body }) => body), [hand]);
  for (let k = 4; k < 60; ++k) world.tick(tickUs * k, [{ body: hand, pose: at(0.5 + 0.012 * k) }, { body: guest, pose: at(0, 1) }]);
  assert.deepEqual(world.tick(60 * tickUs, []).map(({ body }) => body), [hand, guest]);
  assert.deepEqual(world.follow().events, []);
});

test("the same poses, the same bytes", { skip }, () => {
  const run = () => {
    const { follower, world } = moduleWorld(ft);
    return JSON.stringify(follower.follow(world.knownUntilUs));
  };
  assert.equal(run(), run());
});

test("what cannot be used of a world is refused in words", async () => {
  const world = ft.world(sheet(1)), body = world.add(ball("ball", radius)), prop = world.add(sheet(0));
  refuses(() => ft.world({}), /still/);
  refuses(() => ft.world(null, { tolerance: -1 }), /^tolerance/);
  refuses(() => ft.world(null, { tolerance: "1" }), /^tolerance: expected a number/);
  refuses(() => ft.world(null, { tolerence: 1 }), /'tolerence'/);
  refuses(() => ft.world(null, { size: 1 }), /'size'/);
  refuses(() => ft.world(null, { workPerPair: 0.5 }), /^workPerPair/);
  refuses(() => world.add({}), /shape/);
  refuses(() => world.add(ball("ball", radius), { group: 32 }), /^group/);
  refuses(() => world.add(ball("ball", radius), { group: 1.5 }), /^group/);
  refuses(() => world.add(ball("ball", radius), { whenSilent: "sleep" }), /^whenSilent: expected one of wait/);
  refuses(() => world.push(7, 0, at(0)), /body/);
  refuses(() => world.push(Number.NaN, 0, at(0)), /body/);
  refuses(() => world.push("0", 0, at(0)), /body/);
  refuses(() => world.push(body, 0.5, at(0)), /^timeUs: expected whole microseconds/);
  refuses(() => world.push(body, 2 ** 60, at(0)), /^timeUs/);
  refuses(() => world.push(body, 0, at(Number.NaN)), /^pose/);
  refuses(() => world.push(body, 0, { rotations: [1, 0, 0, 0], translations: [0] }), /^pose: expected 1 joints/);
  refuses(() => world.push(body, 0, null), /^pose/);
  refuses(() => world.push(body, 0, { rotations: [1, 1, 0, 0], translations: [0, 0, 0] }), /^pose/);
  world.push(body, 10, at(0));
  world.push(prop, 10, at(0.5));
  refuses(() => world.push(body, 10, at(0)), /after/);
  refuses(() => world.push(body, 5, at(0)), /after/);
  world.push(body, 20, at(0));
  world.push(prop, 20, at(0.5));
  refuses(() => world.attach(body, body, 10, at(0)), /./);
  refuses(() => world.attach(body, 9, 10, at(0)), /body|carrier/);
  refuses(() => world.attach(body, prop, 20, at(0), { link: 3 }), /link/);
  refuses(() => world.detach(body, 10, at(0)), /carrie[rd]/);
  refuses(() => world.ask(0, 40, true), /group/);
  refuses(() => world.contacts(0, 100), /./);
  refuses(() => world.contacts(10, 10), /./);
  refuses(() => world.depth(10, 5), /./);
  refuses(() => world.depth(Number.NaN, body), /^timeUs/);
  refuses(() => world.depth(10, body, body), /./);
  const follower = world.follower(0);
  refuses(() => world.follower(0, { cutUs: -1 }), /^cutUs/);
  refuses(() => world.follower(0, { threads: 400 }), /threads/);
  refuses(() => world.follower(Number.POSITIVE_INFINITY), /^fromUs/);
  refuses(() => follower.weigh(9, 1), /body/);
  refuses(() => follower.weigh(body, -1), /./);
  refuses(() => follower.weigh(prop, 1), /avatar/);
  refuses(() => follower.weigh(prop, 1, { center: [0, 0, 0] }), /center and an inertia/);
  refuses(() => follower.follow(1e9), /./);
  world.follower(5);
  refuses(() => follower.follow(10), /another one has taken its place/);
  refuses(() => world.triggers.addBox([1, 0, 1]), /./);
  refuses(() => world.triggers.addBox([1, 1]), /^halfExtents: expected three numbers/);
  refuses(() => world.triggers.addSphere(Number.NaN), /./);
  refuses(() => world.triggers.addMesh(sheet(0)), /edge/);
  refuses(() => world.triggers.stand(3, 0, at(0)), /./);
  refuses(() => world.triggers.watch(0, body), /./);
  refuses(() => world.triggers.body(0), /trigger/);
  const elsewhere = await Foretouch.load(module);
  refuses(() => world.add(elsewhere.scene({ positions: [0, 0, 0, 1, 0, 0, 0, 1, 0] })), /shape: expected one that this module has made/);
  // Nothing of this has changed it.
  assert.equal(world.knownUntilUs, 20);
  assert.equal(world.bodies, 2);
  world.dispose();
  world.dispose();
  refuses(() => world.push(body, 20, at(0)), /disposed/);
});

test("what cannot be used of a solid world is refused in words", () => {
  const { world, hand } = room();
  const prop = world.world.add(sheet(0));
  refuses(() => ft.solidWorld(sheet(1), 0, { reach: "far" }), /^reach/);
  refuses(() => ft.solidWorld(sheet(1), 2 ** 60), /^beginUs/);
  refuses(() => ft.solidWorld(null, 0), /still/);
  refuses(() => world.add(ball("hand", 0.1), { skin: -1 }), /skin|tolerance/);
  refuses(() => world.add(ball("hand", 0.1), { maySnap: true }), /maySnap|may_snap/);
  refuses(() => world.add(ball("hand", 0.1), { skim: 1 }), /'skim'/);
  refuses(() => world.add(ball("hand", 0.1), { feet: [true, false] }), /feet/);
  refuses(() => world.tick(0, [{ body: hand, pose: at(0.5) }]), /^timeUs/);
  refuses(() => world.tick(20_000_000, [{ body: hand, pose: at(0.5) }]), /^timeUs/);
  refuses(() => world.tick(tickUs, [{ body: 7, pose: at(0.5) }]), /body/);
  refuses(() => world.tick(tickUs, [{ body: prop, pose: at(0.5) }]), /target|solid/);
  refuses(() => world.tick(tickUs, [{ body: hand, pose: at(Number.NaN) }]), /target|pose/);
  refuses(() => world.tick(tickUs, [{ body: hand, pose: at(0) }, { body: hand, pose: at(0) }]), /./);
  refuses(() => world.way(hand, 0), /target/);
  assert.equal(world.timeUs, 0);
  world.world.push(prop, 0, at(-1));
  refuses(() => world.tick(tickUs, [{ body: hand, pose: at(0.5) }]), /./);
  world.world.push(prop, tickUs, at(-1));
  const [tick] = world.tick(tickUs, [{ body: hand, pose: at(0.5) }]);
  refuses(() => world.way(hand, tick.tick.wayCount), /^index/);
  refuses(() => world.way(prop, 0), /./);
  refuses(() => world.tick(tickUs, []), /^timeUs/);
  world.world.push(hand, 2 * tickUs, at(0));
  refuses(() => world.tick(2 * tickUs, []), /ticks alone move it/);
  assert.equal(world.timeUs, tickUs);
});
