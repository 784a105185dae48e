// A robot's joint positions as a clip: assets/model/model_avatar.h.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

#include "articulated/robot.h"
#include "articulated/try.h"
#include "assets/bvh/bvh_limits.h"
#include "assets/bvh/bvh_reader.h"
#include "assets/model/joint_table.h"
#include "assets/model/model_avatar.h"
#include "assets/model/model_links.h"
#include "assets/model/model_ownership.h"
#include "assets/text_file.h"
#include "lss/index.h"

namespace foretouch {
namespace {

using internal::JointTable;

/// Radians or metres: the most that printing six digits may add to a limit.
constexpr double kLimitTolerance = 1e-5;

bool turns(RobotJointKind kind) {
  return kind == RobotJointKind::Revolute || kind == RobotJointKind::Continuous ||
         kind == RobotJointKind::Planar;
}

/// What a column of the table is about: a link's joint, and which of its numbers.
struct Column {
  LinkId link = kNoParent;
  std::int32_t number = 0;  ///< -1: one column cannot say all three of them.
};

constexpr std::array<const char*, 3> kPlanarNumbers = {"/x", "/y", "/angle"};

/// By joint name; a name without a joint may be a link's.
std::unordered_map<std::string, Column> columnsOf(const Model& model,
                                                  const std::vector<LinkId>& linkOfNode) {
  std::unordered_map<std::string, Column> known;
  const auto whole = [&](std::size_t node) {
    return Column{linkOfNode[node], model.nodes[node].joint == ModelJointType::Planar ? -1 : 0};
  };
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const std::string& name = model.nodes[i].jointName;
    if (name.empty()) continue;
    known.emplace(name, whole(i));
    if (model.nodes[i].joint != ModelJointType::Planar) continue;
    for (std::size_t k = 0; k < kPlanarNumbers.size(); ++k) {
      known.emplace(name + kPlanarNumbers[k], Column{linkOfNode[i], static_cast<std::int32_t>(k)});
    }
  }
  for (std::size_t i = 0; i < model.nodes.size(); ++i) known.emplace(model.nodes[i].name, whole(i));
  return known;
}

/// A robot that has no shape, and which of its coordinates each column sets.
class TableRobot {
 public:
  static Result<TableRobot> of(const Model& model, const JointTable& table);

  [[nodiscard]] const Robot& robot() const { return *robot_; }
  /// Sets the coordinates of a row; those without a column stay.
  void read(const std::vector<double>& row, std::vector<double>& q) const {
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (coordinates_[i] >= 0) q[slotOf(coordinates_[i])] = row[i] * units_[i];
    }
  }
  /// Places what the table's roots are about: at `root` in the frame of the robot's file.
  void placeRoot(const RigidPose& root, Pose& pose) const;
  [[nodiscard]] JointId base() const { return base_; }
  /// Raises what joints are beyond their limits by.
  void checkLimits(const std::vector<double>& q);
  [[nodiscard]] std::vector<std::string> notes(const JointTable& table) const;
  /// A column moves the link's joint, or the joint follows another one.
  [[nodiscard]] bool isMoved(std::size_t link) const {
    return isNamed_[link] || robot_->joints()[link].mimicOf != kNoParent;
  }

 private:
  Result<Done> findColumns(const Model& model, const JointTable& table,
                           std::vector<RobotJoint>& joints);
  Result<Done> findBase(const Model& model);
  void findCoordinates(const JointTable& table);

  std::vector<LinkId> linkOfNode_;
  std::vector<Column> columns_;
  std::vector<std::int32_t> coordinates_;  // per column; -1: its joint does not move
  std::vector<double> units_;              // per column: radians or metres per unit of it
  std::vector<bool> isNamed_;              // per link
  JointId base_ = 0;                       // moves with the table's roots
  RigidPose baseFrame_;                    // which they are in, in the base's parent's or W
  std::vector<double> worstExcess_;        // per link: past a limit, radians or metres
  std::shared_ptr<const Robot> robot_;
};

/// What a table may leave out: an axis without a direction, limits that are none.
void bear(RobotJoint& joint) {
  const double length = joint.axis.norm();
  if (!std::isfinite(length) || !(length > 0.0)) joint.kind = RobotJointKind::Fixed;
  if (joint.lower <= joint.upper) return;
  joint.lower = -RobotJoint::kUnlimited;
  joint.upper = RobotJoint::kUnlimited;
}

