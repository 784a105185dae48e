// From one instant that is proven free to the next: a plane that separates the triangles now, moved
// in a simple way, separates them until one of a few cubics vanishes. Soundness, convergence and
// termination: tests/reference/rigid_query.md.
#include "tests/reference/rigid_query.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "lss/assert.h"
#include "lss/rounding.h"
#include "lss/segment_triangle.h"
#include "tests/reference/rigid_curves.h"
#include "tests/reference/rigid_plane.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using internal::Cubic;
using internal::kUnderflow;
using internal::kUnitShrink;

/// Rounds of planes before it reports contact without proof: errs early. The most that a million
/// awkward queries needed is between 200 and 400 (two slivers that slide past each other).
constexpr int kMaxPlanes = 2000;
/// Resolution of the instant up to which a plane is proved to separate.
constexpr double kTimeResolution = 0x1p-50;
constexpr int kMaxClips = 100;  // cost only: stopping early is sound
/// Reports contact if the separation is within this many times the position error; at one time the
/// error, the planes could not decide.
constexpr double kErrorsFromContact = 6.0;
/// Below this share of the extent the difference of the closest points is a noisy direction.
constexpr double kNoisyDifference = 1e-2;
/// A closest point counts as on a vertex or an edge this near (share of the extent). Cost only: it
/// chooses a plane to try.
constexpr double kNearFeature = 1e-9;
/// How far beyond the proved time to try a plane along two edges, in multiples of that time, and at
/// least.
constexpr double kWindow = 32.0, kLeastWindow = 0x1p-20;
constexpr double kTurnedShrink = 1.0 - 0x1p-46;  // turning by a quaternion errs by below 30 u
/// rigidBand: kErrorsFromContact position errors, (8 + 1) extents by 1-norms, |q|^2 within a factor
/// of 32 of its largest: 6 * 128 * 9 * 32 u < 2^18 u = 2^-35. Slivers need more: if both triangles
/// are thinner than their distance is long, no tried plane separates them within about 1e-9 extents
/// (seen: 8e-10).
constexpr double kRigidBand = 0x1p-28;

/// Two triangles at one instant, relative to the fixed one's first vertex.
struct Closest {
  Vector3d difference = Vector3d::Zero();  // from the fixed triangle to the moving one
  Vector3d onMoving = Vector3d::Zero(), onFixed = Vector3d::Zero();
  Vector3d normal = Vector3d::Zero();  // of the features that face each other; arbitrary sign
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
      : curves_(motion, moving_L, fixed_W.vertices[0]), moving_L_(moving_L), band_(band) {
    double extent = 0.0;
    for (int i = 0; i < 3; ++i) {
      fixed_.vertices[i] = fixed_W.vertices[i] - fixed_W.vertices[0];
      extent = std::max(extent, fixed_.vertices[i].lpNorm<1>());
    }
    planeScale_ = curves_.scale() + curves_.largestWeight() * (extent + band);
  }

  /// Precondition: the triangles are proved apart on [0, free).
  RigidAnswer answerFrom(double free) const {
    RigidAnswer answer;
    if (free >= 1.0) return answer;
    for (int planes = 0; planes < kMaxPlanes; ++planes) {
      const Triangle moving = curves_.at(free);
      const Closest closest = closestOf(moving, fixed_);
      const double error = contactError(free);
      if (closest.distance <= band_ + error) return hit(free, moving, closest, error);
      const double next = advance(free, moving, closest);
      if (next >= 1.0) return answer;
      if (next <= free) return hit(free, moving, closest, error);
      free = next;
    }
    const Triangle moving = curves_.at(free);
    return hit(free, moving, closestOf(moving, fixed_), contactError(free));
  }

  /// Up to which instant a fixed plane normal to n (|n| <= 1) keeps the triangles more than the
  /// band apart, from `free` on.
  double untilStill(double free, const Vector3d& n) const {
    const double top = topAlong(n) + band_;
    double until = 1.0;
    for (int i = 0; i < 3 && until > free; ++i) {
      Cubic gap = curves_.along(n, i);
      for (int j = 0; j < 4; ++j) gap[j] -= top * curves_.weight()[j];
      until = provedPositiveUntil(gap, free, until, planeBound());
    }
    return until;
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
    // The sum may round up by half a unit in the last place; one below keeps the stated width.
    answer.leaf.toiHigh = std::min(1.0, std::nextafter(free + kLeafTimeAccuracy, 0.0));
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

  /// The direction with the widest gap: along the closest points' difference and, if that is noisy,
  /// along the normals of the features that face each other.
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
    if (closest.distance < kNoisyDifference * planeScale_) {
      offer(closest.normal);
      offer(-closest.normal);
      offerAcrossEdges(moving, closest.difference, offer);
    }
    return best;
  }

  /// The part of the difference normal to each edge: accurate when a vertex faces an edge.
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

  /// The furthest instant up to which one of three planes keeps the triangles more than the band
  /// apart: one that stands still, one that turns with the body, one along both closest edges.
  double advance(double free, const Triangle& moving, const Closest& closest) const {
    const Vector3d n = planeAt(moving, closest);
    const double still = untilStill(free, n);
    if (still >= 1.0) return still;
    const double turning = std::max(still, untilTurning(free, n));
    if (turning >= 1.0) return turning;
    return std::max(turning, untilAlongEdges(free, moving, closest, turning - free));
  }

