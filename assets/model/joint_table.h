// assets/model/joint_table.h: numbers over time, from CSV text: a robot's joint positions, or
// whatever else has columns of its own. Internal to the readers of clips.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "articulated/result.h"

namespace foretouch::internal {

struct JointTable {
  std::vector<std::string> joints;        ///< Names of the columns after `time`, all different.
  std::vector<std::vector<double>> rows;  ///< Finite; one value per joint.
  std::vector<double> timesS;             ///< Per row: the column `time`.
  std::vector<std::int64_t> lines;        ///< Per row, its line in the text.
  double frameTimeS = 0.0;                ///< The mean spacing of rows, if they have one.
};

/// Limit on rows x columns.
inline constexpr std::size_t kMaxTableValues = std::size_t{1} << 24;

/// Lines of cells between commas: `time` (or another `first`) and names, then numbers. Accepts
/// blanks around cells, double quotes around whole cells, CR LF, a byte order mark, blank lines and
/// lines that begin with #. Times are as they stand, in any order. Errors name the line.
[[nodiscard]] Result<JointTable> parseTimedTable(std::string_view csv, const char* first = "time");

/// The same with at least two rows, spaced equally to within a hundredth.
[[nodiscard]] Result<JointTable> parseJointTable(std::string_view csv);

}  // namespace foretouch::internal
