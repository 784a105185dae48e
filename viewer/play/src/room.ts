// The room that the page brings: floor, walls, a table, a shelf, and a board of 4 mm to reach through.
// Boxes, each an object. Metres.

import type { SceneMesh } from "./messages.js";

type Box = readonly [name: string, x: number, y: number, z: number, width: number, height: number, depth: number];

const legs = (name: string, x: number, z: number, width: number, depth: number, height: number): Box[] =>
  [-1, 1].flatMap((a) => [-1, 1].map((b): Box => [name, x + (a * width) / 2, height / 2, z + (b * depth) / 2, 0.05, height, 0.05]));

const boxes: readonly Box[] = [
  ["floor", 0, -0.05, 0, 5, 0.1, 4],
  ["back wall", 0, 1.25, -2.03, 5, 2.5, 0.06],
  ["left wall", -2.53, 1.25, 0, 0.06, 2.5, 4],
  ["table", 0.6, 0.735, -0.9, 1.4, 0.03, 0.75],
  ...legs("table", 0.6, -0.9, 1.28, 0.63, 0.72),
  ["book", 0.95, 0.765, -0.95, 0.22, 0.03, 0.3],
  ["cup", 0.35, 0.8, -1.0, 0.07, 0.1, 0.07],
  ["board of 4 mm", -0.7, 1.15, -0.5, 0.004, 0.7, 0.9],
  ["stand", -0.7, 0.4, -0.5, 0.06, 0.8, 0.06],
  ["stand", -0.7, 0.015, -0.5, 0.3, 0.03, 0.4],
  ["shelf", -1.7, 0.9, -1.75, 0.03, 1.8, 0.4],
  ["shelf", -0.9, 0.9, -1.75, 0.03, 1.8, 0.4],
  ...[0.2, 0.6, 1.0, 1.4, 1.79].map((y): Box => ["shelf", -1.3, y, -1.75, 0.77, 0.025, 0.4]),
  ["chair", 0.7, 0.45, 0.1, 0.42, 0.04, 0.42],
  ["chair", 0.7, 0.75, 0.3, 0.42, 0.5, 0.03],
  ...legs("chair", 0.7, 0.1, 0.36, 0.36, 0.43),
];

export const roomName = "the page's own room";

export interface NamedScene extends SceneMesh {
  readonly name: string;
  readonly objectNames: readonly string[];
}

export function ownRoom(): NamedScene {
  const objectNames = [...new Set(boxes.map(([name]) => name))];
  const positions: number[] = [], indices: number[] = [], objects: number[] = [];
  const faces = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
  for (const [name, x, y, z, width, height, depth] of boxes) {
    const first = positions.length / 3;
    for (const a of [-1, 1]) for (const b of [-1, 1]) for (const c of [-1, 1]) positions.push(x + (a * width) / 2, y + (b * height) / 2, z + (c * depth) / 2);
    for (const [p, q, r, s] of faces) {
      indices.push(first + p, first + q, first + r, first + p, first + r, first + s);
      objects.push(objectNames.indexOf(name), objectNames.indexOf(name));
    }
  }
  return { name: roomName, objectNames, positions: Float32Array.from(positions), indices: Uint32Array.from(indices), objects: Int32Array.from(objects) };
}
