#include "articulated/robot.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include <Eigen/Geometry>

#include "articulated/quoted.h"
#include "articulated/raw_skeleton.h"
#include "articulated/try.h"
#include "lss/index.h"
#include "lss/rounding.h"
#include "lss/turn_between.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;

Error refused(const Skeleton& skeleton, std::size_t joint, ErrorCode code, const char* why) {
  return Error::at(static_cast<std::int64_t>(joint), code,
                   "joint " + inQuotes(skeleton.name(static_cast<JointId>(joint))) + " " + why);
}

bool isSingle(RobotJointKind kind) {
  return kind == RobotJointKind::Revolute || kind == RobotJointKind::Continuous ||
         kind == RobotJointKind::Prismatic;
}

bool turns(RobotJointKind kind) {
  return kind == RobotJointKind::Revolute || kind == RobotJointKind::Continuous;
}

bool isLimited(RobotJointKind kind) {
  return kind == RobotJointKind::Revolute || kind == RobotJointKind::Prismatic;
}

/// What is wrong with how a joint follows another one; nullptr: nothing.
const char* wrongWithMimic(const std::vector<RobotJoint>& joints, const RobotJoint& joint) {
  if (joint.mimicOf == kNoParent) return nullptr;
  if (!isSingle(joint.kind)) return "follows another one, but has not one coordinate";
  if (joint.mimicOf < 0 || slotOf(joint.mimicOf) >= joints.size()) return "follows no joint";
  const RobotJoint& leader = joints[slotOf(joint.mimicOf)];
  if (!isSingle(leader.kind)) return "follows a joint that has not one coordinate";
  if (leader.mimicOf != kNoParent) return "follows a joint that follows another one, or itself";
  return std::isfinite(joint.mimicFactor) && std::isfinite(joint.mimicOffset)
             ? nullptr
             : "follows another one by a factor or an offset that is not finite";
}

Result<Done> checkJoint(const Skeleton& skeleton, const std::vector<RobotJoint>& joints,
                        std::size_t i) {
  const RobotJoint& joint = joints[i];
  if (joint.kind == RobotJointKind::Fixed) return Done{};
  if (!joint.axis.allFinite() || !(joint.axis.stableNorm() > 0.0)) {
    return refused(skeleton, i, ErrorCode::NonFinite, "has an axis that is zero or not finite");
  }
  if (std::isnan(joint.lower) || std::isnan(joint.upper)) {
    return refused(skeleton, i, ErrorCode::NonFinite, "has a limit that is not a number");
  }
  if (joint.lower > joint.upper) {
    return refused(skeleton, i, ErrorCode::OutOfRange, "has its lower limit above its upper one");
  }
  if (const char* wrong = wrongWithMimic(joints, joint)) {
    return refused(skeleton, i, ErrorCode::BadHierarchy, wrong);
  }
  return Done{};
}

/// The rounding of a joint's rotation in a computed pose (rad), and per unit of the largest
/// coordinate (robot.md 2).
constexpr double kTurnOfPose = 256.0 * kUnitRoundoff, kTurnPerCoordinate = 8.0 * kUnitRoundoff;

/// The rest pose, then a turn about a unit axis.
Quaternion turned(const Quaternion& rest, const Vector3d& axis, double angle) {
  const double sine = std::sin(0.5 * angle);
  return rest *
         Quaternion(std::cos(0.5 * angle), sine * axis.x(), sine * axis.y(), sine * axis.z());
}

}  // namespace

std::pair<Vector3d, Vector3d> planeAcross(const Vector3d& axis) {
  const Quaternion turn = turnBetween(Vector3d::UnitZ(), axis);
  return {turn * Vector3d::UnitX(), turn * Vector3d::UnitY()};
}

Result<Robot> Robot::build(Avatar avatar, std::vector<RobotJoint> joints) {
  if (joints.size() != countOf(avatar.numLinks())) {
    return Error::of(ErrorCode::Mismatch, "expected " + std::to_string(avatar.numLinks()) +
                                              " joints, one per link, found " +
                                              std::to_string(joints.size()));
  }
  for (std::size_t i = 0; i < joints.size(); ++i) {
    FORETOUCH_CHECK(checkJoint(avatar.skeleton(), joints, i));
    if (joints[i].kind != RobotJointKind::Fixed) joints[i].axis.stableNormalize();
  }
  Robot robot(std::move(avatar), std::move(joints));
  robot.listCoordinates();
  robot.boundRounding();
  return robot;
}

