// Rotations as quaternions w, x, y, z in flat arrays, and the arc between two of them.
// The definition is the library's (articulated/motion.h): slerp on the shorter arc, which the sign
// of the dot product decides, computed in the order w, x, y, z; zero counts as positive.

/** Makes the quaternion at `at` unit; returns the length that it had. */
export function normalise(q: Float64Array, at: number): number {
  const length = Math.hypot(q[at], q[at + 1], q[at + 2], q[at + 3]);
  if (length > 0) for (let i = 0; i < 4; ++i) q[at + i] /= length;
  return length;
}

/** out = slerp(from, to, u); each at its place in its array. Both unit. */
export function slerp(
  from: Float64Array,
  fromAt: number,
  to: Float64Array,
  toAt: number,
  u: number,
  out: Float64Array,
  outAt: number,
): void {
  const w0 = from[fromAt], x0 = from[fromAt + 1], y0 = from[fromAt + 2], z0 = from[fromAt + 3];
  let w1 = to[toAt], x1 = to[toAt + 1], y1 = to[toAt + 2], z1 = to[toAt + 3];
  const dot = w0 * w1 + x0 * x1 + y0 * y1 + z0 * z1;
  if (dot < 0) {
    w1 = -w1;
    x1 = -x1;
    y1 = -y1;
    z1 = -z1;
  }
  // conj(from) * to: its vector part keeps its digits where the two are nearly the same.
  const vx = w0 * x1 - w1 * x0 - (y0 * z1 - z0 * y1);
  const vy = w0 * y1 - w1 * y0 - (z0 * x1 - x0 * z1);
  const vz = w0 * z1 - w1 * z0 - (x0 * y1 - y0 * x1);
  const sine = Math.hypot(vx, vy, vz);
  const half = Math.atan2(sine, Math.abs(dot)) * u;
  const scale = sine > 0 ? Math.sin(half) / sine : 0;
  const w = Math.cos(half), x = vx * scale, y = vy * scale, z = vz * scale;
  out[outAt] = w0 * w - x0 * x - y0 * y - z0 * z;
  out[outAt + 1] = w0 * x + x0 * w + y0 * z - z0 * y;
  out[outAt + 2] = w0 * y - x0 * z + y0 * w + z0 * x;
  out[outAt + 3] = w0 * z + x0 * y - y0 * x + z0 * w;
}

/** The quaternion at `at` becomes by * it. */
export function multiply(by: Float64Array, q: Float64Array, at: number): void {
  const w0 = by[0], x0 = by[1], y0 = by[2], z0 = by[3];
  const w1 = q[at], x1 = q[at + 1], y1 = q[at + 2], z1 = q[at + 3];
  q[at] = w0 * w1 - x0 * x1 - y0 * y1 - z0 * z1;
  q[at + 1] = w0 * x1 + x0 * w1 + y0 * z1 - z0 * y1;
  q[at + 2] = w0 * y1 - x0 * z1 + y0 * w1 + z0 * x1;
  q[at + 3] = w0 * z1 + x0 * y1 - y0 * x1 + z0 * w1;
}

/** Turns the vector at `at` by a unit quaternion: v + 2 q × (q × v + w v). */
export function rotate(by: Float64Array, v: Float64Array, at: number): void {
  const w = by[0], x = by[1], y = by[2], z = by[3];
  const vx = v[at], vy = v[at + 1], vz = v[at + 2];
  const cx = y * vz - z * vy + w * vx, cy = z * vx - x * vz + w * vy, cz = x * vy - y * vx + w * vz;
  v[at] = vx + 2 * (y * cz - z * cy);
  v[at + 1] = vy + 2 * (z * cx - x * cz);
  v[at + 2] = vz + 2 * (x * cy - y * cx);
}
