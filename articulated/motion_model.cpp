#include "articulated/motion_model.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "lss/assert.h"
#include "lss/index.h"
#include "lss/rounding.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;

/// The twist of a piece for which strayOf() holds (motion_model.md 2).
constexpr double kMostTwist = 0.05;
/// The rounding of the angles computed here, and of their sums, rad (motion_model.md 3).
constexpr double kTurnRounding = 1e-14;

/// Below this half of an angle (rad) series are exact to rounding, and a fifth of the work.
constexpr double kSmallHalf = 0.1;

/// asin(s)/s, and of the angle h sin(h)/h and cos(h), by their series (Horner's way) in the square.
double arcSineShare(double square) {
  constexpr double kTerms[] = {63.0 / 2816.0, 35.0 / 1152.0, 5.0 / 112.0,
                               3.0 / 40.0,    1.0 / 6.0,     1.0};
  double sum = 231.0 / 13312.0;
  for (const double term : kTerms) sum = sum * square + term;
  return sum;
}
double sineShare(double square) {
  return 1.0 - square / 6.0 * (1.0 - square / 20.0 * (1.0 - square / 42.0 * (1.0 - square / 72.0)));
}
double cosineOf(double square) {
  return 1.0 -
         square / 2.0 *
             (1.0 - square / 12.0 *
                        (1.0 - square / 30.0 * (1.0 - square / 56.0 * (1.0 - square / 90.0))));
}

/// The logarithm of the shorter arc.
Vector3d logOf(const Quaternion& q) {
  const double sign = q.w() < 0.0 ? -1.0 : 1.0;
  const Vector3d v = sign * q.vec();
  const double square = v.squaredNorm();
  if (square < kSmallHalf * kSmallHalf) return 2.0 * arcSineShare(square) * v;
  const double sine = std::sqrt(square);
  return 2.0 * std::atan2(sine, sign * q.w()) / sine * v;
}

Quaternion expOf(const Vector3d& w) {
  const double square = 0.25 * w.squaredNorm();
  Quaternion q;
  if (square < kSmallHalf * kSmallHalf) {
    q.w() = cosineOf(square);
    q.vec() = 0.5 * sineShare(square) * w;
    return q;
  }
  const double half = std::sqrt(square);
  q.w() = std::cos(half);
  q.vec() = 0.5 * std::sin(half) / half * w;
  return q;
}

Vector3d turnOf(const Pose& from, const Pose& to, std::size_t joint) {
  return logOf(from.rotations[joint].conjugate() * to.rotations[joint]);
}

/// The derivative of the logarithm at w, for a curve that turns by `rate` in its own frame there.
Vector3d logRate(const Vector3d& w, const Vector3d& rate) {
  const double square = w.squaredNorm(), angle = std::sqrt(square);
  const double share =
      angle < 0.1 ? 1.0 / 12.0 + square / 720.0
                  : 1.0 / square - (1.0 + std::cos(angle)) / (2.0 * angle * std::sin(angle));
  const Vector3d cross = w.cross(rate);
  return rate + 0.5 * cross + share * w.cross(cross);
}

/// Per unit of t, from the changes of the two intervals around a pose.
Vector3d centralSlope(const Vector3d& before, double secondsBefore, const Vector3d& after,
                      double secondsAfter, double seconds) {
  const Vector3d rate =
      (before * (secondsAfter / secondsBefore) + after * (secondsBefore / secondsAfter)) /
      (secondsBefore + secondsAfter);
  return seconds * rate;
}

/// The slope at an end that does not bend there.
Vector3d naturalSlope(const Vector3d& change, const Vector3d& otherSlope) {
  return 1.5 * change - 0.5 * otherSlope;
}

}  // namespace

const char* toString(MotionModel model) {
  switch (model) {
    case MotionModel::ConstantRate: return "constant-rate";
    case MotionModel::Cubic: return "cubic";
    case MotionModel::CubicLate: return "cubic-late";
  }
  return "constant-rate";
}