void Robot::listCoordinates() {
  firstCoordinate_.assign(joints_.size(), -1);
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    RobotJoint& joint = joints_[i];
    if (joint.name.empty()) joint.name = avatar_.skeleton().name(static_cast<JointId>(i));
    if (joint.kind == RobotJointKind::Fixed || joint.mimicOf != kNoParent) continue;
    firstCoordinate_[i] = static_cast<std::int32_t>(coordinates_.size());
    RobotCoordinate coordinate;
    coordinate.joint = static_cast<JointId>(i);
    if (joint.kind == RobotJointKind::Planar) {
      coordinate.isAngle = false;
      for (const char* axis : {"/x", "/y"}) {
        coordinate.name = joint.name + axis;
        coordinates_.push_back(coordinate);
      }
      coordinate.name = joint.name + "/angle";
      coordinate.isAngle = coordinate.isPeriodic = true;
    } else {
      coordinate.name = joint.name;
      coordinate.isAngle = turns(joint.kind);
      coordinate.isPeriodic = joint.kind == RobotJointKind::Continuous;
      if (isLimited(joint.kind)) {
        coordinate.lower = joint.lower;
        coordinate.upper = joint.upper;
      }
    }
    coordinates_.push_back(coordinate);
  }
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const JointId leader = joints_[i].mimicOf;
    if (leader == kNoParent) continue;
    firstCoordinate_[i] = firstCoordinate_[slotOf(leader)];
    // A whole turn of the leader need not be a whole turn of the follower.
    coordinates_[slotOf(firstCoordinate_[i])].isPeriodic = false;
  }
}

// articulated/robot.md 2 derives the factors.
void Robot::boundRounding() {
  const Skeleton& skeleton = avatar_.skeleton();
  std::vector<double> reach(joints_.size()), shares(joints_.size());
  double farthest = 0.0, sum = 0.0;
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const RobotJoint& joint = joints_[i];
    const JointId parent = skeleton.parent(static_cast<JointId>(i));
    const double most = kMaxJointCoordinate * std::max(1.0, std::abs(joint.mimicFactor)) +
                        std::abs(joint.mimicOffset);
    double arm = skeleton.restOffset(static_cast<JointId>(i)).norm();
    if (joint.kind == RobotJointKind::Prismatic) {
      arm += std::min(most, std::max(std::abs(joint.lower), std::abs(joint.upper)));
    } else if (joint.kind == RobotJointKind::Planar) {
      arm += 2.0 * kMaxJointCoordinate;
    }
    reach[i] = arm + (parent == kNoParent ? 0.0 : reach[slotOf(parent)]);
    shares[i] =
        (joint.kind == RobotJointKind::Fixed ? 0.0 : kTurnOfPose + kTurnPerCoordinate * most) +
        (parent == kNoParent ? 0.0 : shares[slotOf(parent)]);
    double own = 0.0;
    for (const Lss& lss : avatar_.lss(static_cast<LinkId>(i))) {
      own = std::max({own, lss.a.norm(), lss.b.norm()});
    }
    farthest = std::max(farthest, reach[i] + own);
    sum = std::max(sum, shares[i]);
  }
  poseRounding_ = 2.0 * sum * farthest;
  reach_ = farthest;
}

Result<Robot> Robot::withTool(LinkId link, const std::string& name, std::vector<Lss> lss) const {
  if (link < 0 || link >= avatar_.numLinks()) {
    return Error::in("tool", ErrorCode::OutOfRange, "expected a link of the robot");
  }
  if (lss.empty()) return Error::in("tool", ErrorCode::Empty, "expected at least one LSS");
  RawSkeleton raw = rawSkeleton(avatar_.skeleton());
  std::vector<std::vector<Lss>> perLink;
  std::vector<MeshReference> meshes;
  for (LinkId j = 0; j < avatar_.numLinks(); ++j) {
    perLink.push_back(avatar_.lss(j));
    meshes.push_back(avatar_.mesh(j));
  }
  raw.joints.push_back({name, link, Vector3d::Zero(), Quaternion::Identity()});
  perLink.push_back(std::move(lss));
  meshes.emplace_back();
  std::vector<RobotJoint> joints = joints_;
  joints.emplace_back();
  FORETOUCH_TRY(auto withLink, inFile(Skeleton::build(raw), "tool"));
  FORETOUCH_TRY(
      auto avatar,
      inFile(Avatar::build(std::move(withLink), std::move(perLink), std::move(meshes)), "tool"));
  return build(std::move(avatar), std::move(joints));
}

