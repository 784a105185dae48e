// A synthetic view document: a figure of sixteen links walks through a small room past a table and
// a railing, and swings its hand through the railing between two poses. Contacts come from dense
// sampling against boxes, so that they are where the picture shows them.
//   node tests/fixture.mjs KIND > view.json      KIND: replay, inspection, live

import { compose, interpolate, pointAt, transformSize } from "../build/motion/chain.js";

const packed = (key, array) => {
  const bytes = Buffer.from(array.buffer, array.byteOffset, array.byteLength);
  return { [key]: bytes.toString("base64") };
};
export const f64 = (values) => packed("f64", Float64Array.from(values));
export const f32 = (values) => packed("f32", Float32Array.from(values));
export const u32 = (values) => packed("u32", Uint32Array.from(values));
export const u16 = (values) => packed("u16", Uint16Array.from(values));

// name, parent, offset from the parent (m), LSS in the link's frame: a, b, radius (m)
const body = [
  ["Hips", -1, [0, 0, 0], [-0.08, 0, 0], [0.08, 0, 0], 0.11],
  ["Spine", 0, [0, 0.12, 0], [0, 0.02, 0], [0, 0.2, 0], 0.115],
  ["Chest", 1, [0, 0.24, 0], [-0.08, 0.08, 0], [0.08, 0.08, 0], 0.13],
  ["Head", 2, [0, 0.27, 0], [0, 0.1, 0.01], [0, 0.17, 0.01], 0.095],
  ["LeftArm", 2, [0.2, 0.14, 0], [0, 0, 0], [0, -0.26, 0], 0.048],
  ["LeftForeArm", 4, [0, -0.28, 0], [0, 0, 0], [0, -0.22, 0], 0.04],
  ["LeftHand", 5, [0, -0.25, 0], [0, -0.02, 0], [0, -0.12, 0], 0.035],
  ["RightArm", 2, [-0.2, 0.14, 0], [0, 0, 0], [0, -0.26, 0], 0.048],
  ["RightForeArm", 7, [0, -0.28, 0], [0, 0, 0], [0, -0.22, 0], 0.04],
  ["RightHand", 8, [0, -0.25, 0], [0, -0.02, 0], [0, -0.12, 0], 0.035],
  ["LeftUpLeg", 0, [0.1, -0.06, 0], [0, 0, 0], [0, -0.38, 0], 0.075],
  ["LeftLeg", 10, [0, -0.42, 0], [0, 0, 0], [0, -0.36, 0], 0.055],
  ["LeftFoot", 11, [0, -0.4, 0], [0, -0.03, -0.04], [0, -0.03, 0.14], 0.04],
  ["RightUpLeg", 0, [-0.1, -0.06, 0], [0, 0, 0], [0, -0.38, 0], 0.075],
  ["RightLeg", 13, [0, -0.42, 0], [0, 0, 0], [0, -0.36, 0], 0.055],
  ["RightFoot", 14, [0, -0.4, 0], [0, -0.03, -0.04], [0, -0.03, 0.14], 0.04],
];
export const parents = Int32Array.from(body, (link) => link[1]);
const links = body.length;

// name, centre, half size (m)
const boxes = [
  ["floor", [0, -0.05, 0], [3, 0.05, 2.2]],
  ["wall north", [0, 1.3, -2.25], [3, 1.3, 0.05]],
  ["wall west", [-3.05, 1.3, 0], [0.05, 1.3, 2.2]],
  ["table", [1.4, 0.72, -0.75], [0.6, 0.02, 0.35]],
  ["table leg", [0.9, 0.35, -0.5], [0.025, 0.35, 0.025]],
  ["table leg", [1.9, 0.35, -0.5], [0.025, 0.35, 0.025]],
  ["table leg", [0.9, 0.35, -1], [0.025, 0.35, 0.025]],
  ["table leg", [1.9, 0.35, -1], [0.025, 0.35, 0.025]],
  ["railing", [0, 1.0, 0.62], [2.4, 0.02, 0.02]],
  ["railing", [0, 0.55, 0.62], [2.4, 0.012, 0.012]],
  ...[-2.4, -1.2, 0, 1.2, 2.4].map((x) => ["railing post", [x, 0.5, 0.62], [0.02, 0.5, 0.02]]),
  ["shelf", [-1.2, 0.6, -1.9], [0.5, 0.6, 0.25]],
];
const origin = [0.5, 0, -0.25];

