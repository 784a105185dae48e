// The in-between motion against formulas of its own: rotation matrices by Rodrigues, no quaternions
// beyond reading the axis of one.

import assert from "node:assert/strict";
import test from "node:test";
import { compose, emptyPose, interpolate, transformSize } from "../build/motion/chain.js";
import { Posture } from "../build/motion/clip.js";
import { CarriedClip } from "../build/motion/carried_clip.js";
import { RecordedClip } from "../build/motion/recorded_clip.js";
import { LiveClip } from "../build/live/live_clip.js";

/** Numbers in [0,1), the same every time. */
function numbers(seed) {
  let state = seed * 2654435761 + 1;
  return () => ((state = (Math.imul(state, 1664525) + 1013904223) >>> 0) / 2 ** 32);
}

const times = (a, b) => [0, 1, 2].map((i) => [0, 1, 2].map((j) => [0, 1, 2].reduce((sum, k) => sum + a[i][k] * b[k][j], 0)));
const transposed = (a) => [0, 1, 2].map((i) => [0, 1, 2].map((j) => a[j][i]));
const applied = (a, v) => a.map((row) => row[0] * v[0] + row[1] * v[1] + row[2] * v[2]);

function rodrigues(axis, angle) {
  const [x, y, z] = axis, c = Math.cos(angle), s = Math.sin(angle), d = 1 - c;
  return [
    [c + x * x * d, x * y * d - z * s, x * z * d + y * s],
    [y * x * d + z * s, c + y * y * d, y * z * d - x * s],
    [z * x * d - y * s, z * y * d + x * s, c + z * z * d],
  ];
}

/** Axis and angle in [0, pi] of a rotation matrix, away from both ends. */
function axisAngle(r) {
  const angle = Math.acos(Math.min(1, Math.max(-1, (r[0][0] + r[1][1] + r[2][2] - 1) / 2)));
  const s = 2 * Math.sin(angle);
  return { angle, axis: [(r[2][1] - r[1][2]) / s, (r[0][2] - r[2][0]) / s, (r[1][0] - r[0][1]) / s] };
}

function randomJoint(random) {
  const axis = [random() - 0.5, random() - 0.5, random() - 0.5], size = Math.hypot(...axis);
  const unit = axis.map((value) => value / size), angle = (random() - 0.5) * 4;
  const q = [Math.cos(angle / 2), ...unit.map((value) => value * Math.sin(angle / 2))];
  const sign = random() < 0.5 ? -1 : 1;
  return { q: q.map((value) => sign * value), matrix: rodrigues(unit, angle), p: [random(), random(), random()] };
}

function poseOf(joints) {
  const pose = emptyPose(joints.length);
  joints.forEach(({ q, p }, i) => {
    pose.rotations.set(q, 4 * i);
    pose.translations.set(p, 3 * i);
  });
  return pose;
}

/** The same motion by matrices: R0 * exp(u log(R0' R1)) down the chain. */
function expected(parents, from, to, u) {
  const world = [];
  parents.forEach((parent, i) => {
    const { axis, angle } = axisAngle(times(transposed(from[i].matrix), to[i].matrix));
    const local = times(from[i].matrix, rodrigues(axis, angle * u));
    const p = from[i].p.map((value, k) => value + u * (to[i].p[k] - value));
    if (parent < 0) world.push({ r: local, p });
    else world.push({ r: times(world[parent].r, local), p: applied(world[parent].r, p).map((value, k) => value + world[parent].p[k]) });
  });
  return world;
}

test("a chain moves as rotation matrices say, whatever the quaternions' signs", () => {
  let worst = 0;
  for (let seed = 1; seed <= 200; ++seed) {
    const random = numbers(seed), parents = Int32Array.from([-1, 0, 1, 1, 3]);
    const from = [...parents].map(() => randomJoint(random)), to = [...parents].map(() => randomJoint(random));
    const u = random(), pose = emptyPose(5), world = new Float64Array(5 * transformSize);
    interpolate(poseOf(from), poseOf(to), u, pose);
    compose(parents, pose, world);
    expected([...parents], from, to, u).forEach(({ r, p }, i) => {
      [...r.flat(), ...p].forEach((value, k) => (worst = Math.max(worst, Math.abs(value - world[i * transformSize + k]))));
    });
  }
  assert.ok(worst < 1e-9, `worst ${worst}`);
  assert.ok(worst > 0, "the oracle shares no code");
});

test("the shorter arc is taken, and a dot product of zero counts as positive", () => {
  const turn = (from, to) => {
    const pose = emptyPose(1), a = emptyPose(1), b = emptyPose(1);
    a.rotations.set(from);
    b.rotations.set(to);
    interpolate(a, b, 0.5, pose);
    return [...pose.rotations];
  };
  const close = (a, b) => a.forEach((value, i) => assert.ok(Math.abs(value - b[i]) < 1e-15));
  close(turn([1, 0, 0, 0], [0, 1, 0, 0]), [Math.SQRT1_2, Math.SQRT1_2, 0, 0]);
  close(turn([1, 0, 0, 0], [-0, -1, 0, 0]), [Math.SQRT1_2, -Math.SQRT1_2, 0, 0]);
  close(turn([1, 0, 0, 0], [-1e-9, 1, 0, 0]), turn([1, 0, 0, 0], [1e-9, -1, 0, 0]));
});

test("tiny turns keep their digits", () => {
  const from = emptyPose(1), to = emptyPose(1), pose = emptyPose(1);
  from.rotations.set([1, 0, 0, 0]);
  to.rotations.set([1, 1e-9, 0, 0]);
  interpolate(from, to, 0.25, pose);
  assert.ok(Math.abs(pose.rotations[1] - 0.25e-9) < 1e-24);
});

