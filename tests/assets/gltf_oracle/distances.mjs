// How far what two readers see is apart.

export const distance = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);

/// LSS as a set, [ax, ay, az, bx, by, bz, radius] each: either end may come first.
export function farthestLss(a, b) {
  if (a.length !== b.length) return Infinity;
  const between = (s, t) => {
    const [p, q, u, v] = [s.slice(0, 3), s.slice(3, 6), t.slice(0, 3), t.slice(3, 6)];
    return Math.max(
      Math.abs(s[6] - t[6]),
      Math.min(
        Math.max(distance(p, u), distance(q, v)),
        Math.max(distance(p, v), distance(q, u)),
      ),
    );
  };
  return Math.max(0, ...a.map((s) => Math.min(...b.map((t) => between(s, t)))));
}
