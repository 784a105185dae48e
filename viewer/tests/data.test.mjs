// Documents and events as they may come, right and wrong.

import assert from "node:assert/strict";
import test from "node:test";
import { decodeDocument } from "../build/data/decode.js";
import { decodeStatus, decodeStep } from "../build/data/events.js";
import { allContacts, contactsAt, firstAfter, longestStep } from "../build/contacts/contact.js";
import { discreteCount, isSeenAtPose, touchingLinks } from "../build/contacts/discrete.js";
import { byBadness, worstBy } from "../build/contacts/feet.js";
import { openingOf } from "../build/contacts/opening.js";
import { countPerson, joinedPerson } from "../build/contacts/person.js";
import { mostTelling } from "../build/contacts/telling.js";
import { Model } from "../build/model.js";
import { RecordedClip } from "../build/motion/recorded_clip.js";
import { countTouches, matches, mergedTouches, recordedStays, recordedTouches, touchOfRow } from "../build/contacts/touch.js";
import { densityOf, nearestTouch, rowsOf, ticks, zoomed } from "../build/timeline/rows.js";
import { f32, f64, inspection, live, pageWith, replay, stepEvent, u16, u32, withPerson, withTouches } from "./fixture.mjs";

const whole = replay({ seconds: 2, rate: 10 });
const touched = withTouches(whole);
const copy = () => structuredClone(touched);
const decoded = (value) => decodeDocument(JSON.stringify(value));

/** The same, followed from enter to leave, with a trigger. */
const followed = () => {
  const value = world(), [avatar] = value.avatars;
  value.avatars.push({ ...structuredClone(avatar), name: "zone", contacts: [], lss: [], outline: f32([0, 0, 0, 1, 0, 0]) });
  Object.assign(value.touches[0], { approach: { speed: 1.5, lower: -0.25, upper: null }, effective_mass: 4, impulse: 6 });
  value.touches.push({ link: 2, object: "everybody", begin: 1, end: 1.5, rows: [], unresolved: "gap" });
  value.stays = [{ trigger: 2, avatar: 1, link: 3, begin: 0.2, end: 0.9, begins: "inside", ends: "open" }];
  return value;
};

test("strengths, what is unresolved and who is in a trigger are read, and belong together", () => {
  const view = decoded(followed());
  assert.deepEqual(view.touches[0].strength, { speed: 1.5, lower: -0.25, upper: null, effectiveMass: 4, impulse: 6 });
  assert.equal(view.touches.at(-1).unresolved, "gap");
  assert.equal(view.touches[1].strength, null);
  assert.deepEqual([...view.avatars[2].outline], [0, 0, 0, 1, 0, 0]);
  assert.deepEqual(view.stays, [{ trigger: 2, avatar: 1, link: 3, begin: 0.2, end: 0.9, begins: "inside", ends: "open", isUnresolved: false }]);
  assert.deepEqual(decoded(whole).stays, []);

  const wrongly = (change, expected) => {
    const value = followed();
    change(value);
    assert.throws(() => decoded(value), expected);
  };
  wrongly((v) => (v.stays[0].trigger = 1), /no trigger/);
  wrongly((v) => (v.stays[0].trigger = 3), /trigger/);
  wrongly((v) => (v.stays[0].link = 16), /link/);
  wrongly((v) => (v.stays[0].end = 0.1), /end/);
  wrongly((v) => (v.stays[0].ends = "gone"), /ends/);
  wrongly((v) => (v.touches[0].approach.speed = "fast"), /speed/);
  wrongly((v) => (v.avatars[2].outline = f32([0, 0, 0, 1])), /within a line/);
});

test("a trigger has a row of its own, and neither that nor what is unresolved counts as a touch", () => {
  const view = decoded(followed()), clips = view.avatars.map((avatar) => new RecordedClip(avatar.links, avatar.track));
  const touches = recordedTouches(view.touches, view.avatars, allContacts(view.avatars, clips));
  const bars = [...touches, ...recordedStays(view.stays, view.avatars)];
  assert.equal(countTouches(bars).all + countTouches(bars).ground, view.touches.length - 1);
  const rows = rowsOf(bars, view.avatars, "link", new Set());
  assert.deepEqual(rows.filter(({ touches }) => touches.some(({ isStay }) => isStay)).map(({ avatar, link }) => [avatar, link]), [[2, 0]]);
  const groups = rowsOf(bars, view.avatars, "limb", new Set()).filter(({ isHeading }) => isHeading).map(({ name }) => name);
  assert.equal(groups.at(-1), "triggers");
});