const links = [{ name: "root", parent: -1 }];
function track(poseTimes, from, to) {
  const poses = poseTimes.length;
  return {
    poseTimes: Float64Array.from(poseTimes),
    rotations: Float64Array.from({ length: 4 * poses }, (_, i) => (i % 4 === 0 ? 1 : 0)),
    offsets: Float64Array.from([0, 5, 0]), moving: [0],
    movingValues: Float64Array.from({ length: 3 * poses }, (_, i) => (i % 3 === 0 ? i / 3 : 0)),
    from: Uint32Array.from(from), to: Uint32Array.from(to), latencyUs: null, touching: null,
  };
}

test("between poses that no step covers, the earlier pose is held", () => {
  const clip = new RecordedClip(links, track([0, 1, 2, 3, 4], [0, 2], [1, 4]));
  const posture = new Posture(clip);
  const xAt = (time) => (posture.moveTo(time), posture.transform(0)[9]);
  assert.equal(xAt(0.25), 0.25);
  assert.equal(xAt(1.9), 1);
  assert.equal(clip.instantAt(1.9).step, -1);
  assert.equal(xAt(2.5), 2.5); // one step from pose 2 to pose 4: 2 + 2 * 0.25
  assert.equal(clip.instantAt(3.5).step, 1);
  assert.equal(xAt(9), 4);
  assert.equal(clip.poseTimeAt(3.5), 3);
});

/** A body's clip of two random poses at 0 and 1 s, and its links by matrices. */
function randomClip(random, parents) {
  const from = parents.map(() => randomJoint(random)), to = parents.map(() => randomJoint(random));
  const links = parents.map((parent, i) => ({ name: `${i}`, parent }));
  const flat = (key) => Float64Array.from([from, to].flatMap((pose) => pose.flatMap((joint) => joint[key])));
  const clip = new RecordedClip(links, {
    poseTimes: Float64Array.of(0, 1), rotations: flat("q"), offsets: new Float64Array(3 * parents.length),
    moving: parents.map((_, i) => i), movingValues: flat("p"),
    from: Uint32Array.of(0), to: Uint32Array.of(1), latencyUs: null, touching: null,
  });
  return { clip, at: (u) => expected(parents, from, to, u) };
}

test("who is carried goes along with the link that carries, and with what carries that", () => {
  let worst = 0;
  for (let seed = 1; seed <= 50; ++seed) {
    const random = numbers(seed), parents = [-1, 0, 1];
    const [lift, rider, cup] = [randomClip(random, [-1, 0]), randomClip(random, parents), randomClip(random, [-1])];
    const clips = [lift.clip];
    clips[1] = new CarriedClip(rider.clip, [{ from: 0, until: null, avatar: 0, link: 1, links: 2 }], clips);
    clips[2] = new CarriedClip(cup.clip, [{ from: 0.25, until: 0.75, avatar: 1, link: 2, links: 3 }], clips);
    for (const u of [0.1, 0.25, 0.5, 0.74, 0.75]) {
      const above = u < 0.25 || u >= 0.75 ? [] : [lift.at(u)[1], rider.at(u)[2]];
      const want = [...above, cup.at(u)[0]].reduce((outer, inner) => ({
        r: times(outer.r, inner.r), p: applied(outer.r, inner.p).map((value, k) => value + outer.p[k]),
      }));
      const posture = new Posture(clips[2]);
      posture.moveTo(u);
      const got = posture.transform(0);
      posture.moveWithin(0, u);
      assert.deepEqual(posture.transform(0), got);
      [...want.r.flat(), ...want.p].forEach((value, k) => (worst = Math.max(worst, Math.abs(value - got[k]))));
    }
  }
  assert.ok(worst < 1e-9, `worst ${worst}`);
});

test("bodies that carry each other in a circle are no endless loop", () => {
  const clips = [], random = numbers(1);
  for (const i of [0, 1]) clips[i] = new CarriedClip(randomClip(random, [-1]).clip, [{ from: 0, until: null, avatar: 1 - i, link: 0, links: 1 }], clips);
  new Posture(clips[0]).moveTo(0.5);
});

test("one pose alone is held for ever, and no pose is no crash", () => {
  const one = new Posture(new RecordedClip(links, track([7], [], [])));
  one.moveTo(100);
  assert.equal(one.transform(0)[9], 0);
  const none = new RecordedClip(links, track([], [], []));
  assert.equal(none.hasPose, false);
  new Posture(none).moveTo(1);
});

test("a live clip keeps a minute, its steps keep their numbers, a clock that goes back begins anew", () => {
  const clip = new LiveClip(links);
  const step = (t0, t1) => ({ t0, t1, from: poseOf([{ q: [1, 0, 0, 0], p: [t0, 0, 0] }]), to: poseOf([{ q: [1, 0, 0, 0], p: [t1, 0, 0] }]) });
  for (let i = 0; i < 100; ++i) assert.equal(clip.add(step(i, i + 1)), i);
  assert.ok(clip.start >= 38 && clip.start <= 41, `starts at ${clip.start}`);
  assert.equal(clip.spanOf(3), null);
  assert.equal(clip.spanOf(99).t1, 100);
  const posture = new Posture(clip);
  posture.moveTo(77.5);
  assert.equal(posture.transform(0)[9], 77.5);
  clip.add(step(0, 1));
  assert.equal(clip.start, 0);
  assert.equal(clip.end, 1);
});