Result<Done> Robot::checked(const double* q, std::size_t count) const {
  if (count != coordinates_.size()) {
    return Error::in("q", ErrorCode::Mismatch,
                     "expected " + std::to_string(coordinates_.size()) +
                         " joint coordinates, found " + std::to_string(count));
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (std::abs(q[i]) <= kMaxJointCoordinate) continue;
    Error error = Error::in(
        "q", std::isfinite(q[i]) ? ErrorCode::OutOfRange : ErrorCode::NonFinite,
        "the coordinate of " + inQuotes(coordinates_[i].name) +
            (std::isfinite(q[i]) ? " is beyond 1000 rad or m" : " is not a finite number"));
    error.index = static_cast<std::int64_t>(i);
    return error;
  }
  return Done{};
}

double Robot::valueOf(JointId joint, const double* q) const {
  const double own = q[slotOf(firstCoordinate_[slotOf(joint)])];
  const RobotJoint& of = joints_[slotOf(joint)];
  return of.mimicOf == kNoParent ? own : of.mimicFactor * own + of.mimicOffset;
}

LimitBreach Robot::breachOf(const double* q) const {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const RobotJoint& joint = joints_[i];
    if (!isLimited(joint.kind)) continue;
    const double value = valueOf(static_cast<JointId>(i), q);
    if (value >= joint.lower && value <= joint.upper) continue;
    return {firstCoordinate_[i], static_cast<JointId>(i), value, joint.lower, joint.upper};
  }
  return {};
}

void Robot::poseAt(const double* q, Pose& pose) const {
  const Skeleton& skeleton = avatar_.skeleton();
  pose.rotations.resize(joints_.size());
  pose.translations.resize(joints_.size());
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const auto j = static_cast<JointId>(i);
    const RobotJoint& joint = joints_[i];
    Quaternion& rotation = pose.rotations[i] = skeleton.restRotation(j);
    Vector3d& translation = pose.translations[i] = skeleton.restOffset(j);
    switch (joint.kind) {
      case RobotJointKind::Fixed: continue;
      case RobotJointKind::Prismatic:
        translation += rotation * (valueOf(j, q) * joint.axis);
        continue;
      case RobotJointKind::Revolute:
      case RobotJointKind::Continuous:
        rotation = turned(rotation, joint.axis, valueOf(j, q)).normalized();
        continue;
      case RobotJointKind::Planar: {
        const double* own = q + firstCoordinate_[i];
        const auto [x, y] = planeAcross(joint.axis);
        translation += rotation * (own[0] * x + own[1] * y);
        rotation = turned(rotation, joint.axis, own[2]).normalized();
        continue;
      }
    }
  }
}

void Robot::slopeAt(const double* q, const std::vector<LinkState>& states, LinkId link,
                    const Vector3d& p_W, const Vector3d& along_W, double* slope) const {
  std::fill(slope, slope + coordinates_.size(), 0.0);
  for (JointId j = link; j != kNoParent; j = avatar_.skeleton().parent(j)) {
    const RobotJoint& joint = joints_[slotOf(j)];
    if (joint.kind == RobotJointKind::Fixed) continue;
    const LinkState& state = states[slotOf(j)];
    const Vector3d axis_W = state.R_WL * joint.axis;
    double* const own = slope + firstCoordinate_[slotOf(j)];
    const double turn = along_W.dot(axis_W.cross(p_W - state.p_WL));
    if (joint.kind == RobotJointKind::Planar) {
      // The plane does not turn with the joint.
      const double angle = q[firstCoordinate_[slotOf(j)] + 2];
      const Eigen::Matrix3d R_WPlane =
          state.R_WL * Eigen::AngleAxisd(-angle, joint.axis).toRotationMatrix();
      const auto [x, y] = planeAcross(joint.axis);
      own[0] += along_W.dot(R_WPlane * x);
      own[1] += along_W.dot(R_WPlane * y);
      own[2] += turn;
      continue;
    }
    const double factor = joint.mimicOf == kNoParent ? 1.0 : joint.mimicFactor;
    *own += factor * (turns(joint.kind) ? turn : along_W.dot(axis_W));
  }
}

