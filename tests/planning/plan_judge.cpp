#include "tests/planning/plan_judge.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace foretouch::test {
namespace {

using oracle::Vec3d;

Vec3d turned(const PlainFrame& frame, const Vec3d& p) {
  const auto& m = frame.turn;
  return {m[0] * p.x + m[1] * p.y + m[2] * p.z, m[3] * p.x + m[4] * p.y + m[5] * p.z,
          m[6] * p.x + m[7] * p.y + m[8] * p.z};
}

Vec3d placed(const PlainFrame& frame, const Vec3d& p) {
  return frame.shift + turned(frame, p);
}

PlainFrame composed(const PlainFrame& outer, const PlainFrame& inner) {
  PlainFrame all;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      double sum = 0.0;
      for (int k = 0; k < 3; ++k) sum += outer.turn[3 * row + k] * inner.turn[3 * k + column];
      all.turn[3 * row + column] = sum;
    }
  }
  all.shift = placed(outer, inner.shift);
  return all;
}

/// Rodrigues' formula, about a unit axis.
PlainFrame turnAbout(const Vec3d& axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle), r = 1.0 - c;
  PlainFrame frame;
  frame.turn = {c + r * axis.x * axis.x,          r * axis.x * axis.y - s * axis.z,
                r * axis.x * axis.z + s * axis.y, r * axis.y * axis.x + s * axis.z,
                c + r * axis.y * axis.y,          r * axis.y * axis.z - s * axis.x,
                r * axis.z * axis.x - s * axis.y, r * axis.z * axis.y + s * axis.x,
                c + r * axis.z * axis.z};
  return frame;
}

double lengthOf(const Vec3d& v) {
  return std::sqrt(oracle::dot(v, v));
}

bool turns(RobotJointKind kind) {
  return kind == RobotJointKind::Revolute || kind == RobotJointKind::Continuous;
}

std::vector<oracle::Triangle> judged(const std::vector<Triangle>& scene) {
  std::vector<oracle::Triangle> all;
  for (const Triangle& t : scene) {
    all.push_back({Vec3d(t.vertices[0]), Vec3d(t.vertices[1]), Vec3d(t.vertices[2])});
  }
  return all;
}

}  // namespace

PlanJudge::PlanJudge(const Robot& robot, const std::vector<Triangle>& scene,
                     std::vector<LinkId> left)
    : scene_(judged(scene)) {
  const Avatar& avatar = robot.avatar();
  const Skeleton& skeleton = avatar.skeleton();
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    const RobotJoint& from = robot.joints()[static_cast<std::size_t>(link)];
    Joint joint;
    if (from.kind == RobotJointKind::Planar) throw std::invalid_argument("a mobile base");
    joint.parent = skeleton.parent(link);
    joint.kind = from.kind;
    const Eigen::Matrix3d rest = skeleton.restRotation(link).toRotationMatrix();
    for (int i = 0; i < 9; ++i) joint.rest.turn[static_cast<std::size_t>(i)] = rest(i / 3, i % 3);
    joint.rest.shift = Vec3d(skeleton.restOffset(link));
    joint.axis = Vec3d(from.axis);
    const LinkId leader = from.mimicOf == kNoParent ? link : from.mimicOf;
    if (from.mimicOf != kNoParent) {
      joint.factor = from.mimicFactor;
      joint.offset = from.mimicOffset;
    }
    for (std::size_t c = 0; c < robot.numCoordinates(); ++c) {
      if (robot.coordinates()[c].joint == leader) joint.coordinate = static_cast<int>(c);
    }
    joints_.push_back(joint);
    if (std::find(left.begin(), left.end(), link) != left.end()) continue;
    for (const Lss& lss : avatar.lss(link)) {
      capsules_.push_back({link, Vec3d(lss.a), Vec3d(lss.b), lss.radius});
    }
  }
}

PlainFrame PlanJudge::frameOf(LinkId link, const std::vector<double>& q) const {
  PlainFrame frame;
  for (int j = link; j >= 0; j = joints_[static_cast<std::size_t>(j)].parent) {
    const Joint& joint = joints_[static_cast<std::size_t>(j)];
    PlainFrame own = joint.rest;
    if (joint.coordinate >= 0) {
      const double value =
          joint.factor * q[static_cast<std::size_t>(joint.coordinate)] + joint.offset;
      if (turns(joint.kind)) {
        own = composed(own, turnAbout(joint.axis, value));
      } else {
        own.shift = own.shift + turned(joint.rest, value * joint.axis);
      }
    }
    frame = composed(own, frame);
  }
  return frame;
}

/// A joint that turns by w moves a point by at most w times the length of the chain below it.
double PlanJudge::speedOf(const Capsule& capsule, const std::vector<double>& q0,
                          const std::vector<double>& q1) const {
  double reach = std::max(lengthOf(capsule.a), lengthOf(capsule.b)), speed = 0.0;
  for (int j = capsule.link; j >= 0; j = joints_[static_cast<std::size_t>(j)].parent) {
    const Joint& joint = joints_[static_cast<std::size_t>(j)];
    if (joint.coordinate >= 0) {
      const auto c = static_cast<std::size_t>(joint.coordinate);
      const double rate = std::abs(joint.factor * (q1[c] - q0[c]));
      speed += turns(joint.kind) ? rate * reach : rate;
      if (!turns(joint.kind)) {
        reach += std::abs(joint.factor) * std::max(std::abs(q0[c]), std::abs(q1[c])) +
                 std::abs(joint.offset);
      }
    }
    reach += lengthOf(joint.rest.shift);
  }
  return 1.000001 * speed;
}

oracle::FirstTouch PlanJudge::firstTouch(const std::vector<double>& q0,
                                         const std::vector<double>& q1) const {
  oracle::FirstTouch first;
  for (const Capsule& capsule : capsules_) {
    const auto axis = [&](double t) {
      std::vector<double> q(q0.size());
      for (std::size_t c = 0; c < q.size(); ++c) q[c] = q0[c] + t * (q1[c] - q0[c]);
      const PlainFrame frame = frameOf(capsule.link, q);
      return std::array<Vec3d, 2>{placed(frame, capsule.a), placed(frame, capsule.b)};
    };
    const auto found = oracle::firstTouch(scene_, {axis, speedOf(capsule, q0, q1), capsule.radius});
    if (found.outcome == oracle::TouchOutcome::Free) continue;
    if (first.outcome == oracle::TouchOutcome::Free || found.t < first.t) first = found;
  }
  return first;
}

double PlanJudge::separationAt(const std::vector<double>& q, double bound) const {
  double least = bound;
  for (const Capsule& capsule : capsules_) {
    const PlainFrame frame = frameOf(capsule.link, q);
    const double distance = oracle::distanceTo(scene_, placed(frame, capsule.a),
                                               placed(frame, capsule.b), least + capsule.radius);
    least = std::min(least, distance - capsule.radius);
  }
  return least;
}

}  // namespace foretouch::test
