// tests/oracle/leaf_families.cpp: most queries are built around a meeting and then moved a little
// off it, since random features hardly ever come near each other.
#include "tests/oracle/leaf_families.h"

#include <array>
#include <cmath>
#include <cstdio>

#include <Eigen/Dense>

namespace foretouch::test {
namespace {

using Eigen::Vector3d;
using oracle::LinearKind;
using oracle::LinearQuery;

/// The query in the making; points [0, split) are the first feature.
struct Draft {
  LinearKind kind = LinearKind::VertexFace;
  std::array<Vector3d, 4> from, to;

  [[nodiscard]] int split() const { return kind == LinearKind::EdgeEdge ? 2 : 1; }
  [[nodiscard]] Vector3d at(int i, double t) const { return from[i] + t * (to[i] - from[i]); }
  void shiftFirst(const Vector3d& by) {
    for (int i = 0; i < split(); ++i) {
      from[i] += by;
      to[i] += by;
    }
  }
  /// Where the features with these parameters are at t.
  [[nodiscard]] Vector3d onFirst(double t, double u) const {
    return split() == 1 ? at(0, t) : at(0, t) + u * (at(1, t) - at(0, t));
  }
  [[nodiscard]] Vector3d onSecond(double t, double u, double v) const {
    switch (kind) {
      case LinearKind::VertexFace:
        return at(1, t) + u * (at(2, t) - at(1, t)) + v * (at(3, t) - at(1, t));
      case LinearKind::EdgeEdge: return at(2, t) + v * (at(3, t) - at(2, t));
      case LinearKind::VertexEdge: return at(1, t) + v * (at(2, t) - at(1, t));
      case LinearKind::VertexVertex: break;
    }
    return at(1, t);
  }
  [[nodiscard]] Vector3d normal(double t) const {
    const Vector3d n = kind == LinearKind::EdgeEdge
                           ? (at(1, t) - at(0, t)).cross(at(3, t) - at(2, t))
                           : (at(2, t) - at(1, t)).cross(at(3, t) - at(1, t));
    return n.norm() > 0 ? Vector3d(n.normalized()) : Vector3d::UnitX();
  }
  [[nodiscard]] double coplanarity(double t) const {
    if (kind == LinearKind::EdgeEdge) {
      return (at(2, t) - at(0, t)).dot((at(1, t) - at(0, t)).cross(at(3, t) - at(2, t)));
    }
    return (at(0, t) - at(1, t)).dot((at(2, t) - at(1, t)).cross(at(3, t) - at(1, t)));
  }
};

/// Mostly the two kinds of a triangle pair.
LinearKind drawKind(Random& random) {
  const int n = random.below(20);
  if (n < 9) return LinearKind::VertexFace;
  if (n < 18) return LinearKind::EdgeEdge;
  return n == 18 ? LinearKind::VertexEdge : LinearKind::VertexVertex;
}

Draft drawPoints(Random& random, LinearKind kind, double travel) {
  Draft d;
  d.kind = kind;
  for (int i = 0; i < 4; ++i) {
    d.from[i] = random.inBox(1.0);
    d.to[i] = d.from[i] + random.inBox(travel);
  }
  return d;
}

/// In [0,1], or close to one of its ends on either side, by 1e-15 to 0.1.
double drawShare(Random& random) {
  if (random.chance(0.5)) return random.uniform(0, 1);
  const double gap = random.magnitude(1e-15, 0.1) * (random.chance(0.5) ? 1 : -1);
  return random.chance(0.5) ? gap : 1 + gap;
}

/// Shifts the first feature so that they meet at t with shares u and v, up to rounding.
void makeMeet(Draft& d, double t, double u, double v) {
  d.shiftFirst(d.onSecond(t, u, v) - d.onFirst(t, u));
}

/// A meeting well inside, or near the border of the features or of [0,1].
void makeMeet(Draft& d, Random& random) {
  double u = drawShare(random), v = drawShare(random);
  if (d.kind == LinearKind::VertexFace && random.chance(0.5)) {  // along the third edge
    u = random.uniform(0, 1);
    v = 1 - u + random.magnitude(1e-15, 0.1) * (random.chance(0.5) ? 1 : -1);
  }
  makeMeet(d, drawShare(random), u, v);
}

double gapOf(Random& random) {
  return random.magnitude(1e-15, 0.1) * (random.chance(0.5) ? 1 : -1);
}

LinearQuery finished(const Draft& d) {
  LinearQuery query;
  query.kind = d.kind;
  for (std::size_t i = 0; i < 4; ++i) {
    query.points[i] = {{d.from[i].x(), d.from[i].y(), d.from[i].z()},
                       {d.to[i].x(), d.to[i].y(), d.to[i].z()}};
  }
  return query;
}

Draft uniform(Random& random) {
  Draft d = drawPoints(random, drawKind(random), 2.0);
  if (random.chance(0.5)) {
    const double u = random.uniform(0, 1);
    makeMeet(d, random.uniform(0, 1), u, random.uniform(0, 1) * (1 - u));
  }
  return d;
}

Draft gaps(Random& random) {
  Draft d = drawPoints(random, drawKind(random), random.magnitude(1e-3, 2.0));
  makeMeet(d, random);
  return d;
}

/// The coplanarity and its derivative vanish at one instant: a shift by two multiples solves for
/// both, as coplanarity is linear in it. Then a gap in the direction of the normal.
Draft grazing(Random& random) {
  const LinearKind kind = random.chance(0.5) ? LinearKind::VertexFace : LinearKind::EdgeEdge;
  Draft d = drawPoints(random, kind, 2.0);
  const double t = random.uniform(0.05, 0.95), u = random.uniform(0.1, 0.5);
  makeMeet(d, t, u, random.uniform(0.1, 0.5));
  // A drift of the first feature within its own instant: it still meets at t.
  constexpr double kStep = 1e-6;
  const double slope = (d.coplanarity(t + kStep) - d.coplanarity(t - kStep)) / (2 * kStep);
  const Vector3d n = d.normal(t);
  Draft moved = d;
  for (int i = 0; i < d.split(); ++i) {
    moved.from[i] -= t * n;
    moved.to[i] += (1 - t) * n;
  }
  const double other = (moved.coplanarity(t + kStep) - moved.coplanarity(t - kStep)) / (2 * kStep);
  constexpr double kMostShare = 100;  // where the drift does nothing, there is nothing to solve
  const double solved = slope / (slope - other);
  const double share = std::abs(solved) <= kMostShare ? solved : 0.0;
  for (int i = 0; i < d.split(); ++i) {
    d.from[i] -= share * t * n;
    d.to[i] += share * (1 - t) * n;
  }
  d.shiftFirst(gapOf(random) * n);
  return d;
}

Draft slivers(Random& random) {
  Draft d = drawPoints(random, drawKind(random), random.magnitude(1e-3, 2.0));
  const double height = random.magnitude(1e-12, 1e-2), share = random.uniform(-0.2, 1.2);
  const int a = d.kind == LinearKind::EdgeEdge ? 2 : 1;
  const Vector3d thin = height * random.direction(), thinLater = height * random.direction();
  if (d.kind == LinearKind::VertexFace) {  // the third vertex almost on the opposite edge
    d.from[3] = d.from[1] + share * (d.from[2] - d.from[1]) + thin;
    d.to[3] = d.to[1] + share * (d.to[2] - d.to[1]) + thinLater;
  } else {  // a short edge
    d.from[a + 1] = d.from[a] + thin;
    d.to[a + 1] = d.to[a] + thinLater;
  }
  makeMeet(d, random);
  return d;
}

/// Edges that are almost parallel throughout; a vertex that almost stays in the face's plane.
Draft parallel(Random& random) {
  const LinearKind kind = random.chance(0.7) ? LinearKind::EdgeEdge : LinearKind::VertexFace;
  Draft d = drawPoints(random, kind, random.magnitude(1e-2, 1.0));
  const double off = random.chance(0.1) ? 0.0 : random.magnitude(1e-15, 1e-3);
  if (kind == LinearKind::EdgeEdge) {
    const double factor = random.uniform(0.3, 3.0) * (random.chance(0.5) ? 1 : -1);
    d.from[3] = d.from[2] + factor * (d.from[1] - d.from[0]) + off * random.inBox(1.0);
    d.to[3] = d.to[2] + factor * (d.to[1] - d.to[0]) + off * random.inBox(1.0);
  } else {
    d.from[0] = d.onSecond(0, random.uniform(-1, 2), random.uniform(-1, 2)) + off * random.inBox(1);
    d.to[0] = d.onSecond(1, random.uniform(-1, 2), random.uniform(-1, 2)) + off * random.inBox(1);
    return d;
  }
  makeMeet(d, random);
  d.shiftFirst(random.chance(0.3) ? Vector3d(off * random.direction()) : Vector3d::Zero());
  return d;
}

/// Small integers: every degenerate case there is, exactly.
Draft onLattice(Random& random, int dimensions) {
  Draft d;
  d.kind = static_cast<LinearKind>(random.below(4));
  const int half = 1 + random.below(3);
  const auto draw = [&](int axis) {
    return axis < dimensions ? static_cast<double>(random.below(2 * half + 1) - half) : 0.0;
  };
  for (int i = 0; i < 4; ++i) {
    d.from[i] = {draw(0), draw(1), draw(2)};
    d.to[i] = random.chance(0.3) ? d.from[i] : Vector3d(draw(0), draw(1), draw(2));
  }
  return d;
}

/// A plane through the lattice, or a line of it, tilted by whole numbers.
Draft plane(Random& random) {
  Draft d = onLattice(random, random.chance(0.8) ? 2 : 1);
  Eigen::Matrix3d tilt;
  for (double& c : tilt.reshaped()) c = random.below(5) - 2;
  for (int i = 0; i < 4; ++i) {
    d.from[i] = tilt * d.from[i];
    d.to[i] = tilt * d.to[i];
  }
  return d;
}

Draft lattice(Random& random) {
  return onLattice(random, 3);
}

Draft any(Random& random) {
  switch (random.below(4)) {
    case 0: return gaps(random);
    case 1: return grazing(random);
    case 2: return slivers(random);
    default: return parallel(random);
  }
}

Draft far(Random& random) {
  Draft d = any(random);
  const Vector3d offset = random.magnitude(1.0, 1e6) * random.direction();
  for (int i = 0; i < 4; ++i) {
    d.from[i] += offset;
    d.to[i] += offset;
  }
  return d;
}

Draft scaled(Random& random) {
  Draft d = any(random);
  const double factor = random.magnitude(1e-6, 1e6);
  for (int i = 0; i < 4; ++i) {
    d.from[i] *= factor;
    d.to[i] *= factor;
  }
  return d;
}

template <Draft (*draw)(Random&)>
LinearQuery query(Random& random) {
  return finished(draw(random));
}

}  // namespace

const std::vector<LinearFamily>& linearFamilies() {
  static const std::vector<LinearFamily> families = {
      {"uniform", query<uniform>, 0.3, 0.7},   {"gaps", query<gaps>, 0.1, 0.7},
      {"grazing", query<grazing>, 0.2, 0.8},   {"slivers", query<slivers>, 0.1, 0.7},
      {"parallel", query<parallel>, 0.1, 0.7}, {"lattice", query<lattice>, 0.1, 0.7},
      {"plane", query<plane>, 0.2, 0.8},       {"far", query<far>, 0.1, 0.7},
      {"scaled", query<scaled>, 0.1, 0.7},
  };
  return families;
}

LinearQuery drawLinear(std::size_t family, std::uint64_t seed, std::uint64_t index) {
  constexpr std::uint64_t kMix = 0xd1342543de82ef95u;  // spreads what is mixed; any odd number
  Random random((seed * kMix + family) * kMix + index);
  return linearFamilies()[family].draw(random);
}

std::string inHex(const LinearQuery& query) {
  std::string text;
  for (const auto end : {&oracle::Path::from, &oracle::Path::to}) {
    for (const oracle::Path& path : query.points) {
      const oracle::Vec3d& v = path.*end;
      std::array<char, 128> row{};
      std::snprintf(row.data(), row.size(), "%a %a %a\n", v.x, v.y, v.z);
      text += row.data();
    }
  }
  return text;
}

}  // namespace foretouch::test