test("documents of every kind are read", () => {
  const view = decoded(whole);
  assert.equal(view.kind, "replay");
  assert.equal(view.avatars[0].links.length, 16);
  assert.equal(view.avatars[0].track.poseTimes[20], 2);
  assert.equal(view.scene.indices.length, 3 * whole.scene.triangles_in_file);
  assert.equal(decoded(inspection()).avatars[0].contacts.length, 0);
  assert.equal(decoded(live()).events, "/events");
});

/** As the report of a world has it: two bodies, the second one carried by the first, who touch. */
const world = () => {
  const value = copy(), [avatar] = value.avatars;
  value.kind = "world";
  value.avatars = [avatar, { ...structuredClone(avatar), contacts: [], carried: [{ from: 0.5, until: 1, avatar: 0, link: 6 }] }];
  Object.assign(avatar.contacts[0], { other: 3, other_avatar: 1, object: "other: Head" });
  const touch = value.touches.find(({ rows }) => rows.includes(0));
  Object.assign(touch, { other: 3, other_avatar: 1, object: "other: Head" });
  return value;
};

test("bodies of a world touch each other, and carry each other", () => {
  const view = decoded(world());
  assert.equal(view.kind, "world");
  assert.deepEqual(view.avatars[1].carried, [{ from: 0.5, until: 1, avatar: 0, link: 6, links: 16 }]);
  assert.deepEqual(decoded(whole).avatars[0].carried, []);
  const { contacts } = shown(world()), touches = recordedTouches(view.touches, view.avatars, contacts);
  const met = touches.filter(({ otherAvatar }) => otherAvatar === 1);
  assert.equal(met.length, 1);
  assert.equal(met[0].isOwn, false);
  assert.equal(met[0].object, "other: Head");
  assert.equal(met[0].rows[0].otherLink, 3);
  const wrongly = (change, says) => {
    const value = world();
    change(value);
    assert.throws(() => decoded(value), says);
  };
  wrongly((v) => (v.avatars[1].carried[0].avatar = 2), /one that carries/);
  wrongly((v) => (v.avatars[1].carried[0].link = 16), /one that carries/);
  wrongly((v) => (v.avatars[1].carried[0].until = 0.4), /until/);
  wrongly((v) => (v.avatars[0].contacts[0].other = 16), /other side of a contact/);
  wrongly((v) => (v.avatars[0].contacts[0].other_avatar = 2), /other side of a contact/);
  wrongly((v) => (v.touches.find(({ other_avatar }) => other_avatar === 1).other = 16), /other/);
});

/** As a solid avatar's report has it: what is shown, and beside it what was tracked. */
const solid = () => {
  const value = copy(), [avatar] = value.avatars;
  avatar.tracked = structuredClone(avatar.track);
  avatar.solid = { times: f64([0, 1, 2]), states: u16([1, 3, 4]), deviations: f64([0, 0.02, 0.5]) };
  Object.assign(avatar.contacts[0], { push: 0.01, slip: 0.3 });
  delete avatar.contacts[0].missed_by_poses;
  return value;
};

test("a solid avatar has two bodies, a state a tick, and pushes", () => {
  const view = decoded(solid()), [avatar] = view.avatars;
  assert.deepEqual([...avatar.solid.states], [1, 3, 4]);
  assert.equal(avatar.solid.deviations[2], 0.5);
  assert.deepEqual([...avatar.tracked.poseTimes], [...avatar.track.poseTimes]);
  assert.equal(avatar.contacts[0].push, 0.01);
  assert.equal(avatar.contacts[1].push, null);
  const other = decoded(whole).avatars[0];
  assert.equal(other.tracked, null);
  assert.equal(other.solid, null);
  const wrongly = (change, says) => {
    const value = solid();
    change(value.avatars[0]);
    assert.throws(() => decoded(value), says);
  };
  wrongly((a) => (a.solid.states = u16([1, 3, 7])), /solid\.states.* names number 7/);
  wrongly((a) => (a.solid.states = u16([1, 3])), /solid\.states/);
  wrongly((a) => (a.solid.times = f64([0, 2, 1])), /does not increase/);
  wrongly((a) => delete a.tracked.rotations, /rotations/);
});

