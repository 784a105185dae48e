"""/usr/bin/python3 dev/prototypes/tapered.py MODEL.glb...: what a second radius would give.

Of each bone of a skinned glTF: the smallest capsule (LSS) and the smallest tapered one that hold the
vertices that follow the bone most, by the same search, beside their convex hull. Volumes; points near
the bone that only the capsule, or only the tapered one, would call touched; and what a distance to a
triangle costs in a prototype of each. Needs python3-numpy, python3-scipy and g++.
"""

import json
import os
import struct
import subprocess
import sys
import tempfile

import numpy as np
from scipy.optimize import minimize
from scipy.spatial import ConvexHull, Delaunay

NEAR = 0.03  # of the bone's size: how far around its hull points are asked


def read(path):
    raw = open(path, "rb").read()
    if raw[:4] == b"glTF":
        size = struct.unpack_from("<I", raw, 12)[0]
        return json.loads(raw[20:20 + size]), raw[20 + size + 8:]
    doc = json.loads(raw)
    return doc, open(os.path.join(os.path.dirname(path), doc["buffers"][0]["uri"]), "rb").read()


def array(doc, data, index):
    a = doc["accessors"][index]
    view = doc["bufferViews"][a["bufferView"]]
    kind = {5121: np.uint8, 5123: np.uint16, 5125: np.uint32, 5126: np.float32}[a["componentType"]]
    width = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}[a["type"]]
    at = view.get("byteOffset", 0) + a.get("byteOffset", 0)
    item = np.dtype(kind).itemsize * width
    step = view.get("byteStride", item)
    rows = [np.frombuffer(data, kind, width, at + i * step) for i in range(a["count"])]
    return np.array(rows, dtype=float)


def clouds(path):
    """Per bone the vertices that follow it most, in its frame."""
    doc, data = read(path)
    points = {}
    for node in doc["nodes"]:
        if "skin" not in node or "mesh" not in node:
            continue
        bind = array(doc, data, doc["skins"][node["skin"]]["inverseBindMatrices"])
        for part in doc["meshes"][node["mesh"]]["primitives"]:
            where = array(doc, data, part["attributes"]["POSITION"])
            joints = array(doc, data, part["attributes"]["JOINTS_0"]).astype(int)
            weights = array(doc, data, part["attributes"]["WEIGHTS_0"])
            most = joints[np.arange(len(joints)), weights.argmax(axis=1)]
            for bone in set(most):
                m = bind[bone].reshape(4, 4).T
                local = where[most == bone] @ m[:3, :3].T + m[:3, 3]
                points.setdefault((node["skin"], bone), []).append(local)
    return [np.unique(np.concatenate(all), axis=0) for all in points.values()]


def distance(p, a, b, ra, rb):
    """From the surface of the hull of two spheres, outwards."""
    axis = b - a
    length = np.linalg.norm(axis)
    if length <= abs(ra - rb) + 1e-12:
        big, r = (a, ra) if ra >= rb else (b, rb)
        return np.linalg.norm(p - big, axis=1) - r
    along = (p - a) @ axis / length
    off = np.linalg.norm(p - a - np.outer(along, axis / length), axis=1)
    slope = (ra - rb) / length  # sine of the half opening
    t = np.clip(along + off * slope / np.sqrt(1 - slope * slope), 0, length)
    return np.hypot(along - t, off) - (ra + (rb - ra) * t / length)


def volume(a, b, ra, rb):
    length = np.linalg.norm(b - a)
    if length <= abs(ra - rb):
        return 4 / 3 * np.pi * max(ra, rb) ** 3
    s = (ra - rb) / length
    c = np.sqrt(1 - s * s)
    cone = np.pi / 3 * (length + (rb - ra) * s) * c * c * (ra * ra + ra * rb + rb * rb)
    cap = lambda r, h: np.pi * h * h * (3 * r - h) / 3
    return cone + cap(ra, ra * (1 + s)) + cap(rb, rb * (1 - s))


def fit(points, begin=None):
    """The smallest that the search finds, as (a, b, ra, rb): each is an upper bound."""
    tapers = begin is not None  # from the best capsule on, with either end the thicker one
    middle = points.mean(axis=0)
    _, _, axes = np.linalg.svd(points - middle, full_matrices=False)
    size = np.ptp(points, axis=0).max()

    def shape(x):
        a, b = x[:3], x[3:6]
        d = x[6] if tapers else 0.0
        ra, rb = max(0.0, -d), max(0.0, d)
        grow = distance(points, a, b, ra, rb).max()
        return a, b, ra + max(grow, 0.0), rb + max(grow, 0.0)

    starts = []
    for axis in axes:
        along = (points - middle) @ axis
        lo, hi = along.min() + 0.2 * np.ptp(along), along.max() - 0.2 * np.ptp(along)
        starts.append(np.concatenate([middle + lo * axis, middle + hi * axis]))
    if tapers:
        a, b, r, _ = begin
        starts = [np.concatenate([a, b, [d * r]]) for d in (-0.5, 0.5)]
    best = None
    for x in starts:
        for _ in range(2):
            found = minimize(lambda y: volume(*shape(y)), x, method="Nelder-Mead",
                             options={"maxiter": 400, "xatol": 1e-4 * size, "fatol": 0})
            x = found.x
        if best is None or found.fun < best[0]:
            best = (found.fun, shape(x))
    return best[1]


