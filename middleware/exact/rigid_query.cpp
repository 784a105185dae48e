// From one instant that is proven free to the next: a plane that separates the triangles now, held
// still, separates them until one of six cubics vanishes. Why it is sound, how fast it gets there
// and what ends it: middleware/exact/rigid_query.md.
#include "middleware/exact/rigid_query.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "lss/assert.h"
#include "lss/segment_triangle.h"
#include "middleware/exact/rigid_curves.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using internal::Cubic;

/// Planes tried before contact is reported although it is not proved: errs early. Measured: five
/// in a million queries need more than 40 (tests/middleware/exact/rigid_query_test.cpp).
constexpr int kMaxPlanes = 400;
/// Resolution of the instant up to which a plane is proved to separate.
constexpr double kTimeResolution = 0x1p-50;
constexpr int kMaxClips = 100;  // cost only: stopping early is sound
/// Contact is reported where the separation is within this many times the position error: at one
/// time the error, the planes could not tell.
constexpr double kErrorsFromContact = 6.0;
/// Below this share of the extent the difference of the closest points is a noisy direction.
constexpr double kNoisyDirection = 1e-2;
constexpr double kUnitShrink = 1.0 - 0x1p-50;
/// rigidBand: kErrorsFromContact position errors, (8 + 1) extents by 1-norms, |q|^2 within a factor
/// of 32 of its largest: 6 * 128 * 9 * 32 u < 2^18 u.
constexpr double kRigidBand = 0x1p-35;
constexpr double kUnderflow = 1e-150;

/// Two triangles at one instant, relative to the fixed one's first vertex.
struct Closest {
  Vector3d difference = Vector3d::Zero();  // from the fixed triangle to the moving one
  Vector3d onMoving = Vector3d::Zero(), onFixed = Vector3d::Zero();
  Vector3d normal = Vector3d::Zero();  // of the features that face each other; free sign
  double distance = std::numeric_limits<double>::infinity();
};

/// The closest points have one on an edge of one of the triangles.
Closest closestOf(const Triangle& moving, const Triangle& fixed) {
  Closest closest;
  const auto consider = [&](const Triangle& edges, int i, const Triangle& face, bool edgesMove) {
    const ClosestPoints found = closestPoints(edges.vertices[i], edges.vertices[(i + 1) % 3], face);
    if (!(found.distance < closest.distance)) return;
    closest.distance = found.distance;
    closest.difference = edgesMove ? found.difference : Vector3d(-found.difference);
    closest.onMoving = edgesMove ? found.onSegment : found.onTriangle;
    closest.onFixed = edgesMove ? found.onTriangle : found.onSegment;
    closest.normal = found.featureNormal;
  };
  for (int i = 0; i < 3; ++i) {
    consider(moving, i, fixed, true);
    consider(fixed, i, moving, false);
  }
  return closest;
}

/// The part of a triangle that holds a point of it, up to the point's accuracy.
Feature featureAt(const Triangle& triangle, const Vector3d& point, double accuracy) {
  const auto& v = triangle.vertices;
  for (std::uint8_t i = 0; i < 3; ++i) {
    if ((v[i] - point).norm() <= accuracy) return {FeatureKind::Vertex, i};
  }
  for (std::uint8_t i = 0; i < 3; ++i) {
    const Vector3d along = v[(i + 1) % 3] - v[i];
    const double length2 = along.squaredNorm();
    const double s =
        length2 > 0.0 ? std::clamp((point - v[i]).dot(along) / length2, 0.0, 1.0) : 0.0;
    if ((v[i] + s * along - point).norm() <= accuracy) return {FeatureKind::Edge, i};
  }
  return {FeatureKind::Face, 0};
}

/// Up to which share of its span the hull of a cubic's coefficients lies above `bound`: the first
/// crossing of any line from a coefficient above to one below.
double shareAbove(const Cubic& part, double bound) {
  double share = 1.0;
  for (int i = 0; i < 4; ++i) {
    for (int k = 0; k < 4; ++k) {
      if (!(part[i] > bound && part[k] <= bound)) continue;
      const double crossing = i + (k - i) * ((part[i] - bound) / (part[i] - part[k]));
      share = std::min(share, crossing / 3.0);
    }
  }
  return share;
}

/// An instant up to which the cubic, which exceeds `bound` at `start`, is proved to exceed it:
/// `end` or just before it falls to `bound`. A cubic lies in the hull of its
/// coefficients.
double provedPositiveUntil(const Cubic& cubic, double start, double end, double bound) {
  double free = start, window = end - start;
  for (int i = 0; i < kMaxClips; ++i) {
    const double to = std::min(end, free + window);
    const Cubic part = internal::restrictTo(cubic, free, to);
    if (internal::strictSign(part, bound) > 0) {
      free = to;
      if (to == end) return end;
      window *= 4.0;
      continue;
    }
    const double share = shareAbove(part, bound);
    const double step = share * (to - free);
    if (!(part[0] > bound && step > kTimeResolution)) return free;
    free += step;
    window = std::min(window, 8.0 * step);
  }
  return free;
}

