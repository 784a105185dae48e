#include "tools/repair/levers.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "articulated/link_places.h"
#include "lss/index.h"

namespace foretouch::tools {
namespace {

/// The cost of turning, beside what it moves: as if each joint carried something at 10 cm. Without
/// it fingers and toes, which move little, would turn far.
constexpr double kTurnCost = 0.01;
/// The same for shifts: the share of the body that they count as at least.
constexpr double kShiftCost = 0.02;
/// A limb with so many knobs can get out of the way by itself.
constexpr std::size_t kEnoughKnobs = 3;
/// Poses over which costs are averaged.
constexpr std::int32_t kMetricPoses = 32;

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// d of exp(v + d) = exp(v) exp(tilt * d), to first order: the right Jacobian of rotations.
Matrix3d tiltOf(const Vector3d& v) {
  const double angle = v.norm();
  Matrix3d cross;
  cross << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  if (angle < 1e-6) return Matrix3d::Identity() - 0.5 * cross;
  const double square = angle * angle;
  return Matrix3d::Identity() - (1.0 - std::cos(angle)) / square * cross +
         (angle - std::sin(angle)) / (square * angle) * cross * cross;
}

}  // namespace

Levers::Levers(const RepairStage& stage) : stage_(stage), R_WClip_(stage.R_WClip()) {
  const Skeleton& skeleton = stage.body().skeleton();
  const auto& sources = stage.feet().played.match.clipJointOf;
  levers_.resize(countOf(skeleton.numJoints()));
  for (LinkId link = 0; link < skeleton.numJoints(); ++link) {
    std::vector<Lever>& own = levers_[slotOf(link)];
    if (const JointId above = skeleton.parent(link); above != kNoParent)
      own = levers_[slotOf(above)];
    for (std::size_t k = 0; k < stage.knobs().size(); ++k) {
      for (const Drive& drive : stage.knobs()[k].drives) {
        if (drive.joint != sources[slotOf(link)]) continue;
        own.push_back({static_cast<std::int32_t>(k), link, drive.joint, drive.turns, drive.along});
      }
    }
  }
  std::vector<std::uint8_t> carriesFoot(levers_.size(), 0);
  for (const RestingPart& part : stage.feet().body.parts) {
    for (JointId at = part.isHand() ? kNoParent : part.joint; at != kNoParent;
         at = skeleton.parent(at)) {
      carriesFoot[slotOf(at)] = 1;
    }
  }
  for (const std::vector<Lever>& all : levers_) {
    std::vector<Lever>& own = limbs_.emplace_back();
    std::copy_if(all.begin(), all.end(), std::back_inserter(own),
                 [&](const Lever& lever) { return carriesFoot[slotOf(lever.joint)] == 0; });
    if (own.size() < kEnoughKnobs) own = all;
  }
}

void Levers::addBeside(LinkId other, const SeenPoint& point, const Sight& sight,
                       std::vector<RowTerm>& terms) const {
  std::vector<Lever> own;
  for (const Lever& lever : levers_[slotOf(point.link)]) {
    const auto isOfOther = [&](const Lever& beside) { return beside.joint == lever.joint; };
    const auto& all = levers_[slotOf(other)];
    if (std::none_of(all.begin(), all.end(), isOfOther)) own.push_back(lever);
  }
  add(own, point, sight, terms);
}

void Levers::setChanges(const Changes& changes) {
  const std::size_t joints = countOf(stage_.feet().played.clip.skeleton.numJoints());
  tilts_.resize(slotOf(changes.cols()));
  for (std::size_t pose = 0; pose < tilts_.size(); ++pose) {
    const auto turns =
        turnsOf(stage_.knobs(), changes.col(static_cast<Eigen::Index>(pose)), joints);
    tilts_[pose].clear();
    for (const Vector3d& turn : turns) tilts_[pose].push_back(tiltOf(turn));
  }
}

void Levers::add(const std::vector<Lever>& levers, const SeenPoint& point, const Sight& sight,
                 std::vector<RowTerm>& terms) const {
  if (sight.share == 0.0) return;
  const Skeleton& skeleton = stage_.body().skeleton();
  for (const Lever& lever : levers) {
    const LinkState& joint = sight.states[slotOf(lever.joint)];
    Vector3d moves_W;
    if (lever.turns) {
      const Matrix3d& tilt = tilts_[slotOf(sight.pose)][slotOf(lever.clipJoint)];
      moves_W = (joint.R_WL * (tilt * lever.along)).cross(point.p_W - joint.p_WL);
    } else {
      const JointId above = skeleton.parent(lever.joint);
      moves_W = (above == kNoParent ? R_WClip_ : sight.states[slotOf(above)].R_WL) * lever.along;
    }
    const double by = sight.share * point.along_W.dot(moves_W);
    if (by != 0.0) terms.push_back({sight.pose, lever.knob, by});
  }
}

Eigen::MatrixXd Levers::metric() const {
  const auto knobs = static_cast<Eigen::Index>(stage_.knobs().size());
  Eigen::MatrixXd metric = Eigen::MatrixXd::Zero(knobs, knobs);
  const Skeleton& skeleton = stage_.body().skeleton();
  std::vector<LinkState> states;
  const std::int32_t looks = std::min(kMetricPoses, stage_.numPoses());
  const double share = 1.0 / (static_cast<double>(looks) * skeleton.numJoints());
  for (std::int32_t look = 0; look < looks; ++look) {
    const std::int32_t pose =
        static_cast<std::int32_t>(static_cast<std::int64_t>(look) * stage_.numPoses() / looks);
    placesAt(skeleton, stage_.poses()[slotOf(pose)], states);
    for (LinkId link = 0; link < skeleton.numJoints(); ++link) {
      for (int axis = 0; axis < 3; ++axis) {
        std::vector<RowTerm> terms;
        add({link, states[slotOf(link)].p_WL, Vector3d::Unit(axis)}, {states, pose, 1.0}, terms);
        for (const RowTerm& one : terms) {
          for (const RowTerm& other : terms) {
            metric(one.knob, other.knob) += share * one.by * other.by;
          }
        }
      }
    }
  }
  for (Eigen::Index k = 0; k < knobs; ++k) {
    for (const Drive& drive : stage_.knobs()[slotOf(k)].drives) {
      metric(k, k) += (drive.turns ? kTurnCost : kShiftCost) * drive.along.squaredNorm();
    }
  }
  return metric;
}

}  // namespace foretouch::tools
