#include "bench/generated_queries.h"

#include <cmath>

#include "tools/portable_random.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;

Vector3d at(const LinearPoint& p, double t) {
  return p.from + t * (p.to - p.from);
}

/// Shifts `count` points from `first` on, as a whole, so that `one` meets `other` at t up to
/// rounding.
void shift(std::array<LinearPoint, 4>& points, std::size_t count, const Vector3d& by) {
  for (std::size_t i = 0; i < count; ++i) {
    points[i].from += by;
    points[i].to += by;
  }
}

void makeMeet(QueryKind kind, std::array<LinearPoint, 4>& p, PortableRandom& random) {
  const double t = random.uniform(0, 1), u = random.uniform(0, 1), v = random.uniform(0, 1);
  if (kind == QueryKind::VertexFace) {
    const double first = u + v > 1 ? 1 - u : u, second = u + v > 1 ? 1 - v : v;
    const Vector3d onFace =
        at(p[1], t) + first * (at(p[2], t) - at(p[1], t)) + second * (at(p[3], t) - at(p[1], t));
    shift(p, 1, onFace - at(p[0], t));
  } else {
    const Vector3d one = at(p[0], t) + u * (at(p[1], t) - at(p[0], t));
    const Vector3d other = at(p[2], t) + v * (at(p[3], t) - at(p[2], t));
    shift(p, 2, other - one);
  }
}

Triangle randomTriangle(PortableRandom& random, double half, const Vector3d& center) {
  Triangle t;
  for (Vector3d& v : t.vertices) v = center + random.inBox(half);
  return t;
}

}  // namespace

std::vector<LabelledQuery> generatedQueries(QueryKind kind, std::size_t count, std::uint64_t seed) {
  PortableRandom random(seed);
  std::vector<LabelledQuery> queries(count);
  for (LabelledQuery& query : queries) {
    for (LinearPoint& p : query.points) {
      p.from = random.inBox(0.5);
      p.to = p.from + random.inBox(0.5);
    }
    if (random.uniform(0, 1) < 0.5) makeMeet(kind, query.points, random);
  }
  return queries;
}

std::vector<RigidPair> generatedRigidPairs(std::size_t count, std::uint64_t seed) {
  PortableRandom random(seed);
  std::vector<RigidPair> pairs(count);
  for (RigidPair& pair : pairs) {
    pair.moving_L = randomTriangle(random, 0.1, random.inBox(0.2));
    pair.fixed_W = randomTriangle(random, 0.1, Vector3d::Zero());
    Quaternion from(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1), 1.0);
    from.normalize();
    const Eigen::AngleAxisd turn(random.uniform(0, 1), random.inBox(1.0).normalized());
    const Quaternion to = from * Quaternion(turn);
    // The triangle's first vertex passes near the middle of the one at rest halfway.
    const Vector3d arm = from * pair.moving_L.vertices[0];
    pair.motion.x0 = random.inBox(0.25) - arm;
    pair.motion.x1 = random.inBox(0.25) - arm;
    pair.motion.q0 = from;
    pair.motion.q1 = to;
  }
  return pairs;
}

}  // namespace foretouch::tools