test("unknown keys are ignored, and what may be absent may be", () => {
  const value = copy();
  value.fromTheFuture = { a: 1 };
  value.avatars[0].contacts[0].fromTheFuture = 3;
  delete value.settings;
  delete value.summary;
  delete value.notes;
  delete value.avatars[0].swept;
  delete value.avatars[0].track.latency_us;
  delete value.avatars[0].track.touching_at_poses;
  assert.equal(decoded(value).avatars[0].track.touching, null);
});

/** What is done to a document, and what the sentence must name. */
const wrong = [
  ["format", (v) => (v.format = "other"), /is no foretouch-view document/],
  ["version", (v) => (v.version = 2), /version 2, but this page reads version 1/],
  ["kind", (v) => (v.kind = "film"), /kind is none of/],
  ["title", (v) => delete v.title, /no "title"/],
  ["base64", (v) => (v.scene.positions = { f32: "!!!!" }), /scene\.positions\.f32 is not base64/],
  ["half a number", (v) => (v.scene.positions = { f32: "AAAAAAA=" }), /ends within a number/],
  ["half a vertex", (v) => (v.scene.positions = f32([1, 2, 3, 4])), /ends within a vertex/],
  ["a vertex that is not there", (v) => (v.scene.indices = u32([0, 1, 999999])), /names number 999999/],
  ["half a triangle", (v) => (v.scene.indices = u32([0, 1])), /ends within a triangle/],
  ["NaN", (v) => (v.scene.positions = f32([NaN, 0, 0])), /no number at 0/],
  ["object beyond the end", (v) => (v.scene.objects[0].count = 1e9), /scene\.objects\[0\] ends at/],
  ["bounds the wrong way", (v) => (v.scene.bounds.min = [9, 9, 9]), /ends before it begins/],
  ["parent after child", (v) => (v.avatars[0].links[1].parent = 5), /avatars\[0\]\.links\[1\]\.parent/],
  ["parent of itself", (v) => (v.avatars[0].links[0].parent = 0), /links\[0\]\.parent/],
  ["no links", (v) => (v.avatars[0].links = []), /is empty/],
  ["LSS of no link", (v) => (v.avatars[0].lss[0].link = 16), /lss\[0\]\.link/],
  ["negative radius", (v) => (v.avatars[0].lss[0].radius = -1), /radius is -1/],
  ["times that stand still", (v) => (v.avatars[0].track.pose_times = f64(Array(21).fill(0))), /does not increase/],
  ["too few rotations", (v) => (v.avatars[0].track.rotations = f64([1, 0, 0, 0])), /has 4 numbers, but 1344/],
  ["no rotation", (v) => (v.avatars[0].track.rotations = f64(Array(1344).fill(0))), /is no rotation at 0/],
  ["no unit rotation", (v) => (v.avatars[0].track.rotations = f64(Array(1344).fill(1))), /is no rotation at 0/],
  ["step backwards", (v) => (v.avatars[0].track.steps.to = v.avatars[0].track.steps.from), /goes from pose 0 to pose 0/],
  ["steps over each other", (v) => (v.avatars[0].track.steps = { from: u32([0, 1]), to: u32([3, 4]) }), /before the one before it ends/],
  ["latencies of other steps", (v) => (v.avatars[0].track.latency_us = f64([1])), /has 1 numbers/],
  ["touching backwards", (v) => (v.avatars[0].track.touching_at_poses = { first: u32([1, ...Array(21).fill(0)]), links: u16([0]) }), /goes backwards/],
  ["contact of no step", (v) => (v.avatars[0].contacts[0].step = 99), /contacts\[0\]\.step is 99/],
  ["toi out of range", (v) => (v.avatars[0].contacts[0].toi = 1.5), /toi is 1.5/],
  ["verdict", (v) => (v.avatars[0].contacts[0].verdict = "maybe"), /verdict is none of/],
  ["contact without a point", (v) => delete v.avatars[0].contacts[0].point, /no "point"/],
  ["short vector", (v) => (v.avatars[0].contacts[0].normal = [1, 2]), /is not three numbers/],
  ["text for a number", (v) => (v.avatars[0].id = "0"), /avatars\[0\]\.id is not a whole number/],
  ["touch of no link", (v) => (v.touches[0].link = 16), /touches\[0\]\.link/],
  ["touch of no avatar", (v) => (v.touches[0].avatar = 1), /touches\[0\]\.avatar/],
  ["touch that ends before it begins", (v) => (v.touches[0].end = -9), /touches\[0\]\.end/],
  ["touch of no contact", (v) => (v.touches[0].rows = [1e6]), /rows\[0\]/],
  ["touch that begins otherwise", (v) => (v.touches[0].begins = "late"), /begins is none of/],
  ["check of no state", (v) => (v.checks = [{ name: "a", state: "fine", text: "b" }]), /state is none of/],
  ["list for an object", (v) => (v.scene = []), /scene is not an object/],
];
for (const [name, harm, sentence] of wrong) {
  test(`refused in one sentence: ${name}`, () => {
    const value = copy();
    harm(value);
    assert.throws(() => decoded(value), { name: "Malformed", message: sentence });
  });
}