double Robot::largestTurn(const double* q0, const double* q1) const {
  double largest = 0.0;
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const RobotJoint& joint = joints_[i];
    if (joint.kind == RobotJointKind::Planar) {
      const auto angle = slotOf(firstCoordinate_[i]) + 2;
      largest = std::max(largest, std::abs(q1[angle] - q0[angle]));
    } else if (turns(joint.kind)) {
      const auto j = static_cast<JointId>(i);
      largest = std::max(largest, std::abs(valueOf(j, q1) - valueOf(j, q0)));
    }
  }
  return largest;
}

int Robot::partsBetween(const double* q0, const double* q1, int most) const {
  const double turn = largestTurn(q0, q1);
  int parts = 1;
  while (parts <= most && turn > kMostTurn * parts) parts *= 2;
  return parts <= most ? parts : 0;
}

void Robot::between(const double* q0, const double* q1, double t, double* q) const {
  for (std::size_t i = 0; i < coordinates_.size(); ++i) {
    q[i] = t <= 0.0 ? q0[i] : t >= 1.0 ? q1[i] : q0[i] + t * (q1[i] - q0[i]);
  }
}

Result<RobotPath> Robot::pathAlong(const double* q, std::size_t count) const {
  if (count == 0) return Error::in("q", ErrorCode::Empty, "expected at least one configuration");
  const std::size_t n = coordinates_.size();
  for (std::size_t i = 0; i < count; ++i) FORETOUCH_CHECK(checked(q + i * n, n));
  RobotPath path;
  std::vector<double> between(n);
  const auto add = [&](const double* at, double where) {
    path.poses.emplace_back();
    poseAt(at, path.poses.back());
    path.at.push_back(where);
  };
  for (std::size_t i = 0; i + 1 < count; ++i) {
    const double *const from = q + i * n, *const to = from + n;
    const int parts = partsBetween(from, to, kMostParts);
    if (parts == 0) {
      Error error = Error::in("q", ErrorCode::LimitExceeded,
                              "expected an edge on which no joint turns by more than 12,288 rad");
      error.index = static_cast<std::int64_t>(i);
      return error;
    }
    for (int part = 0; part < parts; ++part) {
      const double t = static_cast<double>(part) / parts;
      this->between(from, to, t, between.data());
      add(between.data(), static_cast<double>(i) + t);
    }
  }
  add(q + (count - 1) * n, static_cast<double>(count - 1));
  return path;
}

Result<std::vector<Pose>> Robot::sampledPoses(std::int32_t count, std::uint64_t seed) const {
  if (count < 1) return Error::in("samples", ErrorCode::OutOfRange, "expected at least 1");
  constexpr double kHalfTurn = 3.14159265358979323846, kFarShift = 1.0;
  constexpr std::int64_t kMostTries = 100;  // per sample: mimics rarely have limits of their own
  std::mt19937_64 random(seed);
  std::vector<double> q(coordinates_.size(), 0.0);
  std::vector<Pose> poses;
  for (std::int64_t tries = 0; poses.size() < static_cast<std::size_t>(count); ++tries) {
    if (tries == kMostTries * count) {
      return Error::in("samples", ErrorCode::OutOfRange,
                       "of a hundred configurations within the joints' limits, hardly one keeps "
                       "those of the joints that follow them");
    }
    for (std::size_t i = 0; i < q.size(); ++i) {
      const RobotCoordinate& coordinate = coordinates_[i];
      if (joints_[slotOf(coordinate.joint)].kind == RobotJointKind::Planar) continue;
      const double most = coordinate.isAngle ? kHalfTurn : kFarShift;
      const double lower = std::isfinite(coordinate.lower)
                               ? coordinate.lower
                               : std::min(-most, coordinate.upper - most);
      const double upper = std::isfinite(coordinate.upper)
                               ? coordinate.upper
                               : std::max(most, coordinate.lower + most);
      q[i] = lower + (upper - lower) * (static_cast<double>(random() >> 11U) * 0x1p-53);
    }
    if (breachOf(q.data()).isAny()) continue;
    poses.emplace_back();
    poseAt(q.data(), poses.back());
  }
  return poses;
}

}  // namespace foretouch
