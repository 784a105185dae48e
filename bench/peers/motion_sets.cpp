#include "bench/peers/motion_sets.h"

#include <cmath>

#include "bench/judged.h"
#include "tools/portable_random.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;

/// If so many draws per motion give no motion of a kind, the scene has none.
constexpr std::size_t kDrawsPerMotion = 2'000;

Vector3d direction(PortableRandom& random) {
  for (;;) {
    const Vector3d v = random.inBox(1.0);
    if (const double length = v.norm(); length > 0.1 && length <= 1.0) return v / length;
  }
}

Quaternion anyRotation(PortableRandom& random) {
  for (;;) {
    const Vector3d v = random.inBox(1.0);
    Quaternion q(random.uniform(-1, 1), v.x(), v.y(), v.z());
    if (const double length = q.norm(); length > 0.1 && length <= 1.0) return q.normalized();
  }
}

Lss lssOf(const MotionSetKind& kind) {
  return {Vector3d(kPivotBeside, 0.0, kPivotBefore),
          Vector3d(kPivotBeside, 0.0, kPivotBefore + kAxisLength), kind.radius};
}

RigidSweep drawn(const MotionSetKind& kind, const oracle::Scene& scene, PortableRandom& random) {
  RigidSweep sweep;
  sweep.lss_L = lssOf(kind);
  sweep.rotation = anyRotation(random);
  const Vector3d center_L = 0.5 * (sweep.lss_L.a + sweep.lss_L.b);
  sweep.from =
      random.inBox(rich(scene.box().low), rich(scene.box().high)) - sweep.rotation * center_L;
  const Vector3d travel = direction(random);
  sweep.to = sweep.from + random.uniform(0.0, kind.mostTravel) * travel;
  const Vector3d axis = direction(random);
  sweep.turn = random.uniform(0.0, kind.mostTurn) * axis;
  return sweep;
}

bool startsClear(const oracle::Scene& scene, const RigidSweep& sweep) {
  const AxisInWorld axis = axisAt(sweep, 0.0);
  const double enough = sweep.lss_L.radius + 2.0 * kStartClearance;
  const double distance = oracle::distanceTo(scene, plain(axis.a), plain(axis.b), enough);
  return distance - sweep.lss_L.radius > kStartClearance;
}

Error tooFew(const MotionSetKind& kind, std::size_t colliding, std::size_t free) {
  Error error;
  error.code = ErrorCode::Empty;
  error.message = std::string("too few motions of set ") + kind.name + " fit the scene: found " +
                  std::to_string(colliding) + " colliding and " + std::to_string(free) +
                  " free ones; expected a scene of rooms that a forearm can move in, in metres";
  return error;
}

}  // namespace

oracle::FirstTouch firstTouch(const oracle::Scene& scene, const RigidSweep& sweep, double radius) {
  const auto axisOf = [&](double t) -> std::array<oracle::Vec3d, 2> {
    const AxisInWorld axis = axisAt(sweep, t);
    return {plain(axis.a), plain(axis.b)};
  };
  return oracle::firstTouch(scene, {axisOf, fastestAxisPoint(sweep), radius});
}

std::optional<SweepTruth> truthOf(const oracle::Scene& scene, const RigidSweep& sweep) {
  const oracle::FirstTouch touch = firstTouch(scene, sweep, sweep.lss_L.radius);
  if (touch.outcome == oracle::TouchOutcome::Uncertain) return std::nullopt;
  SweepTruth truth;
  truth.touches = touch.outcome == oracle::TouchOutcome::Touch;
  truth.toi = touch.t;
  const double judged = truth.touches ? -kJudgedDistance : kJudgedDistance;
  const oracle::FirstTouch other = firstTouch(scene, sweep, sweep.lss_L.radius + judged);
  if (other.outcome == oracle::TouchOutcome::Uncertain) return std::nullopt;
  truth.isDeep = truth.touches && other.outcome == oracle::TouchOutcome::Touch;
  truth.comesNear = truth.touches || other.outcome == oracle::TouchOutcome::Touch;
  return truth;
}

Result<MotionSet> drawnSet(const MotionSetKind& kind, const oracle::Scene& scene, std::size_t count,
                           std::uint64_t seed) {
  PortableRandom random(seed);
  MotionSet set{kind.name, kind.description, lssOf(kind), {}, {}, 0};
  const std::size_t wantedColliding = count / 2, wantedFree = count - count / 2;
  std::size_t colliding = 0;
  for (std::size_t draw = 0; set.sweeps.size() < count; ++draw) {
    if (draw >= kDrawsPerMotion * count) {
      return tooFew(kind, colliding, set.sweeps.size() - colliding);
    }
    const RigidSweep sweep = drawn(kind, scene, random);
    if (!startsClear(scene, sweep)) continue;
    const auto truth = truthOf(scene, sweep);
    set.uncertain += truth ? 0 : 1;
    if (!truth) continue;
    const std::size_t free = set.sweeps.size() - colliding;
    if (truth->touches ? colliding >= wantedColliding : free >= wantedFree) continue;
    colliding += truth->touches ? 1 : 0;
    set.sweeps.push_back(sweep);
    set.truths.push_back(*truth);
  }
  return set;
}

}  // namespace foretouch::tools