test("text that is no document is refused", () => {
  for (const text of ["", "{", "null", "[]", "3", '"x"', '{"format":"foretouch-view"}', JSON.stringify(whole).slice(0, -9)]) {
    assert.throws(() => decodeDocument(text), { name: "Malformed" });
  }
});

test("whatever single value is replaced, the document is read or refused, never anything else", () => {
  const nonsense = [null, -1, 1e300, "", "<script>", [], {}, true, { f32: 3 }];
  const small = replay({ seconds: 1, rate: 4 });
  let refused = 0, tried = 0;
  const visit = (node) => {
    for (const key of Object.keys(node)) {
      const kept = node[key];
      for (const value of nonsense) {
        node[key] = value;
        ++tried;
        try {
          decoded(small);
        } catch (error) {
          assert.equal(error.name, "Malformed", `${key}: ${error.stack}`);
          ++refused;
        }
      }
      node[key] = kept;
      if (typeof kept === "object" && kept !== null && !(Array.isArray(kept) && kept.length > 20)) visit(kept);
    }
  };
  visit(small);
  assert.ok(refused > 0.5 * tried, `${refused} of ${tried}`);
});

test("a live document sends the page nowhere else", () => {
  for (const address of ["https://elsewhere.example/events", "//elsewhere.example", "events", "javascript:alert(1)", "/\\elsewhere"]) {
    assert.throws(() => decoded({ ...live(), live: { events: address } }), { name: "Malformed" });
  }
});

test("live events are read, and refused where they are wrong", () => {
  const { avatars } = decoded(live());
  const event = stepEvent(0.2, 0.3, 3);
  const read = decodeStep(JSON.stringify(event), avatars);
  assert.equal(read.t1, 0.3);
  assert.ok(read.contacts.length > 0);
  for (const harm of [{ avatar: 7 }, { from: [1] }, { to: null }, { t1: 0 }, { from: event.from.map(() => 0) }, { contacts: [{}] }]) {
    assert.throws(() => decodeStep(JSON.stringify({ ...event, ...harm }), avatars), { name: "Malformed" });
  }
  assert.deepEqual(decodeStatus('{"answered":5,"query_p50_us":null}'), { answered: 5 });
  assert.throws(() => decodeStatus("nonsense"), { name: "Malformed" });
});

test("live events of a solid avatar say what is shown, and are refused where they do not", () => {
  const document = live();
  document.avatars[0].is_solid = true;
  const { avatars } = decoded(document);
  const plain = stepEvent(0.2, 0.3, 3);
  const solid = { state: "sliding", limit: "catch-up", certified: true, deviation: 0.03, lift: 0, clearance: 0.001, snap_in: 0.2 };
  const event = { ...plain, shown_from: plain.from, shown_to: plain.to.map((value, i) => (i === 4 ? value + 0.03 : value)), solid };
  const { shown, to } = decodeStep(JSON.stringify(event), avatars);
  assert.equal(shown.state, "sliding");
  assert.equal(shown.snapIn, 0.2);
  assert.ok(Math.abs(shown.to.translations[0] - to.translations[0] - 0.03) < 1e-12);
  for (const harm of [{ shown_from: [1] }, { shown_to: null }, { solid: null }, { solid: { ...solid, state: "liquid" } }, { solid: { ...solid, deviation: -1 } }]) {
    assert.throws(() => decodeStep(JSON.stringify({ ...event, ...harm }), avatars), { name: "Malformed" });
  }
  assert.equal(decodeStep(JSON.stringify(event), decoded(live()).avatars).shown, null);
});

