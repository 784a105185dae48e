#include "assets/clip/rigid_poses.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "articulated/quoted.h"
#include "articulated/try.h"
#include "assets/clip/clip_file.h"
#include "assets/model/joint_table.h"
#include "assets/near_names.h"
#include "assets/text_file.h"
#include "lss/index.h"

namespace foretouch {
namespace {

using internal::JointTable;

const std::vector<std::string>& poseColumns() {
  static const std::vector<std::string> names{"x", "y", "z", "qw", "qx", "qy", "qz"};
  return names;
}
constexpr std::size_t kOfPlace = 3, kOfRotation = 4;

/// Per name of poseColumns(), its place in a row; nothing where the table lacks it.
using Columns = std::array<std::optional<std::size_t>, kOfPlace + kOfRotation>;

Result<Columns> columnsOf(const JointTable& table) {
  const std::vector<std::string>& names = poseColumns();
  Columns columns;
  for (std::size_t i = 0; i < table.joints.size(); ++i) {
    const auto found = std::find(names.begin(), names.end(), table.joints[i]);
    if (found == names.end()) {
      return Error::of(
          ErrorCode::UnknownName,
          "expected the columns time, x, y, z and, if it turns, qw, qx, qy, qz, found " +
              inQuotes(table.joints[i]) + didYouMean(table.joints[i], names));
    }
    columns[slotOf(found - names.begin())] = i;
  }
  const auto missing = [&](std::size_t first, std::size_t count) -> std::optional<std::string> {
    for (std::size_t i = first; i < first + count; ++i) {
      if (!columns[i]) return names[i];
    }
    return std::nullopt;
  };
  const bool turns = table.joints.size() > kOfPlace;
  const auto lacking = missing(0, turns ? kOfPlace + kOfRotation : kOfPlace);
  if (!lacking) return columns;
  return Error::of(ErrorCode::Empty,
                   "expected a column " + inQuotes(*lacking) + " beside the others");
}

Result<RigidPose> poseOfRow(const std::vector<double>& row, const Columns& columns) {
  RigidPose pose;
  for (std::size_t i = 0; i < kOfPlace; ++i) {
    const double value = row[*columns[i]];
    if (std::abs(value) > kMaxCoordinate) {
      return Error::of(ErrorCode::OutOfRange, "expected a place within 1e7 m, found " +
                                                  inDigits(value) + " as " + poseColumns()[i]);
    }
    pose.translation[static_cast<Eigen::Index>(i)] = value;
  }
  if (!columns[kOfPlace]) return pose;
  const auto q = [&](std::size_t i) { return row[*columns[kOfPlace + i]]; };
  const auto unit = unitQuaternion(Quaternion(q(0), q(1), q(2), q(3)));
  if (!unit) {
    return Error::of(
        ErrorCode::OutOfRange,
        "expected qw, qx, qy, qz of norm 1 within 0.001, found " +
            inDigits(std::sqrt(q(0) * q(0) + q(1) * q(1) + q(2) * q(2) + q(3) * q(3))));
  }
  pose.rotation = *unit;
  return pose;
}

Result<std::vector<TimedRigidPose>> posesOf(const JointTable& table) {
  FORETOUCH_TRY(const auto columns, columnsOf(table));
  if (table.rows.empty()) return Error::of(ErrorCode::Empty, "expected at least one pose");
  std::vector<TimedRigidPose> poses;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    auto pose = poseOfRow(table.rows[i], columns);
    Error error;
    if (!pose.ok()) {
      error = pose.error();
    } else if (i > 0 && !(table.timesS[i] > table.timesS[i - 1])) {
      error = Error::of(ErrorCode::OutOfRange, "expected a time after " +
                                                   inDigits(table.timesS[i - 1], 17) +
                                                   " s, which the pose before it has, found " +
                                                   inDigits(table.timesS[i], 17) + " s");
    } else {
      poses.push_back({table.timesS[i], pose.value(), table.lines[i]});
      continue;
    }
    error.line = table.lines[i];
    return error;
  }
  return poses;
}

}  // namespace

Result<std::vector<TimedRigidPose>> parseRigidPoses(std::string_view csv, const std::string& name) {
  FORETOUCH_TRY(const auto table, inFile(internal::parseTimedTable(csv), name));
  return inFile(posesOf(table), name);
}

Result<std::vector<TimedRigidPose>> readRigidPoses(const std::string& path) {
  FORETOUCH_TRY(const auto text, readWholeFile(path, kMaxJointTableBytes));
  return parseRigidPoses(text, path);
}

}  // namespace foretouch