Result<Done> TableRobot::findColumns(const Model& model, const JointTable& table,
                                     std::vector<RobotJoint>& joints) {
  const auto known = columnsOf(model, linkOfNode_);
  std::vector<std::array<bool, 3>> isSet(joints.size());
  for (const std::string& name : table.joints) {
    const auto found = known.find(name);
    if (found == known.end() || found->second.link == kNoParent) {
      const bool isOfRoot =
          std::count(internal::rootColumns().begin(), internal::rootColumns().end(), name) > 0;
      return Error::of(ErrorCode::UnknownName,
                       "the robot has no joint " + inQuotes(name) +
                           (isOfRoot ? "; a root that moves has all of root_x, root_y, root_z, "
                                       "root_qx, root_qy, root_qz, root_qw"
                                     : ""));
    }
    const Column column = found->second;
    RobotJoint& joint = joints[slotOf(column.link)];
    if (column.number < 0) {
      return Error::of(ErrorCode::Mismatch, "joint " + inQuotes(joint.name) +
                                                " moves by three numbers: expected columns " +
                                                inQuotes(joint.name + "/x") + ", " +
                                                inQuotes(joint.name + "/y") + " and " +
                                                inQuotes(joint.name + "/angle"));
    }
    if (isSet[slotOf(column.link)][slotOf(column.number)]) {
      return Error::of(ErrorCode::DuplicateName,
                       "column " + inQuotes(name) + " moves a joint that an earlier column moves");
    }
    isSet[slotOf(column.link)][slotOf(column.number)] = true;
    isNamed_[slotOf(column.link)] = true;
    joint.mimicOf = kNoParent;  // the table says where it is
    columns_.push_back(column);
  }
  return Done{};
}

Result<TableRobot> TableRobot::of(const Model& model, const JointTable& table) {
  FORETOUCH_CHECK(internal::checkModel(model));
  FORETOUCH_TRY(auto links, internal::modelLinks(model, internal::ownershipOf(model)));
  const std::size_t n = links.nodeOfLink.size();
  TableRobot made;
  made.linkOfNode_ = std::move(links.linkOfNode);
  made.isNamed_.assign(n, false);
  made.worstExcess_.assign(n, 0.0);
  auto joints = internal::robotJoints(model, made.linkOfNode_, n);
  std::for_each(joints.begin(), joints.end(), bear);
  FORETOUCH_CHECK(made.findColumns(model, table, joints));
  std::vector<std::vector<Lss>> noShape(n);
  noShape.front().emplace_back();  // an avatar has one; no pose depends on it
  FORETOUCH_TRY(auto avatar, Avatar::build(std::move(links.skeleton), std::move(noShape)));
  FORETOUCH_TRY(auto robot, Robot::build(std::move(avatar), std::move(joints)));
  made.robot_ = std::make_shared<const Robot>(std::move(robot));
  made.findCoordinates(table);
  if (!table.roots.empty()) FORETOUCH_CHECK(made.findBase(model));
  return made;
}

void TableRobot::findCoordinates(const JointTable& table) {
  std::vector<std::int32_t> first(robot_->joints().size(), -1);
  const auto& coordinates = robot_->coordinates();
  for (std::size_t i = coordinates.size(); i-- > 0;) {
    first[slotOf(coordinates[i].joint)] = static_cast<std::int32_t>(i);
  }
  for (const Column& column : columns_) {
    const std::int32_t own = first[slotOf(column.link)];
    coordinates_.push_back(own < 0 ? -1 : own + column.number);
    const bool isAngle = own < 0 || coordinates[slotOf(coordinates_.back())].isAngle;
    units_.push_back(isAngle ? table.radiansPerUnit : table.metresPerUnit);
  }
}

