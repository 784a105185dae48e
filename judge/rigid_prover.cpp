// judge/rigid_prover.cpp: q(t) stays in the plane of q0 and q1, so the body turns about a
// fixed axis at the rate w = 2 K / |q|^2 with K = |q0 ^ q1| (the area they span), and
//   |w'| = 4 K |q.q'| / |q|^4 <= 4 K |q'| / |q|^3,
// so a point at distance r from the body's origin has |acceleration| <= (w^2 + |w'|) r.
#include "judge/rigid_prover.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "judge/certificate.h"
#include "judge/quaternion.h"

namespace foretouch::oracle {
namespace {

/// Roundings of the first two looks, as a share of the local size: some hundred operations each.
constexpr double kDoubleShare = 1e-12, kRealShare = 1e-16;

/// The body's placement at one instant, relative to the fixed triangle's first vertex.
template <typename S>
struct Placement {
  Vec3<S> place, drift;
  Quaternion<S> q;
  S norm2 = 1;
  Vec3<S> rate;      // angular velocity
  S rateMost = 0;    // its bound over the span
  S rateChange = 0;  // bound of its change
};

template <typename S>
Placement<S> placementAt(const RigidPair& pair, const S& t, const S& half) {
  using std::sqrt;
  Placement<S> p;
  // Subtracts the given doubles first, which loses nothing far from the origin.
  p.drift = pair.x1.as<S>() - pair.x0.as<S>();
  p.place = pair.x0.as<S>() - pair.fixed[0].as<S>() + t * p.drift;
  const Quaternion<S> q0 = quaternionOf<S>(pair.q0), q1 = quaternionOf<S>(pair.q1);
  const Quaternion<S> dq{q1.w - q0.w, q1.x - q0.x, q1.y - q0.y, q1.z - q0.z};
  p.q = quaternion<S>(q0.w + t * dq.w, q0.vector() + t * dq.vector());
  p.norm2 = dot(p.q, p.q);
  // 2 Im(q' q*) / |q|^2
  const Vec3<S> v = p.q.vector(), dv = dq.vector();
  p.rate = (2 / p.norm2) * (p.q.w * dv - dq.w * v + cross(v, dv));
  const S speed = norm(dq), length = sqrt(p.norm2);
  const S shortest = length - half * speed;
  if (!(shortest > S(0.01) * length)) {  // too long a span to decide anything
    p.rateMost = p.rateChange = S(1e30);
    return p;
  }
  const S area = norm(p.rate) * p.norm2 / 2;
  p.rateMost = 2 * area / (shortest * shortest);
  p.rateChange = 4 * area * speed / (shortest * shortest * shortest);
  return p;
}

template <typename S>
HullView<S> hullAt(const RigidPair& pair, const S& t, const S& half) {
  const Placement<S> p = placementAt(pair, t, half);
  HullView<S> hull;
  hull.count = 3;
  hull.halfSpan = half;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3<S> inBody = pair.moving[i].as<S>();
    const Vec3<S> arm = (1 / p.norm2) * rotateAndScale(p.q, inBody);
    hull.points[i] = p.place + arm;
    hull.velocity[i] = p.drift + cross(p.rate, arm);
    hull.bend[i] = (p.rateMost * p.rateMost + p.rateChange) * norm(inBody) * half * half / 2;
    hull.stray = std::max(hull.stray, S(norm(hull.velocity[i]) * half + hull.bend[i]));
  }
  return hull;
}

template <typename S>
Corners<S> fixedCorners(const RigidPair& pair) {
  return cornersOf<S>(pair.fixed, pair.fixed[0]);
}

}  // namespace

RigidProver::RigidProver(const RigidPair& pair) : pair_(pair) {
  for (std::size_t i = 0; i < 3; ++i) {
    extent_ = std::max({extent_, norm(pair.moving[i]), norm(pair.fixed[i] - pair.fixed[0])});
  }
  extent_ += std::max(norm(pair.x0 - pair.fixed[0]), norm(pair.x1 - pair.fixed[0]));
}

/// `share` of the local size covers all that S rounds, the instant included. A point that can stray
/// far beyond that size proves nothing anyway.
template <typename S>
RigidProver::Look RigidProver::look(const Wide& from, const Wide& to, double level, double share) {
  constexpr double kFar = 100;
  const Wide middle = (from + to) / 2, half = (to - from) / 2;
  const HullView<S> hull = hullAt<S>(pair_, static_cast<S>(middle), static_cast<S>(half));
  const Certificate<S> c = certify(hull, fixedCorners<S>(pair_));
  const S margin = S(share) * (S(extent_) + std::min(hull.stray, S(kFar * extent_)));
  if (c.least - margin > S(level)) return Look::Free;
  // In thirty-four digits, a distance within the guard of the level counts as reaching it: a
  // pierced triangle is at distance zero, which no rounding can go below.
  constexpr bool kLastResort = std::is_same_v<S, Wide>;
  if (kLastResort ? c.distance - margin <= S(level) : c.distance + margin <= S(level)) {
    outcome_.touching = static_cast<double>(middle);
    outcome_.separation = static_cast<Wide>(c.distance);
    return Look::Touching;
  }
  if (kLastResort) return Look::TooLong;
  const bool surelyApart = c.distance - margin > S(level);
  return surelyApart && c.least + margin <= S(level) ? Look::TooLong : Look::Doubtful;
}

RigidProver::Look RigidProver::lookTwice(const Wide& from, const Wide& to, double level) {
  ++outcome_.looks;
  Look result = look<double>(from, to, level, kDoubleShare);
  if (result == Look::Doubtful) result = look<Real>(from, to, level, kRealShare);
  if (result != Look::Doubtful) return result;
  ++outcome_.wideLooks;
  return look<Wide>(from, to, level, kRigidGuard);
}

// Depth is bounded by kShortestRigidSpan: at most 91 levels.
bool RigidProver::proveSpan(const Wide& from, const Wide& to, double level) {
  if (outcome_.looks > kMostLooks || outcome_.wideLooks > kMostWideLooks) return false;
  const Look result = lookTwice(from, to, level);
  if (result == Look::Free) return true;
  if (result == Look::Touching) return false;
  if (to - from < kShortestRigidSpan) {
    ++outcome_.grazing;
    return true;
  }
  const Wide middle = (from + to) / 2;
  return proveSpan(from, middle, level) && proveSpan(middle, to, level);
}

// Middles never reach the ends: examines these two instants separately.
RigidSpan RigidProver::prove(double from, double to, double level) {
  outcome_ = RigidSpan{};
  const Wide first(from), last(to);
  if (lookTwice(first, first, level) == Look::Touching) return outcome_;
  if (lookTwice(last, last, level) == Look::Touching) return outcome_;
  outcome_.free = proveSpan(first, last, level);
  return outcome_;
}

Wide RigidProver::separationAt(double t) const {
  return closestPoints(hullAt<Wide>(pair_, Wide(t), Wide(0)), fixedCorners<Wide>(pair_)).distance;
}

}  // namespace foretouch::oracle
