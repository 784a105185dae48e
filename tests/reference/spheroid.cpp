#include "tests/reference/spheroid.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lss/assert.h"
#include "lss/rounding.h"
#include "lss/safe_step.h"
#include "lss/separation.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;

/// Of a point of the root's frame at a node, per length; and of sums of places in W.
constexpr double kRootPointRounding = 32.0 * kUnitRoundoff, kSumRounding = 8.0 * kUnitRoundoff;
/// Of toUnit() and of the ball's place, relative to the lengths over the shortest semi-axis.
constexpr double kTransformRounding = 32.0 * kUnitRoundoff;
/// An axis is at least this share of the other, and this long (m): gives volume to flat bodies.
constexpr double kLeastShare = 0x1p-10, kLeastAxis = 1e-6;
constexpr int kMiddle = kNodes / 2;

/// The ends of the volume's axis in W at all nodes, relative to the root's origin.
using Places = std::array<Vector3d, std::size_t{2} * kNodes>;

Places placesOf(const Lss& volume, const LinkNodes& root) {
  Places places;
  for (std::size_t k = 0; k < kNodes; ++k) {
    Eigen::Matrix3d R;
    for (int i = 0; i < 9; ++i) R(i / 3, i % 3) = root.R[i][k];
    places[2 * k] = R * volume.a;
    places[2 * k + 1] = R * volume.b;
  }
  return places;
}

/// Semi-axes of an ellipsoid around the places, taken from its centre: nearly the least of its
/// proportions.
struct SemiAxes {
  double along = 0.0, across = 0.0;
};
SemiAxes coreAround(const Places& places, const Vector3d& center, const Vector3d& axis) {
  double along = 0.0, across = 0.0;
  const auto split = [&](const Vector3d& place) {
    const Vector3d w = place - center;
    const double u = axis.dot(w);
    return SemiAxes{std::abs(u), (w - u * axis).norm()};
  };
  for (const Vector3d& place : places) {
    along = std::max(along, split(place).along);
    across = std::max(across, split(place).across);
  }
  // Of the ellipses through the corner (along, across) the one with least sum of squares; then
  // shrunk until it touches a place.
  SemiAxes core{std::sqrt(along * (along + across)), std::sqrt(across * (along + across))};
  double largest = 0.0;
  for (const Vector3d& place : places) {
    const SemiAxes at = split(place);
    const double x = core.along > 0.0 ? at.along / core.along : 0.0;
    const double y = core.across > 0.0 ? at.across / core.across : 0.0;
    largest = std::max(largest, x * x + y * y);
  }
  const double scale = std::sqrt(largest);
  return {core.along * scale * kInflation, core.across * scale * kInflation};
}

/// Semi-axes around the core grown by a ball: for any share in (0,1)
/// ball^2/share + core^2/(1-share) is enough (rungs.md 5). The least volume of a few shares.
SemiAxes grown(const SemiAxes& core, double ball) {
  if (!(core.along > 0.0)) return {ball, ball};
  SemiAxes best;
  double bestVolume = HUGE_VAL;
  for (const double share : {ball / (ball + core.along), 0.2, 0.35, 0.5, 0.6, 0.7, 0.8}) {
    const double base = ball * ball / share;
    const SemiAxes axes{std::sqrt(base + core.along * core.along / (1.0 - share)),
                        std::sqrt(base + core.across * core.across / (1.0 - share))};
    const double volume = axes.along * axes.across * axes.across;
    if (volume < bestVolume) {
      bestVolume = volume;
      best = axes;
    }
  }
  return best;
}

}  // namespace