  /// The plane has the normal R(t) R(free)^T n: the moving triangle's heights above it are
  /// constant.
  double untilTurning(double free, const Vector3d& n) const {
    const Vector3d n_L = kTurnedShrink * (curves_.rotationAt(free).conjugate() * n);
    const auto& p = moving_L_.vertices;
    const double bottom = std::min({n_L.dot(p[0]), n_L.dot(p[1]), n_L.dot(p[2])}) - band_;
    const auto normal = curves_.turned(n_L);
    double until = 1.0;
    for (int j = 0; j < 3 && until > free; ++j) {
      Cubic gap = curves_.towards(normal, fixed_.vertices[j]);
      for (int k = 0; k < 4; ++k) gap[k] += bottom * curves_.weight()[k];
      until = provedPositiveUntil(gap, free, until, planeBound());
    }
    return until;
  }

  /// The plane has the normal e x R(t)d, along the fixed edge e and the moving edge d, if the
  /// closest points are on two edges. Tries it not far beyond the time that the other planes
  /// proved.
  double untilAlongEdges(double free, const Triangle& moving, const Closest& closest,
                         double proved) const {
    const double accuracy = kNearFeature * (planeScale_ + closest.distance);
    const Feature one = featureAt(moving, closest.onMoving, accuracy);
    const Feature other = featureAt(fixed_, closest.onFixed, accuracy);
    if (one.kind != FeatureKind::Edge || other.kind != FeatureKind::Edge) return free;
    const auto& p = moving_L_.vertices;
    const auto& f = fixed_.vertices;
    const Vector3d d = kUnitShrink * (p[(one.index + 1) % 3] - p[one.index]).normalized();
    Vector3d e = kUnitShrink * (f[(other.index + 1) % 3] - f[other.index]).normalized();
    auto normal = curves_.turned(d);
    const Vector3d now = e.cross(curves_.rotationAt(free) * d);
    if (now.dot(closest.difference) < 0.0) e = -e;
    for (Vector3d& control : normal) control = e.cross(control);
    const double end = std::min(1.0, free + std::max(kWindow * proved, kLeastWindow));
    const Cubic length = lengthOf(normal, free, end);
    double until = 1.0;  // share of the window
    for (int i = 0; i < 3; ++i) {
      const auto turned = curves_.turned(d.cross(p[i]));
      const Cubic height = internal::elevated(e.dot(turned[0]), e.dot(turned[1]), e.dot(turned[2]));
      for (int j = 0; j < 3 && until > 0.0; ++j) {
        Cubic gap = curves_.towards(normal, f[j]);
        for (int k = 0; k < 4; ++k) gap[k] += height[k];
        gap = internal::restrictTo(gap, free, end);
        for (int k = 0; k < 4; ++k) gap[k] -= band_ * length[k];
        until = provedPositiveUntil(gap, 0.0, until, planeBound());
      }
    }
    return until >= 1.0 ? end : free + until * (end - free);
  }

  /// No less than the length of a quadratic direction on [free, end], as a cubic there.
  static Cubic lengthOf(const internal::RigidCurves::Turned& n, double free, double end) {
    std::array<Cubic, 3> parts;
    for (int axis = 0; axis < 3; ++axis) {
      parts[axis] =
          internal::restrictTo(internal::elevated(n[0][axis], n[1][axis], n[2][axis]), free, end);
    }
    Cubic length;
    for (int k = 0; k < 4; ++k) {
      length[k] = Vector3d(parts[0][k], parts[1][k], parts[2][k]).norm();
    }
    return length;
  }

  /// Twice the rounding: the second half is for the instants, rounded themselves, and for
  /// restricting twice.
  double planeBound() const { return 2.0 * internal::kRigidRounding * planeScale_ + kUnderflow; }

  internal::RigidCurves curves_;
  Triangle moving_L_, fixed_;
  double band_, planeScale_;
};

void requireAdmitted(const NlerpMotion& motion, double band) {
  for (const Quaternion* q : {&motion.q0, &motion.q1}) {
    FORETOUCH_ASSERT(q->norm() >= 0.5 && q->norm() <= 2.0);
  }
  FORETOUCH_ASSERT(motion.q0.coeffs().dot(motion.q1.coeffs()) >= 0.0 && band >= 0.0);
}

}  // namespace

RigidAnswer rigidTrianglePair(const NlerpMotion& motion, const Triangle& moving_L,
                              const Triangle& fixed_W, double band) {
  requireAdmitted(motion, band);
  return Advancement(motion, moving_L, fixed_W, band).answerFrom(0.0);
}

RigidAnswer internal::rigidTrianglePairFromPlane(const NlerpMotion& motion,
                                                 const Triangle& moving_L, const Triangle& fixed_W,
                                                 double band, const Vector3d& nhat_W) {
  requireAdmitted(motion, band);
  const Advancement advancement(motion, moving_L, fixed_W, band);
  return advancement.answerFrom(advancement.untilStill(0.0, nhat_W));
}

double rigidBand(double extent) {
  return kRigidBand * extent + kUnderflow;
}

}  // namespace foretouch