test("contacts hold from when they are met to the end of their step; missed ones are counted", () => {
  const view = decoded(whole), clips = view.avatars.map((avatar) => new RecordedClip(avatar.links, avatar.track));
  const contacts = allContacts(view.avatars, clips), longest = longestStep(contacts);
  assert.ok(contacts.every((contact, i) => i === 0 || contacts[i - 1].at <= contact.at));
  for (const contact of contacts) {
    assert.ok(contactsAt(contacts, contact.at, longest).includes(contact));
    assert.ok(!contactsAt(contacts, contact.at - 1e-6, longest).includes(contact));
    assert.ok(!contactsAt(contacts, contact.span.t1 + 1e-6, longest).includes(contact));
    assert.equal(contacts[firstAfter(contacts, contact.at - 1e-9)].at, contact.at);
  }
  const { seen, all } = discreteCount(contacts);
  assert.equal(all - seen, whole.avatars[0].contacts.filter((contact) => contact.missed_by_poses).length);
  assert.ok(seen > 0 && seen < all, "the fixture has both");
  const { track } = view.avatars[0];
  for (const contact of contacts.filter((one) => one.missedByPoses === true)) {
    assert.ok(!isSeenAtPose(contact, track, contact.span.t0));
    assert.ok(!touchingLinks(track, contact.span.t0).has(contact.link));
  }
  for (const contact of contacts.filter((one) => one.missedByPoses === false)) {
    assert.ok(isSeenAtPose(contact, track, contact.span.t0) || isSeenAtPose(contact, track, contact.span.t1));
  }
  assert.equal(contacts[mostTelling(contacts, clips)].missedByPoses, true);
});

function shown(value) {
  const view = decoded(value), clips = view.avatars.map((avatar) => new RecordedClip(avatar.links, avatar.track));
  return { view, contacts: allContacts(view.avatars, clips) };
}

/** A foot that kicks, deeply, one stance that slides, and one that hovers. */
function footed() {
  const stance = (more) => ({ kind: "touches", begin: 0.2, end: 0.9, slide: 0, slides: "heel", depth: 0, deepest: "toe", depth_at: 0.3, ...more });
  const hovers = { kind: "hovers", begin: 1, end: 1.5, hover: 0.012 };
  return { ...copy(), frame_time: 0.1, feet: [
    { link: 3, stances: [stance({ slide: 0.004, depth: 0.001 }), stance({ begin: 1.1, end: 1.15, depth: 0.2 })] },
    { link: 5, stances: [stance({ slide: 0.03, trace: [[0, 0, 0], [0.03, 0, 0]] }), hovers] },
  ] };
}

test("feet have rows of their own above all others, the worst first, and are counted as no touches of links", () => {
  const model = new Model(decoded(footed())), plain = new Model(decoded(touched));
  assert.deepEqual(model.countTouches(), plain.countTouches());
  assert.equal(model.stances.length, 4);
  const rows = rowsOf(model.shownTouches("", true), model.avatars, "limb", new Set());
  assert.deepEqual(rows.slice(0, 3).map(({ isHeading, link }) => [isHeading, link]), [[true, -1], [false, 3], [false, 5]], "of the foot that is 20 cm deep first");
  assert.equal(worstBy(model.stances, ({ slide }) => slide).stance.slide, 0.03);
  assert.equal(worstBy(model.stances, ({ depth }) => depth), null, "a kick does not stand");
  assert.deepEqual(byBadness(model.stances).map(({ stance }) => Math.max(stance.slide, stance.depth, stance.hover)), [0.03, 0.004, 0.2, 0.012], "what slides or sinks in before what hovers, and of it what stands before a kick");
  assert.equal(model.frameAt(0.44), 4);
});

test("a page opens at the deepest touch, or the longest where none is deep; on the ground alone at the worst foot", () => {
  const opened = (change) => {
    const view = footed();
    change(view);
    const model = new Model(decoded(view));
    return { model, ...openingOf(model) };
  };
  const deep = opened((view) => view.touches.forEach((touch, i) => (touch.penetration = i === 2 ? 0.05 : 0.01)));
  assert.equal(deep.touch.depth, 0.05);
  const unknown = opened((view) => view.touches.forEach((touch) => (touch.penetration = null)));
  assert.equal(unknown.touch.depth, null, "a depth that nobody knows is none");
  const shallow = opened((view) => view.touches.forEach((touch) => (touch.penetration = 0)));
  const span = ({ begin, end }) => end - begin, apart = shallow.model.touches.filter(({ isGround, isOwn }) => !isGround && !isOwn);
  assert.equal(span(shallow.touch), Math.max(...apart.map(span)));
  const ground = opened((view) => view.touches.forEach((touch) => (touch.ground = true)));
  assert.equal(ground.touch.stance.slide, 0.03);
  assert.equal(ground.contact, null);
});

