// assets/model/joint_table.h: joint positions over time, as CSV text tells them. Internal to
// model_clip.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "articulated/result.h"

namespace foretouch::internal {

struct JointTable {
  std::vector<std::string> joints;        ///< Names of the columns after `time`, all different.
  std::vector<std::vector<double>> rows;  ///< Finite; a value a joint.
  std::vector<std::int64_t> lines;        ///< Per row, its line in the text.
  double frameTimeS = 0.0;                ///< The mean spacing of rows.
};

/// Rows x columns above this are refused.
inline constexpr std::size_t kMaxTableValues = std::size_t{1} << 24;

/// Lines of cells between commas: `time` and names, then numbers. Blanks around cells, double
/// quotes around whole cells, CR LF, a byte order mark, blank lines and lines that begin with # are
/// borne. At least two rows, spaced equally to within a hundredth. Errors name the line.
[[nodiscard]] Result<JointTable> parseJointTable(std::string_view csv);

}  // namespace foretouch::internal
