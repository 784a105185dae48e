// judge/first_touch.cpp: steps of clearance over speed.
#include "judge/first_touch.h"

#include <algorithm>
#include <limits>

#include "judge/distance.h"

namespace foretouch::oracle {
namespace {

/// Metres. Computed distances within kilometres of the origin err by less (2e-13 per coordinate).
constexpr double kRoundingAllowance = 1e-11;
/// In parts of a place's coordinates and of a ball's radius: far more than doubles round by.
constexpr double kBallRounding = 1e-12;

}  // namespace

double distanceTo(const Scene& scene, const Vec3d& a, const Vec3d& b, double bound) {
  Box box;
  box.add(a);
  box.add(b);
  double least = bound;
  scene.visitNear(box, least, [&](int id) {
    // By the ball around it first; with room for rounding.
    const Scene::Ball& ball = scene.ballOf(id);
    const double room = kBallRounding * (1.0 + extent(ball.center) + ball.radius);
    if (pointSegmentDistance(ball.center, a, b) - ball.radius > least + room) return;
    least = std::min(least, closestPoints(a, b, scene.triangle(id)).distance);
  });
  return least;
}

FirstTouch firstTouch(const Scene& scene, const MovingAxis& axis) {
  double t = 0.0, bound = std::numeric_limits<double>::infinity();
  for (int step = 0; step < kTouchSteps; ++step) {
    const auto [a, b] = axis.at(t);
    const double distance = distanceTo(scene, a, b, bound);
    const double separation = distance - axis.radius - kRoundingAllowance;
    if (separation <= kTouchSeparation) return {TouchOutcome::Touch, t};
    if (separation >= axis.speed * (1.0 - t)) return {TouchOutcome::Free, 1.0};
    t += separation / axis.speed;
    // The nearest triangle cannot be farther now than this; twice the step leaves room for
    // rounding.
    bound = distance + 2.0 * separation;
  }
  return {TouchOutcome::Uncertain, t};
}

}  // namespace foretouch::oracle