Result<Done> TableRobot::findBase(const Model& model) {
  const Skeleton& skeleton = robot_->avatar().skeleton();
  if (model.frame.up == UpAxis::Z) {
    constexpr double kHalf = 0.70710678118654752440;
    baseFrame_.rotation = Quaternion(kHalf, -kHalf, 0.0, 0.0);  // z becomes y
  }
  std::size_t floating = 0;
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const LinkId link = linkOfNode_[i];
    const bool floats = model.nodes[i].joint == ModelJointType::Free && link != kNoParent &&
                        skeleton.parent(link) != kNoParent;
    if (!floats) continue;
    ++floating;
    base_ = link;
    baseFrame_ = {skeleton.restRotation(link), skeleton.restOffset(link)};
  }
  if (floating <= 1) return Done{};
  return Error::of(ErrorCode::BadHierarchy,
                   "expected a robot with one floating joint at most, as one root moves, found " +
                       std::to_string(floating));
}

void TableRobot::placeRoot(const RigidPose& root, Pose& pose) const {
  const Eigen::Quaterniond frame(baseFrame_.rotation);
  pose.rotations[slotOf(base_)] =
      Quaternion((frame * Eigen::Quaterniond(root.rotation)).normalized());
  pose.translations[slotOf(base_)] = frame * root.translation + baseFrame_.translation;
}

void TableRobot::checkLimits(const std::vector<double>& q) {
  for (std::size_t link = 0; link < worstExcess_.size(); ++link) {
    const RobotJoint& joint = robot_->joints()[link];
    const bool isLimited =
        joint.kind == RobotJointKind::Revolute || joint.kind == RobotJointKind::Prismatic;
    if (!isLimited || !isMoved(link)) continue;
    const double value = robot_->valueOf(static_cast<JointId>(link), q.data());
    worstExcess_[link] = std::max({worstExcess_[link], joint.lower - value, value - joint.upper});
  }
}