const turn = (axis, angle) => {
  const q = [Math.cos(angle / 2), 0, 0, 0];
  q[1 + axis] = Math.sin(angle / 2);
  return q;
};
const product = (p, q) => [
  p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3],
  p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
  p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1],
  p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0],
];

/** Parent-relative pose at a time; walks along +x at 1.1 m/s. */
export function poseOf(time) {
  const phase = 2 * Math.PI * time * 0.9, stride = 0.45 * Math.sin(phase);
  const pose = { rotations: new Float64Array(4 * links), translations: new Float64Array(3 * links) };
  body.forEach(([, , offset], i) => {
    pose.rotations.set([1, 0, 0, 0], 4 * i);
    pose.translations.set(offset, 3 * i);
  });
  const rotate = (link, q) => pose.rotations.set(q, 4 * link);
  pose.translations.set([-2.2 + 1.1 * time, 0.965 + 0.02 * Math.cos(2 * phase), 0.05], 0);
  rotate(0, product(turn(1, Math.PI / 2), turn(1, 0.08 * Math.sin(phase))));
  rotate(1, turn(0, 0.06));
  rotate(3, turn(1, 0.3 * Math.sin(phase / 3)));
  rotate(10, turn(0, -stride));
  rotate(13, turn(0, stride));
  rotate(11, turn(0, 0.15 + 0.5 * Math.max(0, Math.sin(phase + 1.2))));
  rotate(14, turn(0, 0.15 + 0.5 * Math.max(0, -Math.sin(phase + 1.2))));
  rotate(4, product(turn(2, 0.1), turn(0, 0.6 * stride)));
  rotate(5, turn(0, -0.35));
  // The right hand strikes sideways through the railing every 0.8 s.
  const strike = Math.sin(2 * Math.PI * time * 1.25 + 0.9);
  rotate(7, product(turn(2, -0.55 - 0.75 * strike), turn(0, -0.3)));
  rotate(8, turn(0, -0.3 - 0.3 * strike));
  return pose;
}

function distanceToBox(p, [, centre, half]) {
  const d = p.map((value, i) => Math.abs(value - centre[i]) - half[i]);
  return Math.hypot(...d.map((value) => Math.max(0, value))) + Math.min(0, Math.max(...d));
}

/** Nearest box to a link: separation, point, normal. */
function nearest(world, link) {
  const [, , , a, b, radius] = body[link];
  let best = { separation: Infinity };
  for (let i = 0; i <= 8; ++i) {
    const p = pointAt(world, transformSize * link, a.map((value, axis) => value + (i / 8) * (b[axis] - value)));
    boxes.forEach((box, object) => {
      const separation = distanceToBox(p, box) - radius;
      if (separation < best.separation) best = { separation, p, object };
    });
  }
  return best;
}

function witness({ p, object, separation }, radius) {
  const [name, centre, half] = boxes[object];
  const point = p.map((value, i) => Math.min(centre[i] + half[i], Math.max(centre[i] - half[i], value)));
  const away = p.map((value, i) => value - point[i]);
  const length = Math.hypot(...away);
  const normal = length > 1e-9 ? away.map((value) => value / length) : [0, 1, 0];
  return { point, normal, on_link: p.map((value, i) => value - radius * normal[i]), object: name, triangle: 12 * object, separation };
}

function worldAt(from, to, u) {
  const pose = poseOf(0);
  interpolate(from, to, u, pose);
  const world = new Float64Array(transformSize * links);
  compose(parents, pose, world);
  return world;
}

const threshold = 0.001;
/** Contacts of one step, earliest first. */
export function contactsOf(from, to, t0, t1, samples = 120) {
  const worlds = Array.from({ length: samples + 1 }, (_, i) => worldAt(from, to, i / samples));
  const contacts = [];
  for (let link = 0; link < links; ++link) {
    const met = worlds.findIndex((world) => nearest(world, link).separation <= threshold);
    if (met < 0) continue;
    const found = nearest(worlds[met], link), toi = met / samples;
    const touches = (world) => nearest(world, link).separation <= threshold;
    const contact = {
      link, verdict: met === 0 ? "starts_in_contact" : "contact", toi, time: t0 + toi * (t1 - t0),
      ...witness(found, body[link][5]), missed_by_poses: !touches(worlds[0]) && !touches(worlds[samples]),
    };
    contact.separation = Math.max(0, contact.separation);
    if (met === 0) contact.penetration = Math.max(0, -found.separation);
    contacts.push(contact);
  }
  return contacts.sort((a, b) => a.toi - b.toi);
}

