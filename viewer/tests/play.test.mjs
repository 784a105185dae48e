// The parts of the page that one reaches into that need no browser.

import assert from "node:assert/strict";
import { test } from "node:test";
import { dancerLinks, handLinks } from "../build/play/viewer/play/src/bodies.js";
import { planesAt } from "../build/play/viewer/play/src/certificate.js";
import { ownRoom } from "../build/play/viewer/play/src/room.js";
import { handJoints, handParents, linksOfHand, trackedHand } from "../build/play/bindings/wasm/host/webxr_hand.js";
import { localPose, poseRoom } from "../build/play/bindings/wasm/host/frames.js";
import { compose, pointAt, transformSize } from "../build/motion/chain.js";

test("of a certificate, the planes whose span contains the instant", () => {
  const text = "step 0\nlink 2\nlss 0\nspan 1 0\nplane 0 2 0 4\nspan 1 1\nplane 1 0 0 3\nplane 0 0 -1 5\n";
  assert.deepEqual(planesAt(text, 2, 0.25), [{ link: 2, normal: [0, 1, 0], offset: 2 }]);
  assert.deepEqual(planesAt(text, 2, 0.75).map(({ offset }) => offset), [3, 5]);
  assert.equal(planesAt(text, 2, 0.5).length, 3);
  assert.deepEqual(planesAt("", 0, 0.5), []);
});

/** 25 joints at random places, turned at random. */
function randomHand(seed) {
  let state = seed;
  const random = () => (state = (state * 16807) % 2147483647) / 2147483647 - 0.5;
  const { frames, radii } = trackedHand();
  handJoints.forEach((_, joint) => {
    const rotation = [random(), random(), random(), random()], length = Math.hypot(...rotation);
    frames.rotations.set(rotation.map((value) => value / length), 4 * joint);
    frames.places.set([random(), random(), random()], 3 * joint);
    radii[joint] = 0.005 + 0.01 * (random() + 0.5);
  });
  return { frames, radii };
}

test("a tracked hand has 25 joints, and its pose puts each back where it is tracked", () => {
  assert.equal(handJoints.length, 25);
  assert.ok(handJoints.every(({ parent }, joint) => parent < joint));
  for (let seed = 1; seed < 20; ++seed) {
    const hand = randomHand(seed), { frames, radii } = hand, pose = localPose(handParents, frames, poseRoom(25)), world = new Float64Array(transformSize * 25);
    compose(handParents, pose, world);
    handJoints.forEach((_, joint) => {
      for (let i = 0; i < 3; ++i) assert.ok(Math.abs(world[transformSize * joint + 9 + i] - frames.places[3 * joint + i]) < 1e-12);
    });
    // Each bone ends at the next joint, and each joint's ball is in one of its link's capsules.
    linksOfHand(hand).forEach(({ lss }, joint) => {
      const children = handJoints.flatMap(({ parent }, child) => (parent === joint ? [child] : []));
      children.forEach((child, bone) => {
        const end = pointAt(world, transformSize * joint, lss[bone].b);
        for (let i = 0; i < 3; ++i) assert.ok(Math.abs(end[i] - frames.places[3 * child + i]) < 1e-12);
      });
      assert.ok(lss.some(({ a, radius }) => Math.hypot(...a) === 0 && radius >= radii[joint]));
    });
  }
});

test("the room and the bodies that the page brings", () => {
  const { positions, indices, objects, objectNames } = ownRoom();
  assert.equal(indices.length, 3 * objects.length);
  assert.ok(indices.every((vertex) => vertex < positions.length / 3));
  assert.deepEqual(new Set(objects), new Set(objectNames.keys()));
  assert.ok(objectNames.includes("board of 4 mm"));
  for (const links of [handLinks(), dancerLinks()]) {
    const names = links.map(({ name }) => name);
    assert.equal(new Set(names).size, links.length);
    links.forEach(({ parent }, link) => assert.ok(parent === null || names.indexOf(parent) < link));
  }
});