for (const [what, change, reason] of [
  ["a foot of no link", (view) => (view.feet[0].link = 99), /but there are/],
  ["a stance of no kind", (view) => (view.feet[0].stances[0].kind = "flies"), /is none of touches, under, hovers/],
  ["a depth below zero", (view) => (view.feet[0].stances[0].depth = -1), /not in 0 to/],
]) {
  test(`${what} is refused`, () => {
    const view = footed();
    change(view);
    assert.throws(() => decoded(view), reason);
  });
}

test("what the person touched has rows and bars of its own, and counts as no touch of the model", () => {
  const model = new Model(decoded(withPerson(touched))), plain = new Model(decoded(touched)), none = new Set();
  assert.deepEqual(model.countTouches(), plain.countTouches());
  assert.deepEqual([plain.personTouches, plain.document.person], [[], null]);
  const { person } = model.document, counts = countPerson(person);
  assert.ok(counts.certain > 0 && counts.possible > 0);
  assert.equal(counts.certain + counts.possible, touched.touches.length);
  const rows = rowsOf(model.shownTouches("", true), model.avatars, "limb", none, person.bounds), [heading, ...lanes] = rows;
  assert.equal(heading.name, "the person, walker.bounds.json");
  assert.equal(heading.touches.length, touched.touches.length);
  const links = [...new Set(touched.touches.map(({ link }) => link))].sort((a, b) => a - b);
  assert.deepEqual(lanes.slice(0, links.length).map(({ link, group }) => [link, group]), links.map((link) => [link, heading.group]));
  assert.ok(lanes[links.length].isHeading && lanes.slice(links.length).flatMap((row) => row.touches).every((touch) => touch.person === null));
  for (const grouping of ["link", "object", "all"]) {
    const of = (one) => rowsOf(one.shownTouches("", true), one.avatars, grouping, none).map((row) => [row.name, row.touches.length]);
    assert.deepEqual(of(model), of(plain), grouping);
  }
  const found = model.shownTouches("righthand", true).filter((touch) => touch.person !== null);
  assert.ok(found.length > 0 && found.every(({ linkName }) => linkName === "RightHand"));
});

test("a touch of the person lasts from when on it is possible until when; certain within, own links by name", () => {
  const view = withPerson(touched);
  view.person.touches = [
    { link: 9, other: 3, verdict: "certain", begins: [1, 1.1], ends: [1.4, 1.5], began_before: true, goes_on: true, growth: 0.004 },
    { link: 6, verdict: "possible", begins: [0.5, null], ends: [null, 0.75] },
    { link: 6, object: "shelf", verdict: "certain", begins: [1.2000001, 1.2], ends: [1.2, 1.2], growth: null },
  ];
  const [own, perhaps, rounded] = new Model(decoded(view)).personTouches;
  assert.deepEqual([own.begin, own.end, own.begins, own.ends, own.object, own.isOwn], [1, 1.5, "inside", "open", "Head", true]);
  assert.deepEqual(own.person.certain, { from: 1.1, to: 1.4 });
  assert.deepEqual([perhaps.begin, perhaps.end, perhaps.object, perhaps.isOwn], [0.5, 0.75, "", false]);
  assert.deepEqual([perhaps.person.certain, perhaps.person.growth, perhaps.begins, perhaps.ends], [null, null, "contact", "left"]);
  assert.deepEqual([rounded.begin, rounded.end, rounded.person.certain.from], [1.2000001, 1.2000001, 1.2000001]);
});

test("persons of a world are told apart, and have no rate in common", () => {
  const view = withPerson(copy()), [avatar] = view.avatars;
  view.avatars.push({ ...structuredClone(avatar), id: 1, name: "ben", contacts: [] });
  delete view.person.rate_hz;
  view.person.touches = [
    { link: 9, object: "shelf", verdict: "possible", begins: [1, null], ends: [null, 1.2] },
    { avatar: 1, link: 9, object: "anna: Hips", verdict: "certain", begins: [1, 1.1], ends: [1.05, 1.5] },
    { avatar: 1, link: 3, other: 2, verdict: "possible", begins: [1, null], ends: [null, 1.5] },
  ];
  const model = new Model(decoded(view)), [first, other, own] = model.personTouches;
  assert.equal(model.person.rateHz, null);
  assert.deepEqual([first.avatar, other.avatar, other.object, other.isOwn], [0, 1, "anna: Hips", false]);
  // A passage: it had begun by the second instant, and had not ended before the first.
  assert.deepEqual(other.person.certain, { from: 1.1, to: 1.05 });
  assert.deepEqual([own.object, own.isOwn], [avatar.links[2].name, true]);
  const [heading, ...lanes] = rowsOf(model.personTouches, model.avatars, "limb", new Set(), view.person.bounds);
  assert.equal(heading.touches.length, 3);
  assert.deepEqual(lanes.map(({ avatar, link }) => [avatar, link]), [[0, 9], [1, 3], [1, 9]]);
  assert.ok(lanes[1].name.startsWith("ben: "), lanes[1].name);
  view.person.touches[1].link = 99;
  assert.throws(() => decoded(view), /touches\[1\]\.link is 99/);
});

