#include "tests/reference/rung_volumes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lss/assert.h"
#include "lss/index.h"
#include "lss/rounding.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;

/// Of a relative point, per length of its arms, and of its distance from the axis (rungs.md 3).
constexpr double kRelativePointRounding = 32.0 * kUnitRoundoff,
                 kAxisDistanceRounding = 32.0 * kUnitRoundoff;
/// Steps of the enclosing-circle iteration ([BadoiuClarkson03], as in lss/fit.cpp).
constexpr int kCircleSteps = 3;
/// The node at which the axis is fitted: next to the middle of the step.
constexpr int kMiddle = kNodes / 2;

Vector3d placeOf(const CarriedBall& ball, int node) {
  return {ball.path.y[0][node], ball.path.y[1][node], ball.path.y[2][node]};
}

/// The ball whose centre is farthest from `from`.
std::size_t farthestFrom(const std::vector<CarriedBall>& balls, int node, const Vector3d& from) {
  std::size_t farthest = 0;
  double reach = -1.0;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const double here = (placeOf(balls[i], node) - from).squaredNorm();
    if (here > reach) {
      reach = here;
      farthest = i;
    }
  }
  return farthest;
}

/// A point on the line along `direction` around which all balls lie in a nearly least cylinder; its
/// radius.
struct Cylinder {
  Vector3d center;
  double radius;
};
Cylinder cylinderAlong(const std::vector<CarriedBall>& balls, int node, const Vector3d& direction,
                       const Vector3d& start) {
  Cylinder best{start, std::numeric_limits<double>::infinity()};
  Vector3d center = start;
  for (int step = 1; step <= kCircleSteps; ++step) {
    double reach = -1.0;
    Vector3d towards = Vector3d::Zero();
    for (const CarriedBall& ball : balls) {
      const Vector3d w = placeOf(ball, node) - center;
      const Vector3d across = w - direction.dot(w) * direction;
      const double distance = across.norm(), here = distance + ball.radius;
      if (here <= reach) continue;
      reach = here;
      // Towards the ball's far side.
      towards = distance > 0.0 ? Vector3d((here / distance) * across) : across;
    }
    if (reach < best.radius) best = {center, reach};
    center += towards / (step + 1.0);
  }
  return best;
}

}  // namespace

Lss axisAround(const std::vector<CarriedBall>& balls, int node) {
  FORETOUCH_ASSERT(!balls.empty());
  Vector3d mean = Vector3d::Zero();
  for (const CarriedBall& ball : balls) mean += placeOf(ball, node);
  mean /= static_cast<double>(balls.size());
  const Vector3d one = placeOf(balls[farthestFrom(balls, node, mean)], node);
  const Vector3d other = placeOf(balls[farthestFrom(balls, node, one)], node);
  const double span = (other - one).norm();
  if (!(span > 0.0)) return {mean, mean, 0.0};
  const Vector3d direction = (other - one) / span;
  const Cylinder cylinder = cylinderAlong(balls, node, direction, 0.5 * (one + other));
  double begin = std::numeric_limits<double>::infinity(), end = -begin;
  for (const CarriedBall& ball : balls) {
    const Vector3d w = placeOf(ball, node) - cylinder.center;
    const double t = direction.dot(w), room = cylinder.radius - ball.radius;
    // As far as the ball is inside the cap around an end.
    const double cap = std::sqrt(std::max(0.0, room * room - (w - t * direction).squaredNorm()));
    begin = std::min(begin, t + cap);
    end = std::max(end, t - cap);
  }
  if (begin > end) begin = end = 0.5 * (begin + end);  // the caps alone reach: a sphere
  return {cylinder.center + begin * direction, cylinder.center + end * direction, 0.0};
}

namespace {

/// The least radius that provably contains all balls at every t.
double radiusAround(const std::vector<CarriedBall>& balls, const Lss& axis) {
  AxisSegment segment{};
  const Vector3d along = axis.b - axis.a;
  for (int i = 0; i < 3; ++i) {
    segment.a[i] = axis.a[i];
    segment.u[i] = along[i];
  }
  const double square = along.squaredNorm();
  segment.inverse = square > 0.0 && std::isfinite(1.0 / square) ? 1.0 / square : 0.0;
  const double extent = axis.a.norm() + along.norm();
  double radius = 0.0;
  for (const CarriedBall& ball : balls) {
    const LargestSquares squares = largestSquares(ball.path, segment);
    const double distance = std::sqrt(squares.fromAxis), length = std::sqrt(squares.fromOrigin);
    const double rounding =
        ball.perLength * length + kAxisDistanceRounding * (length + extent + distance);
    radius = std::max(radius, distance + ball.radius + ball.stray + rounding);
  }
  return radius * kInflation;
}

Lss volumeAround(const std::vector<CarriedBall>& balls) {
  Lss volume = axisAround(balls, kMiddle);
  volume.radius = radiusAround(balls, volume);
  return volume;
}

/// An eighth of the square of the widest gap between two nodes' instants.
double chordShare(const ChainNodes& nodes) {
  double widest = 0.0;
  for (int k = 0; k + 1 < kNodes; ++k) {
    widest = std::max(widest, nodes.instant(k + 1) - nodes.instant(k));
  }
  return 0.125 * widest * widest * kInflation;
}

}  // namespace