class Advancement {
 public:
  Advancement(const NlerpMotion& motion, const Triangle& moving_L, const Triangle& fixed_W,
              double band)
      : curves_(motion, moving_L, fixed_W.vertices[0]), band_(band) {
    double extent = 0.0;
    for (int i = 0; i < 3; ++i) {
      fixed_.vertices[i] = fixed_W.vertices[i] - fixed_W.vertices[0];
      extent = std::max(extent, fixed_.vertices[i].lpNorm<1>());
    }
    planeScale_ = curves_.scale() + curves_.largestWeight() * (extent + band);
  }

  RigidAnswer answer() {
    RigidAnswer answer;
    double free = 0.0;
    for (int planes = 0; planes < kMaxPlanes; ++planes) {
      const Triangle moving = curves_.at(free);
      const Closest closest = closestOf(moving, fixed_);
      const double error = contactError(free);
      if (closest.distance <= band_ + error) return hit(free, moving, closest, error);
      const double next = advance(free, planeAt(moving, closest));
      if (next >= 1.0) return answer;
      if (next <= free) return hit(free, moving, closest, error);
      free = next;
    }
    const Triangle moving = curves_.at(free);
    return hit(free, moving, closestOf(moving, fixed_), contactError(free));
  }

 private:
  double contactError(double t) const {
    return kErrorsFromContact * internal::kRigidRounding * planeScale_ /
               internal::valueAt(curves_.weight(), t) +
           kUnderflow;
  }

  RigidAnswer hit(double free, const Triangle& moving, const Closest& closest, double error) const {
    RigidAnswer answer;
    answer.leaf.hits = true;
    answer.leaf.toiLow = free;
    answer.leaf.toiHigh = std::min(1.0, free + kLeafTimeAccuracy);
    answer.startsInContact = free == 0.0;
    const double accuracy = std::max(1e3 * error, 0x1p-30 * closest.distance);
    answer.moving = featureAt(moving, closest.onMoving, accuracy);
    answer.fixed = featureAt(fixed_, closest.onFixed, accuracy);
    return answer;
  }

  /// The gap along n (|n| <= 1) between the triangles; negative: n does not separate them.
  double gapAlong(const Vector3d& n, const Triangle& moving) const {
    const auto& m = moving.vertices;
    return std::min({n.dot(m[0]), n.dot(m[1]), n.dot(m[2])}) - topAlong(n);
  }
  double topAlong(const Vector3d& n) const {
    return std::max({0.0, n.dot(fixed_.vertices[1]), n.dot(fixed_.vertices[2])});
  }

  /// The direction with the widest gap: along the closest points' difference, and where that is
  /// noisy along the normals of what faces each other.
  Vector3d planeAt(const Triangle& moving, const Closest& closest) const {
    Vector3d best = Vector3d::Zero();
    double widest = -std::numeric_limits<double>::infinity();
    const auto offer = [&](const Vector3d& direction) {
      const double norm = direction.norm();
      if (!(norm > 0.0)) return;
      const Vector3d n = (kUnitShrink / norm) * direction;
      const double gap = gapAlong(n, moving);
      if (gap > widest) {
        widest = gap;
        best = n;
      }
    };
    offer(closest.difference);
    if (closest.distance < kNoisyDirection * planeScale_) {
      offer(closest.normal);
      offer(-closest.normal);
      offerAcrossEdges(moving, closest.difference, offer);
    }
    return best;
  }

  /// What is left of the difference across each edge: accurate where a vertex faces an edge.
  template <class Offer>
  void offerAcrossEdges(const Triangle& moving, const Vector3d& difference, Offer&& offer) const {
    for (const Triangle* triangle : {&moving, &fixed_}) {
      for (int i = 0; i < 3; ++i) {
        const Vector3d along = triangle->vertices[(i + 1) % 3] - triangle->vertices[i];
        const double length2 = along.squaredNorm();
        if (length2 > 0.0) offer(difference - (difference.dot(along) / length2) * along);
      }
    }
  }

  /// Until when the plane keeps the triangles more than the band apart.
  double advance(double free, const Vector3d& n) const {
    const double top = topAlong(n) + band_;
    // Twice the rounding: the second half is for the instants, rounded themselves.
    const double bound = 2.0 * internal::kRigidRounding * planeScale_ + kUnderflow;
    double until = 1.0;
    for (int i = 0; i < 3 && until > free; ++i) {
      Cubic gap = curves_.along(n, i);
      for (int j = 0; j < 4; ++j) gap[j] -= top * curves_.weight()[j];
      until = provedPositiveUntil(gap, free, until, bound);
    }
    return until;
  }

  internal::RigidCurves curves_;
  Triangle fixed_;
  double band_, planeScale_;
};

bool admitted(const Quaternion& q) {
  const double norm = q.norm();
  return norm >= 0.5 && norm <= 2.0;
}

}  // namespace

RigidAnswer rigidTrianglePair(const NlerpMotion& motion, const Triangle& moving_L,
                              const Triangle& fixed_W, double band) {
  FORETOUCH_ASSERT(admitted(motion.q0) && admitted(motion.q1));
  FORETOUCH_ASSERT(motion.q0.coeffs().dot(motion.q1.coeffs()) >= 0.0 && band >= 0.0);
  return Advancement(motion, moving_L, fixed_W, band).answer();
}

double rigidBand(double extent) {
  return kRigidBand * extent + kUnderflow;
}

}  // namespace foretouch