SPEED = r"""
#include <chrono>
#include <cmath>
#include <cstdio>
#include <random>
// A point and a triangle stand for the innermost step; a capsule's distance to a triangle needs the
// nearest of two segments as well, a tapered one's a search along its axis: distance minus radius is
// convex there.
struct V { double x, y, z; };
static V operator-(V a, V b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
static V operator+(V a, V b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
static V operator*(double s, V a) { return {s * a.x, s * a.y, s * a.z}; }
static double dot(V a, V b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static double clamp(double t) { return t < 0 ? 0 : t > 1 ? 1 : t; }
static double pointSegment(V p, V a, V b) { V d = b - a; V r = p - a - clamp(dot(p - a, d) / dot(d, d)) * d; return dot(r, r); }
static V cross(V a, V b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
static double pointTriangle(V p, const V* t) {
  V n = cross(t[1] - t[0], t[2] - t[0]);
  bool inside = true;
  for (int i = 0; i < 3; ++i) inside = inside && dot(cross(t[(i + 1) % 3] - t[i], p - t[i]), n) >= 0;
  if (inside) { double h = dot(p - t[0], n); return h * h / dot(n, n); }
  double d = pointSegment(p, t[0], t[1]);
  d = std::fmin(d, pointSegment(p, t[1], t[2]));
  return std::fmin(d, pointSegment(p, t[2], t[0]));
}
static double segments(V a, V b, V c, V d) {
  V u = b - a, v = d - c, w = a - c;
  double A = dot(u, u), B = dot(u, v), C = dot(v, v), D = dot(u, w), E = dot(v, w), det = A * C - B * B;
  double s = det > 1e-12 ? clamp((B * E - C * D) / det) : 0, t = clamp((B * s + E) / C);
  s = clamp((B * t - D) / A);
  V r = w + s * u - t * v;
  return dot(r, r);
}
static double capsule(V a, V b, double r, const V* t) {
  double d = std::fmin(pointTriangle(a, t), pointTriangle(b, t));
  for (int i = 0; i < 3; ++i) d = std::fmin(d, segments(a, b, t[i], t[(i + 1) % 3]));
  return std::sqrt(d) - r;
}
static double tapered(V a, V b, double ra, double rb, const V* t, int steps) {
  const double g = 0.6180339887498949;
  double lo = 0, hi = 1, x = hi - g, y = g;
  auto f = [&](double s) { return std::sqrt(pointTriangle(a + s * (b - a), t)) - ra - s * (rb - ra); };
  double fx = f(x), fy = f(y);
  for (int i = 0; i < steps; ++i) {
    if (fx < fy) { hi = y; y = x; fy = fx; x = hi - g * (hi - lo); fx = f(x); }
    else { lo = x; x = y; fx = fy; y = lo + g * (hi - lo); fy = f(y); }
  }
  return std::fmin(fx, fy);
}
int main() {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> u(-1, 1);
  auto point = [&] { return V{u(random), u(random), u(random)}; };
  const int n = 200000;
  double sums[2] = {0, 0}, ns[2];
  for (int kind = 0; kind < 2; ++kind) {
    random.seed(1);
    double spent = 0;
    for (int i = 0; i < n; i += 1000) {
      static V data[1000][5];
      for (auto& d : data) for (V& p : d) p = point();
      auto start = std::chrono::steady_clock::now();
      for (auto& d : data) sums[kind] += kind == 0 ? capsule(d[0], d[1], 0.1, d + 2) : tapered(d[0], d[1], 0.1, 0.1, d + 2, 16);
      spent += std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count();
    }
    ns[kind] = spent / n;
  }
  std::printf("%g %g %g\n", ns[0], ns[1], (sums[1] - sums[0]) / n);
}
"""


def speed():
    with tempfile.TemporaryDirectory() as folder:
        source, program = folder + "/s.cpp", folder + "/s"
        open(source, "w").write(SPEED)
        subprocess.run(["g++", "-O3", source, "-o", program], check=True)
        return [float(n) for n in subprocess.run([program], check=True, capture_output=True).stdout.split()]


def main():
    random = np.random.default_rng(1)
    print("| model | bones | LSS over hull, % | tapered over hull, % | points near: LSS alone touched, % | "
          "tapered alone, % |\n|---|---|---|---|---|---|")
    for path in sys.argv[1:]:
        sums, asked, false = np.zeros(3), 0, [0, 0]
        bones = 0
        for points in clouds(path):
            if len(points) < 12 or np.linalg.matrix_rank(points - points.mean(axis=0), tol=1e-6) < 3:
                continue
            hull = ConvexHull(points)
            points = points[hull.vertices]
            both = [fit(points)]
            both.append(fit(points, both[0]))
            sums += [hull.volume] + [min(volume(*one), volume(*both[0])) for one in both]
            bones += 1
            size = np.ptp(points, axis=0).max()
            box = points.min(axis=0) - NEAR * size, points.max(axis=0) + NEAR * size
            probes = random.uniform(*box, (4000, 3))
            probes = probes[Delaunay(points).find_simplex(probes) < 0]
            asked += len(probes)
            for k in (0, 1):
                false[k] += int((distance(probes, *both[k]) <= 0).sum())
        over = [100 * (v / sums[0] - 1) for v in sums[1:]]
        print(f"| {os.path.basename(path)} | {bones} | {over[0]:.0f} | {over[1]:.0f} | "
              f"{100 * false[0] / asked:.1f} | {100 * false[1] / asked:.1f} |", flush=True)
    lss, cone, apart = speed()
    print(f"\nA distance to a triangle, one thread, no lanes: LSS {lss:.0f} ns, tapered {cone:.0f} ns "
          f"({cone / lss:.1f} times); with equal radii the two differ by {apart:.1g} on average.")


main()
