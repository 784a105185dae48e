// What makes moving pictures quick: how finely they are drawn, and the scene in fewer triangles. And
// how bars look.

import assert from "node:assert/strict";
import test from "node:test";
import { coarsened } from "../build/scene3d/coarse.js";
import { palettes } from "../build/scene3d/palette.js";
import { Pace } from "../build/scene3d/pace.js";
import { rayToSegment } from "../build/scene3d/picking.js";
import { BarPainter } from "../build/timeline/bars.js";

test("slow frames are drawn with fewer pixels and triangles, quick ones with more again", () => {
  const pace = new Pace();
  const tell = (milliseconds, times) => Array.from({ length: times }, () => pace.took(milliseconds));
  assert.deepEqual([pace.share, pace.isCoarse, pace.maxTriangles], [1, false, null]);
  tell(40, 1);
  tell(20, 1);
  tell(40, 1);
  assert.equal(pace.share, 1, "one slow frame says nothing");
  tell(40, 1);
  assert.deepEqual([pace.share, pace.isCoarse], [0.75, true]);
  const shares = [], triangles = [];
  for (let i = 0; i < 20; ++i) {
    tell(200, 2);
    shares.push(pace.share);
    triangles.push(pace.maxTriangles);
  }
  assert.ok(shares.every((share, i) => i === 0 || share <= shares[i - 1]) && triangles.every((most, i) => i === 0 || most <= triangles[i - 1]));
  const coarsest = shares[shares.length - 1];
  assert.ok(coarsest > 0 && coarsest < 0.5, "there is a coarsest");
  tell(20, 100);
  assert.equal(pace.share, coarsest, "neither slow nor quick: it stays");
  tell(10, 30);
  assert.ok(pace.share > coarsest);
  tell(10, 300);
  assert.deepEqual([pace.share, pace.isCoarse, pace.maxTriangles], [1, false, null]);
});

/** A square of `side` metres in 2 n² triangles, and beside it a thread a millimetre thick. */
function squareAndThread(side, n) {
  const positions = [], indices = [];
  for (let i = 0; i <= n; ++i) for (let k = 0; k <= n; ++k) positions.push((side * i) / n, 0, (side * k) / n);
  const at = (i, k) => (n + 1) * i + k;
  for (let i = 0; i < n; ++i) for (let k = 0; k < n; ++k) {
    indices.push(at(i, k), at(i + 1, k), at(i, k + 1), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1));
  }
  const first = positions.length / 3;
  positions.push(5, 0, 0, 5, 1, 0, 5.001, 1, 0);
  indices.push(first, first + 1, first + 2);
  return { positions: Float32Array.from(positions), indices: Uint32Array.from(indices), first };
}

test("the coarse scene covers what the fine one does, and keeps threads as lines", () => {
  const { positions, indices, first } = squareAndThread(2, 100);
  const { triangles, lines } = coarsened(positions, indices, 2000);
  assert.ok(triangles.length / 3 <= 2000 && triangles.length > 0);
  let area = 0;
  for (let i = 0; i < triangles.length; i += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => triangles[i + k]);
    const side = (p, q, axis) => positions[3 * q + axis] - positions[3 * p + axis];
    area += Math.abs(side(a, b, 0) * side(a, c, 2) - side(a, b, 2) * side(a, c, 0)) / 2;
  }
  assert.ok(Math.abs(area - 4) < 0.5, `${area} of 4 square metres`);
  assert.ok([...lines].includes(first) && [...lines].includes(first + 1), "the thread");
});

test("few triangles stay, merged within the smallest cell alone", () => {
  const { positions, indices } = squareAndThread(2, 10);
  assert.equal(coarsened(positions, indices, 1000).triangles.length, indices.length - 3);
});

test("a bar of the person is light where a touch is possible, solid on all of these where it is certain, else outlined", () => {
  const { person: solid, perhaps } = palettes.light;
  const drawn = (...all) => {
    const areas = [], context = {
      fillRect(x, y, width) { areas.push({ x, width, colour: this.fillStyle }); },
      strokeRect() { areas.push("outline"); },
    };
    const painter = new BarPainter(context, palettes.light);
    for (const certain of all) painter.bar({ stance: null, person: { begin: 1, end: 3, certain } }, 100, 300, 0, 12, false);
    painter.drawCertain();
    painter.drawCertain();
    return areas;
  };
  const light = { x: 100, width: 200, colour: perhaps };
  assert.deepEqual(drawn(null), [light, "outline"]);
  assert.deepEqual(drawn({ from: 1.5, to: 2 }, null), [light, light, "outline", { x: 150, width: 50, colour: solid }]);
  const [, instant, ...more] = drawn({ from: 3, to: 3 });
  assert.ok(instant.width > 0 && instant.x + instant.width <= 300 && more.length === 0, "an instant is seen, within the bar");
});

/** Of a point from a segment, by the plain formula. */
function distanceToSegment(p, a, b) {
  const sub = (x, y) => x.map((v, i) => v - y[i]), dot = (x, y) => x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
  const axis = sub(b, a), square = dot(axis, axis);
  const share = square > 0 ? Math.min(1, Math.max(0, dot(sub(p, a), axis) / square)) : 0;
  return Math.hypot(...sub(p, a.map((v, i) => v + share * axis[i])));
}

test("a ray enters a capsule where its surface is, and not before", () => {
  let seed = 1, hits = 0, misses = 0;
  const random = () => 2 * ((seed = (seed * 16807) % 2147483647) / 2147483647) - 1, point = () => [random(), random(), random()];
  for (let i = 0; i < 2000; ++i) {
    const a = point(), b = i % 10 === 0 ? a : point(), radius = 0.05 + 0.2 * Math.abs(random());
    const share = random(), aside = point();
    const origin = point().map((v) => 3 * v), to = a.map((v, k) => v + share * (b[k] - v) + 0.3 * aside[k]), length = Math.hypot(...to.map((v, k) => v - origin[k]));
    const direction = to.map((v, k) => (v - origin[k]) / length);
    const at = (s) => origin.map((v, k) => v + s * direction[k]), depth = (s) => radius - distanceToSegment(at(s), a, b);
    const told = rayToSegment(origin, direction, a, b, radius);
    let first = Infinity;
    for (let s = 0; s < 9 && first === Infinity; s += 0.01) if (depth(s) >= 0) first = s;
    if (told === null) {
      assert.ok(first === Infinity, `missed: ${i}`);
      ++misses;
      continue;
    }
    ++hits;
    assert.ok(Math.abs(depth(told)) < 1e-9 || told === 0, `not on the surface: ${i}`);
    assert.ok(told <= first + 1e-9, `late: ${i}`);
    for (let s = 0; s < told - 1e-6; s += told / 50) assert.ok(depth(s) < 0, `early: ${i}`);
  }
  assert.ok(hits > 300 && misses > 300);
});