test("of a stream, what a step leaves possible and the next one goes on with is one touch", () => {
  const served = live();
  served.person = { bounds: "walker.bounds.json", between: "cubic-late", touches: [] };
  const document = decoded(served), model = new Model(document);
  const step = (t0, person) => decodeStep(JSON.stringify({ ...stepEvent(t0, t0 + 0.1, 0), person }), document.avatars).person;
  const possible = step(0, [{ link: 9, object: "shelf", verdict: "possible", begins: [0.05, null], ends: [null, 0.1], growth: 0.01 }]);
  const certain = step(0.1, [
    { link: 9, object: "shelf", verdict: "certain", begins: [0.1, 0.12], ends: [0.2, 0.2], growth: 0.02 },
    { link: 3, object: "shelf", verdict: "possible", begins: [0.1, null], ends: [null, 0.15], growth: 0.02 },
  ]);
  const later = step(0.3, [{ link: 9, object: "shelf", verdict: "certain", begins: [0.3, 0.3], ends: [0.35, 0.36], growth: 0.01 }]);
  model.replacePerson([possible, certain, later].reduce(joinedPerson, []));
  const bars = model.personTouches.map(({ link, begin, end, person }) => [link, begin, end, person.certain, person.growth]);
  assert.deepEqual(bars, [
    [9, 0.05, 0.2, { from: 0.12, to: 0.2 }, 0.02],
    [3, 0.1, 0.15, null, 0.02],
    [9, 0.3, 0.36, { from: 0.3, to: 0.35 }, 0.01],
  ]);
  assert.deepEqual(model.shownTouches("", true).filter(({ person }) => person !== null).length, 3);
  assert.deepEqual(decodeStep(JSON.stringify(stepEvent(0, 0.1, 0)), document.avatars).person, []);
  assert.throws(() => step(0, [{ link: 99, verdict: "possible", begins: [0, null], ends: [null, 1] }]), /person\[0\]\.link is 99/);
});

for (const [what, change, reason] of [
  ["a touch of the person with no link", (one) => (one.link = 16), /person\.touches\[0\]\.link is 16/],
  ["a touch of the person with no other link", (one) => (one.other = 16), /touches\[0\]\.other is 16/],
  ["a touch of the person of no verdict", (one) => (one.verdict = "excluded"), /verdict is none of certain, possible/],
  ["a bracket of one time", (one) => (one.begins = [1]), /begins is not two times/],
  ["a possible touch that is known to have begun", (one) => (one.verdict = "possible"), /begins\[1\] is known, but the touch is only possible/],
  ["a certain touch that never surely ended", (one) => (one.ends[0] = null), /ends\[0\] is not a number/],
  ["a touch that had begun before it could", (one) => (one.begins[1] = one.begins[0] - 1), /begins\[1\] is .*, not in/],
  ["a touch that is over before it begins", (one) => (one.ends[1] = one.begins[0] - 1), /ends\[1\] is .*, not in/],
  ["a growth below zero", (one) => (one.growth = -0.001), /growth is -0.001/],
  ["bounds without a name", (_, person) => delete person.bounds, /person has no "bounds"/],
  ["a person without touches", (_, person) => delete person.touches, /person has no "touches"/],
  ["a person without an avatar", (_, person, view) => Object.assign(view, { avatars: [], touches: [] }), /there is no avatar/],
]) {
  test(`${what} is refused`, () => {
    const view = structuredClone(withPerson(touched));
    change(view.person.touches[0], view.person, view);
    assert.throws(() => decoded(view), { name: "Malformed", message: reason });
  });
}

