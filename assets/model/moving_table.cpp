// Tables of a robot's joint positions whose root may move: assets/model/joint_table.h.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "articulated/quoted.h"
#include "articulated/try.h"
#include "assets/bvh/bvh_text.h"
#include "assets/model/joint_table.h"
#include "assets/near_names.h"
#include "lss/index.h"

namespace foretouch::internal {
namespace {

constexpr double kRadiansPerDegree = 3.14159265358979323846 / 180.0;
constexpr std::size_t kRootNumbers = 7;

/// What BONES-SEED calls where its root is, and how it is turned.
const std::vector<std::string>& seedColumns() {
  static const std::vector<std::string> names{"root_translateX", "root_translateY",
                                              "root_translateZ", "root_rotateX",
                                              "root_rotateY",    "root_rotateZ"};
  return names;
}

/// Takes columns away from a table.
class ColumnsTaken {
 public:
  explicit ColumnsTaken(JointTable& table) : table_(table), isTaken_(table.joints.size(), false) {}

  /// Their places, or nothing if one of them is not there.
  std::vector<std::size_t> take(const std::vector<std::string>& names) {
    std::vector<std::size_t> places;
    for (const std::string& name : names) {
      const auto found = std::find(table_.joints.begin(), table_.joints.end(), name);
      if (found == table_.joints.end()) return {};
      places.push_back(slotOf(found - table_.joints.begin()));
    }
    for (const std::size_t place : places) isTaken_[place] = true;
    return places;
  }
  void leaveTheRest() {
    const auto sift = [&](auto& values) {
      std::size_t kept = 0;
      for (std::size_t i = 0; i < values.size(); ++i) {
        if (!isTaken_[i]) std::swap(values[kept++], values[i]);
      }
      values.resize(kept);
    };
    for (std::vector<double>& row : table_.rows) sift(row);
    sift(table_.joints);
  }

 private:
  JointTable& table_;
  std::vector<bool> isTaken_;
};

/// From three angles about fixed axes, x first.
void turnSeedAngles(const double* degrees, double* xyzw) {
  using Turn = Eigen::AngleAxisd;
  const auto about = [&](int axis) {
    return Turn(degrees[axis] * kRadiansPerDegree, Eigen::Vector3d::Unit(axis));
  };
  const Eigen::Quaterniond turn(about(2) * about(1) * about(0));
  for (Eigen::Index i = 0; i < 4; ++i) xyzw[i] = turn.coeffs()[i];
}

Result<Done> takeRoots(JointTable& table, const std::vector<std::size_t>& places, bool isOfSeed,
                       double metresPerUnit) {
  for (std::size_t row = 0; !places.empty() && row < table.rows.size(); ++row) {
    std::array<double, kRootNumbers> numbers{};
    for (std::size_t i = 0; i < places.size(); ++i) numbers[i] = table.rows[row][places[i]];
    if (isOfSeed)
      turnSeedAngles(std::array{numbers[3], numbers[4], numbers[5]}.data(), &numbers[3]);
    auto root = rootOf(numbers.data(), metresPerUnit);
    if (root.ok()) {
      table.roots.push_back(root.value());
      continue;
    }
    Error error = root.error();
    error.line = table.lines[row];
    return error;
  }
  return Done{};
}

/// What the column of times is called, in whatever case.
std::string timeIn(const JointTable& table) {
  const auto found = std::find_if(table.joints.begin(), table.joints.end(),
                                  [](const std::string& name) { return isKeyword(name, "time"); });
  return found == table.joints.end() ? "time" : *found;
}

/// NAME_dof is NAME.
void renameSeedJoints(JointTable& table) {
  constexpr std::string_view kEnd = "_dof";
  for (std::string& name : table.joints) {
    if (name.size() <= kEnd.size()) continue;
    const std::size_t length = name.size() - kEnd.size();
    if (name.compare(length, kEnd.size(), kEnd) == 0) name.resize(length);
  }
}

Error unknownLayout(const std::string& word) {
  const std::vector<std::string> known = tableLayouts();
  std::string text = "expected the names of a table's columns, or one of the layouts";
  for (std::size_t i = 0; i < known.size(); ++i) text += (i == 0 ? " " : ", ") + known[i];
  return Error::of(ErrorCode::UnknownName,
                   text + ", found " + inQuotes(word) + didYouMean(word, known));
}

}  // namespace

const std::vector<std::string>& rootColumns() {
  static const std::vector<std::string> names{"root_x",  "root_y",  "root_z", "root_qx",
                                              "root_qy", "root_qz", "root_qw"};
  return names;
}

Result<RigidPose> rootOf(const double* numbers, double metresPerUnit) {
  RigidPose root;
  root.translation = Eigen::Vector3d(numbers[0], numbers[1], numbers[2]) * metresPerUnit;
  if (!(root.translation.cwiseAbs().maxCoeff() <= kMaxCoordinate)) {
    return Error::of(ErrorCode::OutOfRange, "expected a root within 1e7 m of the origin");
  }
  const double* q = numbers + 3;
  const auto unit = unitQuaternion(Quaternion(q[3], q[0], q[1], q[2]));
  if (!unit) {
    return Error::of(
        ErrorCode::OutOfRange,
        "expected the root's quaternion to have the norm 1 within 0.001, found " +
            inDigits(std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3])));
  }
  root.rotation = *unit;
  return root;
}

Result<JointTable> parseJointTable(std::string_view csv, const JointTableOptions& options) {
  const TableLayout* const layout = layoutIn(options);
  if (layout == nullptr && options.columns.size() == 1) return unknownLayout(options.columns[0]);
  const auto& columns = layout != nullptr ? layout->columns : options.columns;
  const bool needsTimes = columns.empty() && layout == nullptr && !options.rateHz;
  FORETOUCH_TRY(auto table, parseTable(csv, columns, needsTimes ? "time" : ""));
  const bool isOfSeed = layout != nullptr && layout->isOfSeed;
  setUnits(options, table);
  ColumnsTaken taken(table);
  const auto times = taken.take({timeIn(table)});
  if (isOfSeed) taken.take({"Frame"});
  const auto root = taken.take(isOfSeed ? seedColumns() : rootColumns());
  if (isOfSeed && root.empty()) {
    return Error::of(ErrorCode::Mismatch, "expected the columns root_translateX ... root_rotateZ");
  }
  for (std::size_t row = 0; !times.empty() && row < table.rows.size(); ++row) {
    table.timesS.push_back(table.rows[row][times.front()]);
  }
  FORETOUCH_CHECK(takeRoots(table, root, isOfSeed, table.metresPerUnit));
  taken.leaveTheRest();
  if (isOfSeed) renameSeedJoints(table);
  std::optional<double> rateHz = options.rateHz;
  if (!rateHz && layout != nullptr && times.empty()) rateHz = layout->rateHz;
  FORETOUCH_CHECK(settleTimes(table, rateHz));
  return table;
}

void setUnits(const JointTableOptions& options, JointTable& table) {
  const TableLayout* const layout = layoutIn(options);
  const bool isInDegrees = options.isInDegrees || (layout != nullptr && layout->isInDegrees);
  if (isInDegrees) table.radiansPerUnit = kRadiansPerDegree;
  table.metresPerUnit =
      options.metresPerUnit.value_or(layout != nullptr ? layout->metresPerUnit : 1.0);
}

}  // namespace foretouch::internal