function sceneMesh() {
  const positions = [], indices = [], objects = [];
  const corners = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
  for (const [name, centre, half] of boxes) {
    const first = positions.length / 3;
    for (let i = 0; i < 8; ++i) {
      positions.push(...[0, 1, 2].map((axis) => centre[axis] + ((i >> axis) & 1 ? 1 : -1) * half[axis] - origin[axis]));
    }
    objects.push({ name, first: indices.length / 3, count: 12 });
    for (const [a, b, c, d] of corners) indices.push(first + a, first + b, first + c, first + a, first + c, first + d);
  }
  return { positions, indices, objects };
}

/** A tube of the link's LSS at some instants, inflated: looks like a swept surface. */
function sweptTube(from, to, link, around = 14, along = 24) {
  const [, , , a, b, radius] = body[link], positions = [], indices = [];
  const centre = pointAt(worldAt(from, to, 0.5), transformSize * link, a);
  for (let i = 0; i <= along; ++i) {
    const world = worldAt(from, to, i / along), at = transformSize * link;
    for (let j = 0; j < around; ++j) {
      const angle = (2 * Math.PI * j) / around, grown = 1.15 * radius;
      const end = Math.sin(angle) > 0 ? b : a;
      const p = [grown * Math.cos(angle), end[1] + grown * Math.sin(angle) * (end === b ? -1 : -1), 0];
      positions.push(...pointAt(world, at, p).map((value, axis) => value - centre[axis]));
    }
  }
  for (let i = 0; i < along; ++i) for (let j = 0; j < around; ++j) {
    const next = (j + 1) % around, p = i * around + j, q = i * around + next;
    indices.push(p, q, p + around, q, q + around, p + around);
  }
  return { origin: centre, positions: f32(positions), indices: u32(indices), error: 0.005 };
}

function track(poses, times, steps) {
  const touching = poses.map((pose) => {
    const world = worldAt(pose, pose, 0);
    return body.flatMap((_, link) => (nearest(world, link).separation <= threshold ? [link] : []));
  });
  const first = [0];
  for (const list of touching) first.push(first[first.length - 1] + list.length);
  return {
    pose_times: f64(times),
    rotations: f64(poses.flatMap((pose) => [...pose.rotations])),
    translations: { offsets: f64(body.flatMap((link) => link[2])), moving: [0], values: f64(poses.flatMap((pose) => [...pose.translations.subarray(0, 3)])) },
    steps: { from: u32(steps.map(([from]) => from)), to: u32(steps.map(([, to]) => to)) },
    latency_us: f64(steps.map((_, i) => 3 + 9 * Math.abs(Math.sin(i * 12.9898)) ** 3 + (i % 37 === 0 ? 40 : 0))),
    touching_at_poses: { first: u32(first), links: u16(touching.flat()) },
  };
}

export function replay({ seconds = 4, rate = 10 } = {}) {
  const times = Array.from({ length: seconds * rate + 1 }, (_, i) => i / rate);
  const poses = times.map(poseOf);
  // Two poses after three seconds were lost: one step goes across, one gap is not answered.
  const steps = times.slice(1).map((_, i) => [i, i + 1]).filter(([from]) => from !== 3 * rate + 2);
  const contacts = steps.flatMap(([from, to], step) => contactsOf(poses[from], poses[to], times[from], times[to]).map((contact) => ({ step, ...contact })));
  const swept = contacts.filter((contact) => contact.verdict === "contact").slice(0, 40).map(({ step, link }) => ({ step, link, ...sweptTube(poses[steps[step][0]], poses[steps[step][1]], link) }));
  contacts.push({ step: steps.length - 1, link: 3, verdict: "undecided", reason: "work-budget", free_until: 0.6 });
  const missed = contacts.filter((contact) => contact.missed_by_poses).length;
  return {
    ...common("replay", "walker.bvh in room.obj"),
    settings: [{ name: "rate", value: `${rate} poses a second` }, { name: "tolerance", value: "1 mm" }, { name: "fidelity", value: "lss" }],
    summary: [
      { name: "steps", value: String(steps.length) },
      { name: "contacts", value: String(contacts.length), note: `${missed} touch nothing at either pose` },
    ],
    notes: ["One interval was not answered: a pose was lost."],
    avatars: [{ ...avatar(), track: track(poses, times, steps), contacts, swept }],
  };
}

export function inspection() {
  const pose = poseOf(0);
  return {
    ...common("inspection", "walker.bvh in room.obj"),
    notes: ["The scene has no unit; metres are assumed."],
    avatars: [{ ...avatar(), track: { ...track([pose], [0], []), latency_us: undefined }, contacts: [], swept: [] }],
  };
}

