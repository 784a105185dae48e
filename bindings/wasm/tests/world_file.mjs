// A world for the native program, as a world file, and the same in the module: a dancer in the bundled
// room, a door that swings, a ball that is in her hand, thrown, and falls, and a volume about her head.

import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { example, examples, parseObj, program } from "./native.mjs";

const takenUs = 600_000, thrownUs = 2_500_000, endUs = 6_000_000;
const about = (angle) => [Math.cos(angle / 2), 0, Math.sin(angle / 2), 0];
const held = [-0.0625, -0.125, 0], ballRadius = 0.0625, headRadius = 0.5;
const panel = "o door\nv 0 0 0\nv 0.875 0 0\nv 0.875 2 0\nv 0 2 0\nf 1 2 3\nf 1 3 4\n";

const doorPoses = Array.from({ length: endUs / 50_000 + 1 }, (_, i) => ({
  us: 50_000 * i,
  rotation: about(2 + Math.sin(i / 10)),
  position: [-0.25, 0, -0.75],
}));
/** From where it is let go of, about, to the floor. */
const ballPoses = Array.from({ length: (endUs - thrownUs) / 10_000 }, (_, i) => {
  const s = 0.01 * (i + 1);
  return { us: thrownUs + 10_000 * (i + 1), rotation: [1, 0, 0, 0], position: [-0.75 + 0.5 * s, Math.max(0.03, 1.25 + s - 4.905 * s * s), -0.5 * s] };
});
const thrown = { rotation: [1, 0, 0, 0], position: [-0.75, 1.25, 0] };

const placed = ({ rotation, position }) => `position = [${position.join(", ")}]\nrotation = [${rotation.join(", ")}]\n`;
const told = (poses) => poses.map((pose) => `[[body.pose]]\ntime = ${pose.us / 1e6}\n${placed(pose)}`).join("");

const file = `format = "foretouch-world"
version = 1
[scene]
file = "${join(examples, "room.obj")}"
[[body]]
name = "anna"
avatar = "${join(examples, "dancer.avatar.json")}"
mass = 58
[body.clip]
file = "${join(examples, "dancer.bvh")}"
until = ${endUs / 1e6}
[[body]]
name = "door"
mesh = "door.obj"
${told(doorPoses)}[[body]]
name = "ball"
sphere = ${ballRadius}
mass = 0.5
${told(ballPoses)}[[body.attach]]
time = ${takenUs / 1e6}
to = "anna"
link = "RightHand"
position = [${held.join(", ")}]
[[body.detach]]
time = ${thrownUs / 1e6}
${placed(thrown)}[[trigger]]
name = "her space"
sphere = ${headRadius}
[[trigger.attach]]
time = 0
to = "anna"
link = "Head"
position = [0, 0, 0]
`;

/** What the native program reports of it: a header and events. */
export function nativeEvents() {
  const folder = mkdtempSync(join(tmpdir(), "foretouch-world-"));
  try {
    const [world, results, events] = ["world.toml", "results.jsonl", "events.jsonl"].map((name) => join(folder, name));
    writeFileSync(world, file);
    writeFileSync(join(folder, "door.obj"), panel);
    execFileSync(program, ["world", "replay", world, "-q", "--output", results, "--events", events], { stdio: "pipe" });
    const [header, ...lines] = readFileSync(events, "utf8").trim().split("\n").map((line) => JSON.parse(line));
    return { header, events: lines.filter(({ event }) => event !== undefined) };
  } finally {
    rmSync(folder, { recursive: true });
  }
}

const rigid = ({ rotation, position }) => ({ rotations: rotation, translations: position });

/** The same world in the module, with all that is known of it until the end; and its names. */
export function moduleWorld(ft) {
  const [room, door] = [example("room.obj"), panel].map(parseObj).map(({ names, ...arrays }) => ft.scene({ ...arrays, objectNames: names }));
  const dancer = ft.avatar(example("dancer.avatar.json")), clip = ft.clip(example("dancer.bvh"), { avatar: dancer });
  const sphere = ft.avatar([{ name: "ball", parent: null, offset: [0, 0, 0], lss: [{ a: [0, 0, 0], b: [0, 0, 0], radius: ballRadius }] }]);
  const world = ft.world(room);
  const anna = world.add(dancer), panelBody = world.add(door), ball = world.add(sphere);
  const follower = world.follower(0);
  follower.weigh(anna, 58);
  follower.weigh(ball, 0.5);
  for (let frame = 0; frame * clip.secondsPerFrame * 1e6 < endUs + 1; ++frame) world.push(anna, Math.round(frame * clip.secondsPerFrame * 1e6), clip.pose(frame));
  for (const pose of doorPoses) world.push(panelBody, pose.us, rigid(pose));
  const link = (name) => dancer.links.findIndex((one) => one.name === name);
  world.attach(ball, anna, takenUs, rigid({ rotation: [1, 0, 0, 0], position: held }), { link: link("RightHand") });
  world.detach(ball, thrownUs, rigid(thrown));
  for (const pose of ballPoses) world.push(ball, pose.us, rigid(pose));
  const space = world.triggers.addSphere(headRadius);
  world.attach(world.triggers.body(space), anna, 0, rigid({ rotation: [1, 0, 0, 0], position: [0, 0, 0] }), { link: link("Head") });
  return { world, follower, room, dancer, bodies: ["anna", "door", "ball"], triggers: ["her space"] };
}
