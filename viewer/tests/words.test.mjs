// Names, addresses, places and files: what the page reads from texts, and writes.

import assert from "node:assert/strict";
import test from "node:test";
import { addressFrom, fragmentOf } from "../build/address.js";
import { transformSize } from "../build/motion/chain.js";
import { limbsOf, shortNames } from "../build/motion/limbs.js";
import { carried, placeFrom, placeOption, placeWith, wrapped, yawTowards } from "../build/motion/placing.js";
import { csvOf } from "../build/panels/csv.js";
import { linesOfPerson, personOf, placeOf, storyOfRay, storyOfTouch } from "../build/panels/words.js";

test("limbs are told by the names of many exporters, and else by the parent", () => {
  const cases = [
    ["mixamorig:Hips", "trunk"], ["mixamorig:LeftHandIndex1", "left arm"], ["mixamorig:RightUpLeg", "right leg"], ["Neck1", "trunk"],
    ["LeftToeBase", "left leg"], ["RThumb", "right arm"], ["Foot.L", "left leg"], ["upper_arm_R", "right arm"], ["l_foot", "left leg"],
    ["RightShoulder", "right arm"], ["LHipJoint", "left leg"], ["Bip01 L Calf", "left leg"], ["Head", "trunk"],
  ];
  const found = limbsOf(cases.map(([name]) => ({ name, parent: -1 })));
  cases.forEach(([name, limb], i) => assert.equal(found[i], limb, name));
  const chain = limbsOf([{ name: "LeftHand", parent: -1 }, { name: "bone_17", parent: 0 }, { name: "bone_18", parent: 1 }, { name: "what", parent: -1 }]);
  assert.deepEqual(chain, ["left arm", "left arm", "left arm", "trunk"]);
});

test("the beginning that most names share is left out, and no other", () => {
  assert.deepEqual(shortNames(["mixamorig:Hips", "mixamorig:LeftArm", "Extra"]), ["Hips", "LeftArm", "Extra"]);
  assert.deepEqual(shortNames(["a:b:Hips", "a:b:Head"]), ["Hips", "Head"]);
  assert.deepEqual(shortNames(["left_Arm", "right_Arm", "Head"]), ["left_Arm", "right_Arm", "Head"]);
  assert.deepEqual(shortNames(["rig:", "rig:Head"]), ["rig:", "Head"]);
  assert.deepEqual(shortNames([]), []);
});

test("an instant goes through its address", () => {
  for (const address of [
    { time: 6.058, link: "LeftFingers", object: "" },
    { time: 0, link: "", object: "" },
    { time: -1.25, link: "mixamorig:Left Hand&Co", object: "lampe à pied #2" },
  ]) assert.deepEqual(addressFrom(fragmentOf(address)), address);
  assert.equal(fragmentOf({ time: 6.058, link: "LeftFingers", object: "" }), "#t=6.058&link=LeftFingers");
  for (const text of ["", "#", "#t=", "#t=soon", "#t=NaN", "#t=Infinity", "#link=Head", "#%%%"]) assert.equal(addressFrom(text), null, text);
});

const near = (a, b) => a.forEach((value, i) => assert.ok(Math.abs(value - b[i]) < 1e-9, `${a} is not ${b}`));

test("a place is read from a document's settings, and given as an option", () => {
  assert.deepEqual(placeFrom("1, 0, -2 m, turned by 90 degrees"), { origin: [1, 0, -2], yawDegrees: 90 });
  assert.deepEqual(placeFrom("1e-05, -0.5, 2.25 m, turned by -12.5 degrees"), { origin: [1e-5, -0.5, 2.25], yawDegrees: -12.5 });
  for (const text of ["", "nowhere"]) assert.deepEqual(placeFrom(text), { origin: [0, 0, 0], yawDegrees: 0 });
  assert.equal(placeOption({ origin: [1.23456, -0.00001, -2], yawDegrees: 89.6 }), "--place 1.235,0,-2,90");
});