std::vector<std::string> TableRobot::notes(const JointTable& table) const {
  std::vector<std::string> notes, idle, beyond;
  double worst = 0.0;
  for (std::size_t i = 0; i < coordinates_.size(); ++i) {
    if (coordinates_[i] < 0) idle.push_back(table.joints[i]);
  }
  for (std::size_t link = 0; link < worstExcess_.size(); ++link) {
    if (!(worstExcess_[link] > kLimitTolerance)) continue;
    beyond.push_back(robot_->joints()[link].name);
    worst = std::max(worst, worstExcess_[link]);
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

/// How the ways between rows are cut: all alike, as frames are equally spaced.
struct Cut {
  int parts = 1;
  double mostTurn = 0.0;  ///< From one row to the next (rad).
};

Result<Cut> cutOf(const TableRobot& of, const JointTable& table) {
  const std::size_t nodes = countOf(of.robot().avatar().numLinks());
  const std::size_t mostFrames = kMaxBvhValues / 3 / nodes;
  if (table.rows.size() > mostFrames) {
    return Error::of(ErrorCode::LimitExceeded, "expected at most " + std::to_string(mostFrames) +
                                                   " frames of " + std::to_string(nodes) +
                                                   " nodes, found " +
                                                   std::to_string(table.rows.size()));
  }
  const auto most = static_cast<int>(
      std::min<std::size_t>(Robot::kMostParts, (mostFrames - 1) / (table.rows.size() - 1)));
  std::vector<double> from(of.robot().numCoordinates(), 0.0), to = from;
  of.read(table.rows.front(), to);
  Cut cut;
  for (std::size_t row = 1; row < table.rows.size(); ++row) {
    std::swap(from, to);
    of.read(table.rows[row], to);
    const int parts = of.robot().partsBetween(from.data(), to.data(), most);
    cut.mostTurn = std::max(cut.mostTurn, of.robot().largestTurn(from.data(), to.data()));
    cut.parts = std::max(cut.parts, parts);
    if (parts > 0) continue;
    Error error =
        Error::of(ErrorCode::LimitExceeded,
                  "a joint turns by " + std::to_string(cut.mostTurn) +
                      " rad since the row before: expected at most " +
                      std::to_string(Robot::kMostTurn * most) +
                      ", as each row's way to the next is cut into parts of less than a half turn");
    error.line = table.lines[row];
    return error;
  }
  return cut;
}

std::string noteOn(const Cut& cut) {
  return "a joint turns by " + std::to_string(cut.mostTurn) +
         " rad from one row to the next, and goes the way that its numbers say: " +
         std::to_string(cut.parts - 1) + (cut.parts == 2 ? " pose is" : " poses are") +
         " put between every two rows, so " + std::to_string(cut.parts) + " steps make up a row";
}

/// Where the root is on its way from one row to the next, as between any two poses.
RigidPose between(const RigidPose& from, const RigidPose& to, double share) {
  return {from.rotation.slerp(share, to.rotation),
          from.translation + share * (to.translation - from.translation)};
}

Result<std::vector<Pose>> framesOf(TableRobot& of, const JointTable& table, const Cut& cut) {
  const Robot& robot = of.robot();
  std::vector<Pose> frames;
  frames.reserve((table.rows.size() - 1) * slotOf(cut.parts) + 1);
  // Part `part` of the way to a row.
  const auto add = [&](const std::vector<double>& q, std::size_t row, int part) -> Result<Done> {
    Pose pose;
    robot.poseAt(q.data(), pose);
    if (!table.roots.empty()) {
      const RigidPose& to = table.roots[row];
      const double share = static_cast<double>(part) / cut.parts;
      of.placeRoot(part == cut.parts ? to : between(table.roots[row - 1], to, share), pose);
    }
    auto valid = validatedPose(robot.avatar().skeleton(), std::move(pose));
    if (!valid.ok()) {
      Error error = valid.error();
      error.line = table.lines[row];
      return error;
    }
    frames.push_back(std::move(valid).value());
    return Done{};
  };
  std::vector<double> from(robot.numCoordinates(), 0.0), to = from, q = from;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    std::swap(from, to);
    of.read(table.rows[row], to);
    of.checkLimits(to);
    for (int part = 1; row > 0 && part < cut.parts; ++part) {
      robot.between(from.data(), to.data(), static_cast<double>(part) / cut.parts, q.data());
      FORETOUCH_CHECK(add(q, row, part));
    }
    FORETOUCH_CHECK(add(to, row, cut.parts));
  }
  return frames;
}

/// The frames are those of the robot.
Clip clipOf(const TableRobot& of, std::vector<Pose> frames, double frameTimeS, bool movesAll) {
  Clip clip{of.robot().avatar().skeleton(), frameTimeS, std::move(frames), {}, {}, {}, {}};
  const auto& joints = of.robot().joints();
  for (std::size_t link = 0; link < joints.size(); ++link) {
    const RobotJointKind kind = joints[link].kind;
    const bool shifts = kind == RobotJointKind::Prismatic || kind == RobotJointKind::Planar;
    const bool moves = movesAll || of.isMoved(link);
    clip.hasRotation.push_back(moves && turns(kind));
    clip.hasTranslation.push_back(moves && shifts);
  }
  clip.endSites.resize(joints.size());
  return clip;
}

}  // namespace

Result<Clip> internal::clipOfTable(const Model& model, const JointTable& table) {
  FORETOUCH_TRY(auto of, TableRobot::of(model, table));
  FORETOUCH_TRY(const Cut cut, cutOf(of, table));
  FORETOUCH_TRY(auto frames, framesOf(of, table, cut));
  Clip clip = clipOf(of, std::move(frames), table.frameTimeS / cut.parts, false);
  clip.notes = of.notes(table);
  if (cut.parts > 1) clip.notes.push_back(noteOn(cut));
  clip.framesPerRow = cut.parts;
  clip.mostTurn = cut.mostTurn / cut.parts;
  if (table.roots.empty()) return clip;
  clip.hasRotation[slotOf(of.base())] = true;
  clip.hasTranslation[slotOf(of.base())] = true;
  return clip;
}

Result<Clip> clipFromJointPositions(const Model& model, std::string_view csv,
                                    const std::string& name, const JointTableOptions& options) {
  FORETOUCH_TRY(const auto table, inFile(internal::parseJointTable(csv, options), name));
  return inFile(internal::clipOfTable(model, table), name);
}

Result<Clip> clipFromSampledJoints(const Model& model, std::int32_t samples, std::uint64_t seed) {
  FORETOUCH_TRY(const auto of, TableRobot::of(model, JointTable()));
  FORETOUCH_TRY(auto poses, of.robot().sampledPoses(samples, seed));
  return clipOf(of, std::move(poses), 1.0, true);
}

}  // namespace foretouch
