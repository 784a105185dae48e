// A hand as WebXR tracks it: a wrist and 24 joints below it, led as a whole; and where its bones are,
// by kinematics that share nothing with the library.

const fingers = [["thumb", 4], ["index", 5], ["middle", 5], ["ring", 5], ["little", 5]];
/** Metres along the finger, from the wrist's joint on; bones lie along -z, as in WebXR. */
const boneLengths = { thumb: [0.035, 0.032, 0.025], index: [0.07, 0.04, 0.025, 0.02], middle: [0.068, 0.045, 0.03, 0.02], ring: [0.062, 0.042, 0.028, 0.02], little: [0.055, 0.034, 0.02, 0.018] };

/** 25 links: a capsule per bone, in the frame of the joint where it begins. */
export function handLinks() {
  const links = [{ name: "wrist", parent: null, offset: [0, 0, 0], lss: [{ a: [0, 0, 0], b: [0, 0, -0.02], radius: 0.02 }] }];
  fingers.forEach(([finger, joints], index) => {
    const across = 0.018 * (index - 2), lengths = boneLengths[finger];
    for (let joint = 0; joint < joints; ++joint) {
      const length = lengths[joint] ?? 0.004, radius = Math.max(0.007, 0.011 - 0.001 * joint);
      links.push({
        name: `${finger}-${joint}`,
        parent: joint === 0 ? "wrist" : `${finger}-${joint - 1}`,
        offset: joint === 0 ? [across, 0, -0.03] : [0, 0, -lengths[joint - 1]],
        lss: [{ a: [0, 0, 0], b: [0, 0, -length], radius }],
      });
    }
  });
  return links;
}

export function seeded(seed) {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

export const axisTurn = ([x, y, z], angle) => [Math.cos(angle / 2), ...[x, y, z].map((v) => v * Math.sin(angle / 2))];

/** The hand at a place, turned as a whole, its fingers bent by `bend` radians a joint. */
export function handPose(links, place, turn, bend) {
  const rotations = new Float64Array(4 * links.length), translations = new Float64Array(3 * links.length);
  links.forEach(({ name, offset }, link) => {
    rotations.set(link === 0 ? turn : name.endsWith("-0") ? [1, 0, 0, 0] : axisTurn([1, 0, 0], -bend), 4 * link);
    translations.set(link === 0 ? place : offset, 3 * link);
  });
  return { rotations, translations };
}

function product([a, b, c, d], [e, f, g, h]) {
  return [a * e - b * f - c * g - d * h, a * f + b * e + c * h - d * g, a * g - b * h + c * e + d * f, a * h + b * g - c * f + d * e];
}

function turned(q, [x, y, z]) {
  const [, ...p] = product(product(q, [0, x, y, z]), [q[0], -q[1], -q[2], -q[3]]);
  return p;
}

function between(from, to, at, u) {
  let q = Array.from(to.subarray(at, at + 4));
  const p = Array.from(from.subarray(at, at + 4));
  let dot = p.reduce((sum, value, i) => sum + value * q[i], 0);
  if (dot < 0) [q, dot] = [q.map((value) => -value), -dot];
  const angle = Math.acos(Math.min(1, dot));
  const [a, b] = angle < 1e-7 ? [1 - u, u] : [Math.sin((1 - u) * angle) / Math.sin(angle), Math.sin(u * angle) / Math.sin(angle)];
  const mixed = p.map((value, i) => a * value + b * q[i]), length = Math.hypot(...mixed);
  return mixed.map((value) => value / length);
}

/** Both ends and the radius of every bone, at `u` of the motion from one pose to another. */
export function bonesAt(links, from, to, u) {
  const places = new Map();
  return links.flatMap(({ name, parent, lss }, link) => {
    const above = places.get(parent) ?? { q: [1, 0, 0, 0], p: [0, 0, 0] };
    const own = [0, 1, 2].map((i) => (1 - u) * from.translations[3 * link + i] + u * to.translations[3 * link + i]);
    const placed = (frame, point) => turned(frame.q, point).map((value, i) => value + frame.p[i]);
    const frame = { q: product(above.q, between(from.rotations, to.rotations, 4 * link, u)), p: placed(above, own) };
    places.set(name, frame);
    return lss.map(({ a, b, radius }) => ({ a: placed(frame, a), b: placed(frame, b), radius }));
  });
}