test("the place that puts a held point somewhere does, by the library's turn about +Y", () => {
  // A clip's point p stands at origin + R_y(yaw) p: with yaw 90 degrees +z becomes +x.
  const stand = ({ origin, yawDegrees }, [x, y, z]) => {
    const a = (yawDegrees * Math.PI) / 180;
    return [origin[0] + Math.cos(a) * x + Math.sin(a) * z, origin[1] + y, origin[2] - Math.sin(a) * x + Math.cos(a) * z];
  };
  near(stand({ origin: [0, 0, 0], yawDegrees: 90 }, [0, 0, 1]), [1, 0, 0]);
  const foot = [3.5, 0.02, -4], now = { origin: [1, 0.5, 2], yawDegrees: 30 };
  for (const yaw of [0, 30, -135, 180]) {
    const to = placeWith(now, stand(now, foot), [7, -1, 0.5], yaw);
    near(stand(to, foot), [7, -1, 0.5]);
    const world = new Float64Array(transformSize);
    world.set([1, 0, 0, 0, 1, 0, 0, 0, 1, ...stand(now, foot)]);
    const there = carried(world, now, to);
    near([...there.slice(9)], [7, -1, 0.5]);
    const turn = ((yaw - 30) * Math.PI) / 180;
    near([there[0], there[2], there[6], there[8]], [Math.cos(turn), Math.sin(turn), -Math.sin(turn), Math.cos(turn)]);
  }
  assert.ok(Math.abs(yawTowards([1, 0, 0]) - 90) < 1e-9 && yawTowards([0, 5, 2]) === 0);
  assert.deepEqual([wrapped(190), wrapped(-190), wrapped(360), wrapped(180)], [-170, 170, 0, 180]);
});

test("tables become files that spreadsheets read, and do not run", () => {
  assert.equal(csvOf([["a", 1.5, null, true], ['say "no", twice', "two\nlines", "=1+1", -1]]), 'a,1.5,,true\r\n"say ""no"", twice","two\nlines",\'=1+1,-1\r\n');
});

test("names that make a sentence are in it, others are not", () => {
  assert.equal(personOf("dancer.avatar.json"), "dancer");
  assert.equal(personOf("robot_expressive.avatar.json"), "robot");
  for (const name of ["walk.avatar.json", "bandai1_kick_normal_001.avatar.json", ""]) assert.equal(personOf(name), "body");
  assert.equal(placeOf("room.obj"), "room");
  assert.equal(placeOf("kitchen_fatihrmutfak.ply"), "kitchen");
  assert.equal(placeOf("walk.obj"), "scene");
});

test("of the person it is said between when a touch began and ended, and how sure it is", () => {
  const touch = { object: "table", begin: 12.314, end: 12.52, certain: { from: 12.316, to: 12.5 }, beganBefore: false, goesOn: false, growth: null };
  const story = (change) => storyOfTouch({ linkName: "Hand", object: "table", stance: null, person: { ...touch, ...change } }, 10);
  assert.equal(story({}), "Hand surely touched table: began between 2.314 and 2.316 s, ended between 2.500 and 2.520 s.");
  assert.equal(story({ object: "", end: 12.5 }), "Hand surely touched something: began between 2.314 and 2.316 s, ended at 2.500 s.");
  assert.equal(story({ beganBefore: true, goesOn: true }), "Hand surely touched table: had begun by 2.316 s, ended not before 2.500 s.");
  assert.equal(story({ certain: null }), "Hand may have touched table between 2.314 and 2.520 s.");
  assert.equal(story({ certain: null, beganBefore: true }), "Hand may have touched table up to 2.520 s.");
  assert.equal(story({ certain: null, goesOn: true }), "Hand may have touched table from 2.314 s on.");
  assert.equal(story({ certain: null, beganBefore: true, goesOn: true }), "Hand may have touched table at any time.");
  assert.deepEqual(linesOfPerson(touch, 10), ["surely touched table", "began between 2.314 and 2.316 s", "ended between 2.500 and 2.520 s"]);
});

test("a ray through a click is told with what it meets, the nearest first", () => {
  const ray = { time: 3.25, origin: [0, 0, 0], direction: [0, 0, -1], link: "Anna's Head", linkDistance: 2.5, object: "wall", objectDistance: 4 };
  assert.equal(storyOfRay(ray, 1), "At 2.250 s the ray through the pointer meets Anna's Head after 2.500 m, and wall after 4.000 m.");
  assert.equal(storyOfRay({ ...ray, objectDistance: 1 }, 1), "At 2.250 s the ray through the pointer meets wall after 1.000 m, and Anna's Head after 2.500 m behind it.");
  assert.equal(storyOfRay({ ...ray, link: null }, 1), "At 2.250 s the ray through the pointer meets wall after 4.000 m.");
  assert.equal(storyOfRay({ ...ray, object: null }, 1), "At 2.250 s the ray through the pointer meets Anna's Head after 2.500 m.");
});