test("touches have their contacts, whatever order the page has those in", () => {
  const { view, contacts } = shown(touched);
  const touches = recordedTouches(view.touches, view.avatars, contacts);
  assert.equal(touches.length, touched.touches.length);
  assert.ok(touches.length > 3 && touches.length < contacts.length, "some touches last longer than a step");
  touches.forEach((touch, i) => {
    assert.deepEqual(touch.rows.map(({ row }) => row), touched.touches[i].rows);
    assert.ok(touch.rows.every((row) => row.link === touch.link && row.object === touch.object && row.at >= touch.begin - 1e-9 && row.at <= touch.end));
    assert.equal(touch.isMissed, touched.touches[i].missed ?? false);
  });
});

test("the contacts of a stream are the same touches", () => {
  const { view, contacts } = shown(touched);
  const ends = (touch) => [touch.link, touch.object, touch.begin.toFixed(6), touch.end.toFixed(6), touch.rows.length];
  const merged = mergedTouches(contacts.filter(({ verdict }) => verdict !== "undecided"));
  assert.deepEqual(merged.map(ends).sort(), recordedTouches(view.touches, view.avatars, contacts).map(ends).sort());
});

test("a search finds every word in the link's or the object's name", () => {
  const touch = { linkName: "mixamorig:LeftHand", object: "floor_lamp" };
  for (const search of ["", "hand", "LAMP", "left lamp", "lamp left"]) assert.ok(matches(touch, search), search);
  for (const search of ["foot", "left table"]) assert.ok(!matches(touch, search), search);
});

test("the timeline's rows, by limb, by link, by object and all", () => {
  const { view, contacts } = shown(touched);
  const touches = recordedTouches(view.touches, view.avatars, contacts), none = new Set();
  const sum = (rows) => rows.filter((row) => !row.isHeading).reduce((count, row) => count + row.touches.length, 0);
  for (const grouping of ["limb", "link", "object", "all"]) assert.equal(sum(rowsOf(touches, view.avatars, grouping, none)), touches.length, grouping);
  assert.equal(rowsOf(touches, view.avatars, "all", none).length, 16);
  assert.ok(rowsOf(touches, view.avatars, "link", none).every((row) => row.touches.length > 0));
  const byLimb = rowsOf(touches, view.avatars, "limb", none), headings = byLimb.filter((row) => row.isHeading);
  assert.equal(headings.reduce((count, row) => count + row.touches.length, 0), touches.length);
  const folded = rowsOf(touches, view.avatars, "limb", new Set([headings[0].group]));
  assert.equal(folded.length, byLimb.length - byLimb.filter((row) => !row.isHeading && row.group === headings[0].group).length);
});

test("a bar is hit where it is, and the shorter of two", () => {
  const touch = (begin, end) => ({ ...touchOfRow({ at: begin, span: { t0: begin, t1: end }, verdict: "contact" }) });
  const row = { touches: [touch(1, 9), touch(2, 3)] };
  assert.equal(nearestTouch(row, 5, 0.1), row.touches[0]);
  assert.equal(nearestTouch(row, 2.5, 0.1), row.touches[1]);
  assert.equal(nearestTouch(row, 9.05, 0.1), row.touches[0]);
  assert.equal(nearestTouch(row, 9.2, 0.1), null);
});

test("the overview counts what touches when", () => {
  const density = densityOf([{ begin: 0, end: 0.4 }, { begin: 3.2, end: 5.1 }, { begin: 3.9, end: 3.9 }], { t0: 0, t1: 10 }, 10);
  assert.deepEqual([...density], [1, 0, 0, 2, 1, 1, 0, 0, 0, 0]);
});

test("the timeline's ticks and windows", () => {
  assert.deepEqual(ticks({ t0: 0, t1: 1 }, 5).times.map((t) => t.toFixed(1)), ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
  assert.ok(ticks({ t0: 0, t1: 1e-9 }, 10).times.length < 20);
  const window = zoomed({ t0: 0, t1: 10 }, 0.5, 2, { t0: 0, t1: 10 });
  assert.deepEqual(window, { t0: 1, t1: 6 });
  assert.deepEqual(zoomed(window, 100, 3, { t0: 0, t1: 10 }), { t0: 0, t1: 10 });
});

test("a document cannot end its own block", () => {
  const page = pageWith('<script type="application/json" id="foretouch-view"></script>', '{"title":"</script><b>"}');
  assert.equal(page.match(/<\/script>/g).length, 1);
  assert.throws(() => pageWith("<p>", "{}"));
});