export function live() {
  return { ...common("live", "foretouch serve, room.obj"), avatars: [{ ...avatar(), contacts: [], swept: [] }], live: { events: "/events" } };
}

/** The event of the step between two times. */
export function stepEvent(t0, t1, sequence) {
  const from = poseOf(t0 % 4), to = poseOf((t1 - 1e-9) % 4 < t0 % 4 ? 4 : t1 % 4 || 4);
  const flat = (pose) => body.flatMap((_, i) => [...pose.rotations.subarray(4 * i, 4 * i + 4), ...pose.translations.subarray(3 * i, 3 * i + 3)]);
  return {
    avatar: 0, sequence, t0, t1, kind: "consecutive", lost: 0, from: flat(from), to: flat(to),
    contacts: contactsOf(from, to, t0, t1, 40), query_us: 8.5, added_us: 60, skipped: 0,
  };
}

function avatar() {
  return {
    id: 0,
    name: "walker.avatar.json",
    links: body.map(([name, parent]) => ({ name, parent })),
    lss: body.map(([, , , a, b, radius], link) => ({ link, a, b, radius })),
  };
}

function common(kind, title) {
  const mesh = sceneMesh();
  return {
    format: "foretouch-view", version: 1, tool: "foretouch 0.1.0", kind, title, settings: [], summary: [], notes: [],
    scene: {
      name: "room.obj", origin, positions: f32(mesh.positions), indices: u32(mesh.indices), objects: mesh.objects,
      triangle_ids: u32(mesh.indices.slice(0, mesh.indices.length / 3).map((_, i) => i)),
      triangles_in_file: mesh.indices.length / 3, reduction: "none", bounds: { min: [-3.1, -0.1, -2.3], max: [3, 2.6, 2.2] },
    },
  };
}

/** The document with the touches that its contacts are: each as long as the steps after it start in contact. */
export function withTouches(document) {
  const [{ contacts, track, links }] = document.avatars;
  const pose = (name) => new Uint32Array(new Uint8Array(Buffer.from(track.steps[name].u32, "base64")).buffer);
  const times = new Float64Array(new Uint8Array(Buffer.from(track.pose_times.f64, "base64")).buffer);
  const to = pose("to"), touches = [];
  contacts.forEach((contact, row) => {
    if (contact.verdict === "undecided") return;
    const known = touches.find((one) => one.link === contact.link && one.object === contact.object && one.steps[1] === contact.step - 1);
    const end = times[to[contact.step]];
    if (known !== undefined && contact.verdict === "starts_in_contact") {
      known.steps[1] = contact.step;
      known.end = end;
      known.rows.push(row);
      delete known.missed;
      return;
    }
    const begins = contact.verdict === "contact" ? "contact" : "inside";
    const touch = { link: contact.link, object: contact.object, begin: contact.time, end, steps: [contact.step, contact.step], begins, ends: "left", rows: [row] };
    if (contact.missed_by_poses === true) touch.missed = true;
    if (/Foot$/.test(links[contact.link].name)) touch.ground = true;
    touches.push(touch);
  });
  touches.sort((a, b) => a.begin - b.begin || a.link - b.link);
  return { ...document, touches };
}

/** What the person touched: as the model, but for brackets; every third of them only perhaps. */
export function withPerson(document) {
  const touches = document.touches.map(({ link, object, begin, end }, i) => {
    const wide = Math.min(0.03, (end - begin) / 3), isCertain = i % 3 !== 2;
    const [begins, ends] = isCertain ? [[begin - wide, begin + wide], [end - wide, end + wide]] : [[begin - wide, null], [null, end + wide]];
    return { link, object, verdict: isCertain ? "certain" : "possible", begins, ends, growth: 0.01 + 0.005 * (i % 4) };
  });
  return { ...document, person: { bounds: "walker.bounds.json", between: "cubic-late", rate_hz: 10, touches } };
}

/** The page with a document in it. */
export function pageWith(template, text) {
  const place = '<script type="application/json" id="foretouch-view">';
  if (template.split(place).length !== 2) throw new Error("the page has not exactly one place for a document");
  return template.replace(place, () => place + text.replaceAll("<", "\\u003c"));
}

if (process.argv[1]?.endsWith("fixture.mjs")) {
  const kinds = { replay, inspection, live };
  process.stdout.write(JSON.stringify(kinds[process.argv[2] ?? "replay"]()));
}
