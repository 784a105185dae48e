// A dancer, tracked 30 times per second, and a door that swings, known 60 times per second: when does
// which link meet the door?

import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { Foretouch } from "foretouch";

const ft = await Foretouch.load(readFileSync(createRequire(import.meta.url).resolve("foretouch/foretouch.wasm")));
const turn = 2 * Math.PI;
const aboutY = (angle) => [Math.cos(0.5 * angle), 0, Math.sin(0.5 * angle), 0];

/** What the tracker says. Yours; here somebody turns, and swings an arm. */
const trackedDancer = (s) => ({
  rotations: [...aboutY(0.4 * Math.sin(turn * 0.3 * s)), ...aboutY(1.2 * Math.sin(turn * 0.7 * s))],
  translations: [0, 0.9, 0, 0.2, 0.5, 0],
});
const trackedDoor = (s) => ({ rotations: aboutY(0.35 * Math.sin(turn * 0.5 * s)), translations: [1.3, 0, -0.35] });

// A trunk with one arm; and a panel of 0.9 by 2 m, in the frame of its hinge.
const avatar = ft.avatar([
  { name: "trunk", parent: null, offset: [0, 0.9, 0], lss: [{ a: [0, 0, 0], b: [0, 0.6, 0], radius: 0.15 }] },
  { name: "arm", parent: "trunk", offset: [0.2, 0.5, 0], lss: [{ a: [0, 0, 0], b: [0.6, 0, 0], radius: 0.05 }] },
]);
const panel = ft.scene({ positions: [0, 0, 0, -0.9, 0, 0, -0.9, 2, 0, 0, 2, 0], indices: [0, 1, 2, 0, 2, 3], objectNames: ["door"] });

const world = ft.world(); // or ft.world(scene): what never moves
const dancer = world.add(avatar); // several bodies may have one avatar
const door = world.add(panel); // a scene in the door's own frame
let answered = 0, contacts = 0, windows = 0;
for (let us = 0; us <= 4_000_000; us += 5_556) {
  if (us % 33_336 === 0) world.push(dancer, us, trackedDancer(1e-6 * us));
  if (us % 16_668 === 0) world.push(door, us, trackedDoor(1e-6 * us)); // its own clock
  const until = world.knownUntilUs; // all is known until then
  if (until <= answered) continue;
  for (const contact of world.contacts(answered, until).contacts) {
    if (contact.verdict !== "contact") continue; // it touched before
    const seconds = (1e-6 * (contact.timeUs + contact.timeFraction)).toFixed(4);
    const link = avatar.links[contact.a.link].name, object = panel.objectNames[contact.b.object];
    const place = contact.a.point.map((x) => x.toFixed(3)).join(", ");
    console.log(`${seconds} s: ${link} meets the ${object} at (${place})`);
    ++contacts;
  }
  world.forgetBefore(until);
  answered = until;
  ++windows;
}
console.log(`${contacts} contacts in ${windows} windows`);