Vector3d ModelMotion::Curve::at(double t) const {
  const double rest = 1.0 - t;
  return t * rest * (rest * slope0 - t * slope1) + t * t * (3.0 - 2.0 * t) * change;
}

/// The second derivative is linear in t.
double ModelMotion::Curve::bendIn(double begin, double end) const {
  const auto bendAt = [this](double t) {
    return ((6.0 * t - 4.0) * slope0 + (6.0 - 12.0 * t) * change + (6.0 * t - 2.0) * slope1).norm();
  };
  return std::max(bendAt(begin), bendAt(end));
}

ModelMotion::JointCurves ModelMotion::curvesOf(const PosedStep& step, MotionModel model,
                                               std::size_t joint) {
  const auto shiftOf = [joint](const Pose& from, const Pose& to) -> Vector3d {
    return to.translations[joint] - from.translations[joint];
  };
  JointCurves curves;
  Curve &turn = curves.turn, &shift = curves.shift;
  turn.change = turnOf(*step.from, *step.to, joint);
  shift.change = shiftOf(*step.from, *step.to);
  const bool hasBefore = step.before != nullptr;
  const bool hasAfter = step.after != nullptr && model == MotionModel::CubicLate;
  if (hasBefore) {
    turn.slope0 = centralSlope(turnOf(*step.before, *step.from, joint), step.secondsBefore,
                               turn.change, step.seconds, step.seconds);
    shift.slope0 = centralSlope(shiftOf(*step.before, *step.from), step.secondsBefore, shift.change,
                                step.seconds, step.seconds);
  }
  if (hasAfter) {
    turn.slope1 = logRate(
        turn.change, centralSlope(turn.change, step.seconds, turnOf(*step.to, *step.after, joint),
                                  step.secondsAfter, step.seconds));
    shift.slope1 = centralSlope(shift.change, step.seconds, shiftOf(*step.to, *step.after),
                                step.secondsAfter, step.seconds);
  }
  for (Curve* const curve : {&turn, &shift}) {
    if (!hasBefore) {
      curve->slope0 = hasAfter ? naturalSlope(curve->change, curve->slope1) : curve->change;
    }
    if (!hasAfter) curve->slope1 = naturalSlope(curve->change, curve->slope0);
  }
  if (!(turn.change.norm() <= kMostTurn)) turn.slope0 = turn.slope1 = turn.change;
  // The curve lies in the hull of its control points.
  const double reach =
      std::max((step.from->translations[joint] + shift.slope0 / 3.0).lpNorm<Eigen::Infinity>(),
               (step.to->translations[joint] - shift.slope1 / 3.0).lpNorm<Eigen::Infinity>());
  if (!(reach <= kMaxCoordinate)) shift.slope0 = shift.slope1 = shift.change;
  return curves;
}

void ModelMotion::assign(const Skeleton& skeleton, const PosedStep& step, MotionModel model) {
  FORETOUCH_ASSERT(step.from != nullptr && step.to != nullptr && step.seconds > 0.0);
  from_ = step.from;
  to_ = step.to;
  isConstantRate_ =
      model == MotionModel::ConstantRate ||
      (step.before == nullptr && (step.after == nullptr || model != MotionModel::CubicLate));
  joints_.clear();
  if (isConstantRate_) return;
  for (std::size_t joint = 0; joint < countOf(skeleton.numJoints()); ++joint) {
    joints_.push_back(curvesOf(step, model, joint));
  }
}

