// A head and two controllers, as WebXR reports them: the player stands on a lift that rises, leans
// with one hand on its rail, catches a ball with the other, and a sliding door pushes that hand.
// Prints what the hands meet and leave, as examples/cpp/vr_hands.cpp does; with an argument, each
// place on every shown way, too.
//   node vr_hands.mjs [ways]

import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { Foretouch } from "foretouch";

const ft = await Foretouch.load(readFileSync(createRequire(import.meta.url).resolve("foretouch/foretouch.wasm")));
const showsWays = process.argv.length > 2;
const firstUs = 5_000_000_000, periodNs = 11_111_111;
const right = 2;

/** 0 before `begin`, 1 after `end` (seconds), smoothly. */
function smoothly(s, begin, end) {
  const t = Math.min(Math.max((s - begin) / (end - begin), 0), 1);
  return t * t * (3 - 2 * t);
}

/** Boards with their sides along the axes: [name, low corner, high corner]. */
function sceneOf(...boards) {
  const faces = [[0, 1, 5, 4], [2, 3, 7, 6], [0, 1, 3, 2], [4, 5, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]];
  const corner = (low, high, i) => [0, 1, 2].map((axis) => ((i >> axis) & 1 ? high : low)[axis]);
  return ft.scene({
    positions: boards.flatMap(([, low, high]) => [...Array(8).keys()].flatMap((i) => corner(low, high, i))),
    indices: boards.flatMap((_, b) => faces.flatMap(([p, q, r, s]) => [p, q, r, p, r, s].map((i) => 8 * b + i))),
    objects: boards.flatMap((_, b) => Array(12).fill(b)),
    objectNames: boards.map(([name]) => name),
  });
}

/** Links that each have a place of their own in the world: so as many roots. */
const avatarOf = (...links) => ft.avatar(links.map(([name, lss]) => ({ name, parent: null, offset: [0, 0, 0], lss: [lss] })));
/** Not turned. */
const at = (x, y, z) => ({ rotations: [1, 0, 0, 0], translations: [x, y, z] });

/** What XRFrame.getPose() says at the predicted time, in the play space: places alone, as nothing turns here. Yours; here the left hand is pressed 10 cm too deep on the rail, and let go of it again. */
function locate(s) {
  const down = Math.fround(0.3 * (smoothly(s, 0.2, 1) - smoothly(s, 2.6, 3.2)));
  const isLost = s > 2 && s < 2.1; // its camera does not see the right one
  return [
    { place: [0, 1.7, 0], isTracked: true },
    { place: [-0.45, Math.fround(1.19) - down, -0.45], isTracked: true },
    { place: [0.4, 1.3, -0.55], isTracked: !isLost },
  ].map(({ place, isTracked }) => ({ place: place.map(Math.fround), isTracked }));
}

// Where the others are: the lift rises, the door slides along and back, the ball is thrown, and is in
// the right hand at 0.8 s.
const liftAt = (s) => [0, 1.2 * smoothly(s, 1.8, 3.6), 0];
const doorAt = (s) => [1.1 - 0.8 * (smoothly(s, 1.4, 2.4) - smoothly(s, 3, 4)), 0, 0];
function ballAt(s) {
  const t = s - 0.8;
  return [0.4, 1.3 + 0.6 * t - 4.905 * t * t, -0.67 + 2.5 * t];
}

const head = { a: [0, 0, 0], b: [0, 0, 0], radius: 0.12 }, hand = { a: [0, 0, 0.03], b: [0, 0, -0.06], radius: 0.04 };
const player = avatarOf(["Head", head], ["LeftHand", hand], ["RightHand", hand]);
const still = sceneOf(["floor", [-3, -1, -3], [3, -0.9, 3]]);
const platform = sceneOf(["platform", [-0.9, -0.1, -0.9], [0.9, 0, 0.9]], ["rail", [-0.6, 0.9, -0.5], [-0.3, 0.95, -0.4]]);
const panel = sceneOf(["door", [0, 0, -0.6], [1, 4, -0.5]]);
const sphere = avatarOf(["ball", { a: [0, 0, 0], b: [0, 0, 0], radius: 0.035 }]);

const world = ft.solidWorld(still, firstUs); // the first tick is later
const user = world.add(player); // solid: follows its targets
const lift = world.world.add(platform); // these move as they are told
const door = world.world.add(panel);
const ball = world.world.add(sphere);
const met = new Map([[lift, platform], [door, panel], [-1, still]]);
const joints = player.links.map(({ name }) => name);
let isCaught = false, lastUs = firstUs, proven = 0, told = 0;

function place(us, who, [x, y, z], rotation = [1, 0, 0, 0]) {
  if (!showsWays) return;
  const nine = (numbers) => Array.from(numbers, (number) => number.toFixed(9)).join(" ");
  console.log(`${(1e-6 * (us - firstUs)).toFixed(6)} s: ${who} at ${nine([x, y, z])} turned ${nine(rotation)}`);
}

/** In place of a picture: every end of a motion. */
function draw(us, { body, tick }) {
  for (let i = 0; i <= tick.wayCount; ++i) {
    const { time, pose } = i < tick.wayCount ? world.way(body, i) : { time: 1, pose: tick.shown };
    const when = time === 1 ? us : lastUs + time * (us - lastUs);
    joints.forEach((name, j) => place(when, name, pose.translations.subarray(3 * j, 3 * j + 3), pose.rotations.subarray(4 * j, 4 * j + 4)));
  }
  proven += tick.isCertified ? 1 : 0;
  lastUs = us;
}

for (let frame = 0; frame <= 360; ++frame) {
  const us = Math.floor((1000 * firstUs + frame * periodNs) / 1000); // XRFrame.predictedDisplayTime, in microseconds
  const s = 1e-6 * (us - firstUs);
  const playSpace = liftAt(s); // who stands on the lift goes along with it
  world.world.push(lift, us, at(...playSpace));
  world.world.push(door, us, at(...doorAt(s)));
  place(us, "lift", playSpace);
  place(us, "door", doorAt(s));
  if (!isCaught) {
    world.world.push(ball, us, at(...ballAt(s)));
    place(us, "ball", ballAt(s));
  }
  if (frame === 0) continue; // where they begin
  const located = locate(s);
  const tracked = {
    rotations: located.flatMap(() => [1, 0, 0, 0]), // WebXR has w last
    translations: located.flatMap((one) => one.place.map((coordinate, axis) => coordinate + playSpace[axis])),
  };
  const [hands] = world.tick(us, [{ body: user, pose: tracked, isTracked: located.map(({ isTracked }) => isTracked) }]);
  draw(us, hands);
  for (const { kind, cause, timeUs, timeFraction, a, b } of world.follow().events) { // from enter to leave
    if (a.body !== user || (kind !== "enter" && kind !== "leave")) continue;
    const verb = kind === "enter" ? "meets" : cause === "not_asked" ? "takes" : "leaves";
    console.log(`${(1e-6 * (timeUs - firstUs + timeFraction)).toFixed(6)} s: ${joints[a.link]} ${verb} ${b.body === ball ? "ball" : met.get(b.body).objectNames[b.object]}`);
    ++told;
    if (b.body !== ball || kind !== "enter") continue;
    isCaught = true; // the hand closes, where both are at the tick's end
    const palm = hands.tick.shown.translations.subarray(3 * right, 3 * right + 3);
    world.world.attach(ball, user, us, at(...ballAt(s).map((coordinate, axis) => coordinate - palm[axis])), { link: right });
  }
  world.world.forgetBefore(us);
}
process.exitCode = told === 6 && proven === 360 ? 0 : 1;
