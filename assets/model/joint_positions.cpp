// A robot's joint positions as a clip: assets/model/model_clip.h.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "articulated/try.h"
#include "assets/model/joint_table.h"
#include "assets/model/model_clip.h"
#include "assets/model/model_frames.h"
#include "assets/model/pose_frames.h"
#include "assets/text_file.h"
#include "lss/index.h"

namespace foretouch {
namespace {

using internal::JointTable;

/// Radians or metres: the most that printing six digits may add to a limit.
constexpr double kLimitTolerance = 1e-5;

bool turns(const ModelNode& node) {
  return node.joint == ModelJointType::Revolute || node.joint == ModelJointType::Continuous;
}

/// One column of the table and the node that it moves.
struct Drive {
  std::int32_t node = -1;
  double worstExcess = 0.0;  ///< Past a limit, radians or metres.
};

/// By joint name; a name without a joint may be a node's.
Result<std::vector<Drive>> findDrives(const Model& model, const JointTable& table) {
  std::unordered_map<std::string, std::int32_t> joints, nodes;
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const ModelNode& node = model.nodes[i];
    if (!node.jointName.empty()) joints.emplace(node.jointName, static_cast<std::int32_t>(i));
    nodes.emplace(node.name, static_cast<std::int32_t>(i));
  }
  std::vector<Drive> drives;
  std::vector<bool> isDriven(model.nodes.size(), false);
  for (const std::string& name : table.joints) {
    auto found = joints.find(name);
    if (found == joints.end() && (found = nodes.find(name)) == nodes.end()) {
      return Error::of(ErrorCode::UnknownName, "the robot has no joint " + inQuotes(name));
    }
    if (isDriven[slotOf(found->second)]) {
      return Error::of(ErrorCode::DuplicateName,
                       "column " + inQuotes(name) + " moves a joint that an earlier column moves");
    }
    isDriven[slotOf(found->second)] = true;
    drives.push_back({found->second, 0.0});
  }
  return drives;
}

bool isMovable(const ModelNode& node) {
  const double length = node.axis.norm();
  return (turns(node) || node.joint == ModelJointType::Prismatic) && std::isfinite(length) &&
         length > 0.0;
}

void checkLimits(const ModelNode& node, double position, Drive& drive) {
  const bool isLimited =
      node.joint != ModelJointType::Continuous && node.lowerLimit < node.upperLimit;
  if (!isLimited) return;
  drive.worstExcess =
      std::max({drive.worstExcess, node.lowerLimit - position, position - node.upperLimit});
}

/// The node's frame in its parent's, with its joint at `position`.
Affine movedFrame(const ModelNode& node, double position) {
  const Eigen::Vector3d axis = node.axis.normalized();
  Affine motion;
  if (turns(node)) {
    motion.linear = Eigen::AngleAxisd(position, axis).toRotationMatrix();
  } else {
    motion.translation = position * axis;
  }
  return node.toParent * motion;
}

std::vector<std::string> notesOn(const Model& model, const JointTable& table,
                                 const std::vector<Drive>& drives) {
  std::vector<std::string> notes, idle, beyond;
  double worst = 0.0;
  for (std::size_t i = 0; i < drives.size(); ++i) {
    if (!isMovable(model.nodes[slotOf(drives[i].node)])) idle.push_back(table.joints[i]);
    if (!(drives[i].worstExcess > kLimitTolerance)) continue;
    beyond.push_back(table.joints[i]);
    worst = std::max(worst, drives[i].worstExcess);
  }
  if (!idle.empty()) {
    notes.push_back("columns of joints that do not move are left out: " + internal::listed(idle));
  }
  if (!beyond.empty()) {
    notes.push_back("positions beyond the joints' limits, by up to " + std::to_string(worst) +
                    " (rad or m): " + internal::listed(beyond));
  }
  return notes;
}

Result<Clip> clipOf(const Model& model, const JointTable& table, std::vector<Drive> drives) {
  FORETOUCH_TRY(auto collector, internal::FrameCollector::create(model, table.rows.size()));
  for (const Drive& drive : drives) {
    const ModelNode& node = model.nodes[slotOf(drive.node)];
    if (isMovable(node)) collector.moves(drive.node, turns(node));
  }
  std::vector<Affine> frames = internal::restFrames(model);
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    for (std::size_t i = 0; i < drives.size(); ++i) {
      const ModelNode& node = model.nodes[slotOf(drives[i].node)];
      if (!isMovable(node)) continue;
      checkLimits(node, table.rows[row][i], drives[i]);
      frames[slotOf(drives[i].node)] = movedFrame(node, table.rows[row][i]);
    }
    const auto added = collector.add(frames);
    if (added.ok()) continue;
    Error error = added.error();
    error.line = table.lines[row];
    return error;
  }
  return collector.take(table.frameTimeS, notesOn(model, table, drives));
}

}  // namespace

Result<Clip> clipFromJointPositions(const Model& model, std::string_view csv,
                                    const std::string& name) {
  FORETOUCH_TRY(const auto table, inFile(internal::parseJointTable(csv), name));
  FORETOUCH_TRY(auto drives, inFile(findDrives(model, table), name));
  return inFile(clipOf(model, table, std::move(drives)), name);
}

}  // namespace foretouch
