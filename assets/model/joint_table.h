// assets/model/joint_table.h: joint positions over time, from CSV text. Internal to model_clip.
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
  std::vector<std::int64_t> lines;        ///< Per row, its line in the text.
  double frameTimeS = 0.0;                ///< The mean spacing of rows.
};

/// Limit on rows x columns.
inline constexpr std::size_t kMaxTableValues = std::size_t{1} << 24;

/// Lines of cells between commas: `time` and names, then numbers. Accepts blanks around cells,
/// double quotes around whole cells, CR LF, a byte order mark, blank lines and lines that begin
/// with #. At least two rows, spaced equally to within a hundredth. Errors name the line.
[[nodiscard]] Result<JointTable> parseJointTable(std::string_view csv);

}  // namespace foretouch::internal