bool ModelMotion::goOn(const PosedStep& step, double horizon, std::size_t most,
                       std::vector<double>& seconds, std::vector<Pose>& ends) {
  constexpr double kFirstShare = 1.0 / 32.0;
  const double steps = horizon / step.seconds;
  double turn = 0.0, reach = 0.0;
  const std::size_t numJoints = step.to->rotations.size();
  for (std::size_t joint = 0; joint < numJoints; ++joint) {
    turn = std::max(turn, steps * turnOf(*step.from, *step.to, joint).norm());
    const Vector3d& to = step.to->translations[joint];
    reach = std::max(
        reach, (to + steps * (to - step.from->translations[joint])).lpNorm<Eigen::Infinity>());
  }
  if (!std::isfinite(turn) || !(reach <= kMaxCoordinate)) return false;
  seconds.clear();
  for (double share = 0.0; share < 1.0;) {
    if (seconds.size() == most) return false;
    const double farthest = turn > 0.0 ? share + 1.0 / turn : 1.0;
    share = std::min({1.0, farthest, std::max(kFirstShare, 2.0 * share)});
    seconds.push_back(share * horizon);
  }
  ends.assign(seconds.size(), *step.to);
  for (std::size_t joint = 0; joint < numJoints; ++joint) {
    const Vector3d turned = turnOf(*step.from, *step.to, joint);
    const Vector3d shift = step.to->translations[joint] - step.from->translations[joint];
    for (std::size_t k = 0; k < seconds.size(); ++k) {
      const double share = seconds[k] / step.seconds;
      Quaternion& rotation = ends[k].rotations[joint];
      rotation = (rotation * expOf(share * turned)).normalized();
      ends[k].translations[joint] += share * shift;
    }
  }
  return true;
}

void ModelMotion::poseAt(double t, Pose& pose) const {
  static const std::vector<std::uint8_t> kAll;
  poseAt(t, kAll, pose);
}

void ModelMotion::poseAt(double t, const std::vector<std::uint8_t>& isMoved, Pose& pose) const {
  FORETOUCH_ASSERT(!isConstantRate_ || t == 0.0 || t == 1.0);
  pose = t == 1.0 ? *to_ : *from_;
  if (t == 0.0 || t == 1.0) return;
  for (std::size_t joint = 0; joint < joints_.size(); ++joint) {
    if (!isMoved.empty() && isMoved[joint] == 0) continue;
    pose.rotations[joint] =
        (from_->rotations[joint] * expOf(joints_[joint].turn.at(t))).normalized();
    pose.translations[joint] = from_->translations[joint] + joints_[joint].shift.at(t);
  }
}

JointStray ModelMotion::strayOf(JointId joint, double begin, double end) const {
  if (isConstantRate_) {
    const bool isWhole = begin == 0.0 && end == 1.0;
    return isWhole ? JointStray{} : JointStray{kTurnRounding, shiftRounding(joint)};
  }
  const JointCurves& curves = joints_[slotOf(joint)];
  const double span = end - begin, square = span * span;
  const Curve& turn = curves.turn;
  const Vector3d w0 = turn.at(begin), w1 = turn.at(end);
  const double bend = turn.bendIn(begin, end), way = (w1 - w0).norm();
  // The twist of the straight line in logarithms, which is not a geodesic (motion_model.md 2).
  const double farthest = std::max(w0.norm(), w1.norm());
  const double twist =
      w0.cross(w1).norm() * way * (1.0 / 6.0 + farthest * (1.0 / 12.0 + farthest / 60.0));
  if (!(way <= kMostTurn && twist <= kMostTwist)) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    return {kInfinity, kInfinity};
  }
  JointStray stray;
  stray.turn = (0.125 * bend * square + 2.0 * twist) * internal::kInflation + kTurnRounding;
  stray.shift = 0.125 * curves.shift.bendIn(begin, end) * square * internal::kInflation +
                shiftRounding(joint);
  return stray;
}

/// The curve lies in the hull of its control points, and the sum below is larger than they are.
double ModelMotion::shiftRounding(JointId joint) const {
  const auto i = slotOf(joint);
  double reach = from_->translations[i].lpNorm<1>() + to_->translations[i].lpNorm<1>();
  if (!isConstantRate_) {
    reach += joints_[i].shift.slope0.lpNorm<1>() + joints_[i].shift.slope1.lpNorm<1>();
  }
  return 4.0 * kUnitRoundoff * reach;
}

}  // namespace foretouch