RungVolumes::RelativeSums RungVolumes::RelativeSums::with(
    const ChainMotion::JointBounds& joint) const {
  RelativeSums sums;
  sums.angularSpeed = angularSpeed + joint.turn;
  sums.angularAcceleration = angularAcceleration + angularSpeed * joint.turn;
  sums.acceleration =
      acceleration + ((angularAcceleration + angularSpeed * angularSpeed) * joint.length +
                      2.0 * (angularSpeed * joint.driftLength));
  return sums;
}

void RungVolumes::boundRelativeMotion(const ChainMotion& motion, bool withTrees) {
  const auto count = countOf(motion.numLinks());
  toLimb_.resize(count);
  if (withTrees) toRoot_.resize(count);
  for (LinkId link = 0; link < motion.numLinks(); ++link) {
    const auto i = slotOf(link);
    const JointId parent = motion.parent(link);
    if (parent == kNoParent) {
      toLimb_[i] = RelativeSums();
      if (withTrees) toRoot_[i] = RelativeSums();
      continue;
    }
    const auto above = slotOf(parent);
    const ChainMotion::JointBounds joint = motion.jointBounds(link);
    toLimb_[i] = limbs_.isCarrier(link) ? RelativeSums() : toLimb_[above].with(joint);
    if (withTrees) toRoot_[i] = toRoot_[above].with(joint);
  }
}

void RungVolumes::addBall(const ChainNodes& nodes, LinkId carrier, const AxisPoint& point,
                          const RelativeSums& sums) {
  balls_.emplace_back();
  CarriedBall& ball = balls_.back();
  ball.radius = point.radius;
  if (point.link == carrier) {  // at rest in its own frame
    for (int axis = 0; axis < 3; ++axis) {
      std::fill(ball.path.y[axis], ball.path.y[axis] + kNodes, point.p_L[axis]);
    }
    ball.stray = ball.perLength = 0.0;
    return;
  }
  relativePoint(nodes.link(carrier), nodes.link(point.link), point.p_L, ball.path);
  const NodeBounds& bounds = nodes.bounds();
  ball.perLength = bounds.rotationRounding + kRelativePointRounding;
  ball.stray = (sums.accelerationAt(point.rho) * chord_ + 2.0 * bounds.positionRounding +
                ball.perLength * point.rho) *
               kInflation;
}

Lss RungVolumes::volumeOf(const Avatar& avatar, const ChainNodes& nodes, const Limb& limb) {
  if (limb.points.size() == 2 && limb.points.front().link == limb.carrier) {
    return avatar.lss(limb.carrier).front();
  }
  balls_.clear();
  for (const AxisPoint& point : limb.points) {
    addBall(nodes, limb.carrier, point, toLimb_[slotOf(point.link)]);
  }
  return volumeAround(balls_);
}

Lss RungVolumes::volumeOf(const ChainNodes& nodes, const LimbTree& tree) {
  if (tree.limbs.size() == 1) {
    const auto only = static_cast<std::size_t>(tree.limbs.front());
    if (limbs_.limbs()[only].carrier == tree.root) return limbVolumes_[only];
  }
  balls_.clear();
  for (const std::int32_t limb : tree.limbs) {
    const LinkId carrier = limbs_.limbs()[slotOf(limb)].carrier;
    const Lss& volume = limbVolumes_[slotOf(limb)];
    for (const Vector3d& end : {volume.a, volume.b}) {
      const AxisPoint point{
          carrier, {end.x(), end.y(), end.z()}, end.norm() * kInflation, volume.radius};
      addBall(nodes, tree.root, point, toRoot_[slotOf(carrier)]);
    }
  }
  return volumeAround(balls_);
}

void RungVolumes::evaluate(const Avatar& avatar, const ChainMotion& motion, const ChainNodes& nodes,
                           bool withTrees) {
  if (avatar_ != avatar.identity()) {
    limbs_ = Limbs(avatar);
    avatar_ = avatar.identity();
  }
  FORETOUCH_ASSERT(nodes.begin() == 0.0 && nodes.end() == 1.0);
  boundRelativeMotion(motion, withTrees);
  chord_ = chordShare(nodes);
  limbVolumes_.resize(limbs_.limbs().size());
  for (std::size_t i = 0; i < limbVolumes_.size(); ++i) {
    const Limb& limb = limbs_.limbs()[i];
    if (!limb.links.empty()) limbVolumes_[i] = volumeOf(avatar, nodes, limb);
  }
  if (!withTrees) return;
  treeVolumes_.resize(limbs_.trees().size());
  for (std::size_t i = 0; i < treeVolumes_.size(); ++i) {
    treeVolumes_[i] = volumeOf(nodes, limbs_.trees()[i]);
  }
}

}  // namespace foretouch::internal
