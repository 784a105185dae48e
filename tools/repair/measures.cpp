#include "tools/repair/measures.h"

#include <algorithm>
#include <cmath>

#include "articulated/link_places.h"
#include "lss/index.h"
#include "tools/floor/resting_body.h"
#include "tools/percentile.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;

/// A joint that moved or turned by less (m, rad) is where it was: files keep six digits.
constexpr double kStill = 2e-6;

Spread spreadOf(std::vector<double> values) {
  Spread spread;
  if (values.empty()) return spread;
  for (const double value : values) spread.mean += value / static_cast<double>(values.size());
  spread.p99 = percentile(values, 0.99);
  spread.most = *std::max_element(values.begin(), values.end());
  return spread;
}

/// The places of joints, per pose and joint.
std::vector<std::vector<Vector3d>> placesOf(const Skeleton& skeleton,
                                            const std::vector<Pose>& poses) {
  std::vector<std::vector<Vector3d>> places;
  std::vector<LinkState> states;
  for (const Pose& pose : poses) {
    placesAt(skeleton, pose, states);
    auto& at = places.emplace_back();
    for (const LinkState& state : states) at.push_back(state.p_WL);
  }
  return places;
}

/// The jerk about the poses that count: where any of the four does that a jerk is made of.
double jerkOf(const std::vector<std::vector<Vector3d>>& places, double stepS,
              const std::vector<std::uint8_t>& counts) {
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 3; i < places.size(); ++i) {
    if ((counts[i] | counts[i - 1] | counts[i - 2] | counts[i - 3]) == 0) continue;
    for (std::size_t j = 0; j < places[i].size(); ++j, ++count) {
      const Vector3d third =
          places[i][j] - 3.0 * places[i - 1][j] + 3.0 * places[i - 2][j] - places[i - 3][j];
      sum += third.norm() / (stepS * stepS * stepS);
    }
  }
  return count == 0 ? 0.0 : sum / static_cast<double>(count);
}

}  // namespace

Measures measuresOf(const RepairStage& stage, const std::vector<Pose>& before) {
  const Skeleton& skeleton = stage.body().skeleton();
  const auto& after = stage.poses();
  const auto from = placesOf(skeleton, before), to = placesOf(skeleton, after);
  const std::size_t joints = countOf(skeleton.numJoints());
  Measures measures;
  std::vector<std::uint8_t> changed(after.size(), 0);
  std::vector<double> moves, turns, changedMoves, changedTurns;
  std::vector<std::vector<double>> ofJoint(joints), turnsOfJoint(joints);
  for (std::size_t i = 0; i < after.size(); ++i) {
    bool isChanged = false;
    for (std::size_t j = 0; j < joints; ++j) {
      ofJoint[j].push_back((to[i][j] - from[i][j]).norm());
      turnsOfJoint[j].push_back(Eigen::Quaterniond(before[i].rotations[j])
                                    .angularDistance(Eigen::Quaterniond(after[i].rotations[j])));
      isChanged = isChanged || ofJoint[j].back() > kStill || turnsOfJoint[j].back() > kStill;
    }
    changed[i] = isChanged ? 1 : 0;
    measures.changedPoses += changed[i];
    for (std::size_t j = 0; j < joints; ++j) {
      moves.push_back(ofJoint[j].back());
      turns.push_back(turnsOfJoint[j].back());
      if (!isChanged) continue;
      changedMoves.push_back(ofJoint[j].back());
      changedTurns.push_back(turnsOfJoint[j].back());
    }
  }
  for (std::size_t j = 0; j < joints; ++j) {
    JointMoved moved{static_cast<JointId>(j), spreadOf(ofJoint[j]), spreadOf(turnsOfJoint[j]), 0};
    if (moved.move.most <= kStill && moved.turn.most <= kStill) continue;
    moved.worstPose = static_cast<std::int32_t>(
        std::max_element(ofJoint[j].begin(), ofJoint[j].end()) - ofJoint[j].begin());
    measures.joints.push_back(moved);
  }
  std::stable_sort(
      measures.joints.begin(), measures.joints.end(),
      [](const JointMoved& x, const JointMoved& y) { return x.move.most > y.move.most; });
  measures.move = spreadOf(std::move(moves));
  measures.turn = spreadOf(std::move(turns));
  measures.moveChanged = spreadOf(std::move(changedMoves));
  measures.turnChanged = spreadOf(std::move(changedTurns));
  const auto jerks = [&](const std::vector<std::uint8_t>& counts) {
    return Jerk{jerkOf(from, stage.feet().stepS(), counts),
                jerkOf(to, stage.feet().stepS(), counts)};
  };
  measures.jerk = jerks(std::vector<std::uint8_t>(after.size(), 1));
  measures.jerkChanged = jerks(changed);
  return measures;
}

}  // namespace foretouch::tools