Spheroid spheroidAround(const Lss& volume, LinkId root, const ChainMotion& motion,
                        const ChainNodes& nodes) {
  FORETOUCH_ASSERT(motion.parent(root) == kNoParent && nodes.begin() == 0.0 && nodes.end() == 1.0);
  const Places places = placesOf(volume, nodes.link(root));
  const Vector3d& a = places[2 * kMiddle];
  const Vector3d& b = places[2 * kMiddle + 1];
  const Vector3d offset = 0.5 * (a + b);
  const JointArc arc = motion.arc(root);
  Spheroid spheroid;
  const double length = (b - a).norm();
  if (length > 0.0) spheroid.axis = (b - a) / length;
  spheroid.start = Vector3d(arc.translation) + offset;
  spheroid.drift = Vector3d(arc.drift);
  const SemiAxes core = coreAround(places, offset, spheroid.axis);

  // The ends' motion between the nodes' places (rungs.md 5).
  double widest = 0.0;
  for (int k = 0; k + 1 < kNodes; ++k) {
    widest = std::max(widest, nodes.instant(k + 1) - nodes.instant(k));
  }
  const double rho = std::max(volume.a.norm(), volume.b.norm()) * kInflation;
  const double turn = motion.jointBounds(root).turn;
  const double rounding =
      (nodes.bounds().rotationRounding + kRootPointRounding) * rho +
      kSumRounding * (spheroid.start.lpNorm<1>() + offset.lpNorm<1>() +
                      Vector3d(arc.translation).lpNorm<1>() + spheroid.drift.lpNorm<1>());
  const double ball = std::max(
      {(volume.radius + 0.125 * widest * widest * turn * turn * rho + rounding) * kInflation,
       kLeastShare * core.along, kLeastAxis});
  const SemiAxes axes = grown(core, ball);
  spheroid.along = axes.along * kInflation;
  spheroid.across = axes.across * kInflation;
  return spheroid;
}

SpheroidPair::SpheroidPair(const Spheroid& spheroid, const Triangle& triangle)
    : velocity_(spheroid.toUnit(spheroid.drift)) {
  double extent = spheroid.drift.lpNorm<1>();
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3d w = triangle.vertices[i] - spheroid.start;
    unit_.vertices[i] = spheroid.toUnit(w);
    extent = std::max(extent, w.lpNorm<1>());
  }
  slack_ = 2.0 * kTransformRounding * (extent / spheroid.shortest() + 1.0);
  const Vector3d& corner = unit_.vertices[0];
  longestEdge_ = std::sqrt(std::max((unit_.vertices[1] - corner).squaredNorm(),
                                    (unit_.vertices[2] - corner).squaredNorm()));
}

double SpheroidPair::leastAtStart() const {
  return (unit_.vertices[0].norm() - longestEdge_) - 2.0 * slack_;
}

double SpheroidPair::leastOfAll() const {
  const Vector3d& corner = unit_.vertices[0];
  const double square = velocity_.squaredNorm();
  // However the quotient rounds, the centre's place at that instant is on its path; the nearest one
  // is off by a few roundings of the lengths.
  const double s =
      square > 0.0 ? std::min(1.0, std::max(0.0, corner.dot(velocity_) / square)) : 0.0;
  constexpr double kShrink = 1.0 - 1e-12;
  const double fromWay = (corner - s * velocity_).norm() * kShrink;
  return (fromWay - longestEdge_) - 2.0 * slack_;
}

SpheroidPair::Look SpheroidPair::at(double t) const {
  const Vector3d center = t * velocity_;
  const Separation s = separation(Hull::segment(center, center), Hull::of(unit_));
  Look look;
  look.nhat = s.nhat;
  look.lower = s.clearance[0] - 1.0 - slack_;
  look.upper = s.upper - 1.0 + slack_;
  look.onTriangle = s.onOther;
  return look;
}

double SpheroidPair::provenFrom(double t, const Look& look, double floor) const {
  if (!(look.lower > floor)) return t;
  const double speed = look.nhat.dot(velocity_) - slack_;
  return timeAfter(t, safeStep(look.lower - floor, speed, 0.0), 1.0);
}

}  // namespace foretouch::internal
