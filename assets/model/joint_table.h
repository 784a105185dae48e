// assets/model/joint_table.h: numbers over time, from CSV text: a robot's joint positions, or
// whatever else has columns of its own. Internal to the readers of clips.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "articulated/result.h"
#include "articulated/skeleton.h"
#include "assets/model/model.h"

namespace foretouch::internal {

struct JointTable {
  std::vector<std::string> joints;        ///< Names of the columns after `time`, all different.
  std::vector<std::vector<double>> rows;  ///< Finite; one value per joint.
  std::vector<double> timesS;             ///< Per row: the column `time`.
  std::vector<std::int64_t> lines;        ///< Per row, its line in the text.
  double frameTimeS = 0.0;                ///< The mean spacing of rows, if they have one.
  std::vector<RigidPose> roots;  ///< Per row; empty: the root stays where the robot has it.
  double radiansPerUnit = 1.0;   ///< For the angles in rows.
  double metresPerUnit = 1.0;    ///< For the lengths in rows.
};

/// Limit on rows x columns.
inline constexpr std::size_t kMaxTableValues = std::size_t{1} << 24;

/// Lines of cells between commas, all of them in rows, without times. `columns`: their names;
/// empty: a header has them, which begins with `first` if that is not empty. Else as
/// parseTimedTable().
[[nodiscard]] Result<JointTable> parseTable(std::string_view csv,
                                            const std::vector<std::string>& columns,
                                            const std::string& first);

/// Lines of cells between commas: `time` (or another `first`) and names, then numbers. Accepts
/// blanks around cells, double quotes around whole cells, CR LF, a byte order mark, blank lines and
/// lines that begin with #. Times are as they stand, in any order. Errors name the line.
[[nodiscard]] Result<JointTable> parseTimedTable(std::string_view csv, const char* first = "time");

/// Joint positions: at least two rows, spaced equally to within a hundredth; and where the root is,
/// if all columns of rootColumns() are there.
[[nodiscard]] Result<JointTable> parseJointTable(std::string_view csv,
                                                 const JointTableOptions& options = {});

/// root_x, root_y, root_z, root_qx, root_qy, root_qz, root_qw.
[[nodiscard]] const std::vector<std::string>& rootColumns();

/// The pose that the numbers of rootColumns() say, the place in units of so many metres. Errors: a
/// place beyond kMaxCoordinate, a quaternion that is not unit to within 0.001.
[[nodiscard]] Result<RigidPose> rootOf(const double* numbers, double metresPerUnit);

/// The units that the options say, or the layout that they name.
void setUnits(const JointTableOptions& options, JointTable& table);

/// Fills in the mean spacing of timesS, or the times of a table that has none, by the rate.
[[nodiscard]] Result<Done> settleTimes(JointTable& table, std::optional<double> rateHz);

/// How a public set lays its tables out.
struct TableLayout {
  const char* name;
  std::vector<std::string> columns;  ///< Empty: there is a header.
  double rateHz;
  bool isInDegrees;
  double metresPerUnit;
  /// The root's rotation is three angles about fixed axes, x first, in `root_rotateX` and so on;
  /// the place is `root_translateX` ..., joints are called NAME_dof, and `Frame` counts.
  bool isOfSeed;
};

/// Nothing: no layout has this name.
[[nodiscard]] const TableLayout* tableLayout(const std::string& name);
/// The layout that the options name, if they name one.
[[nodiscard]] const TableLayout* layoutIn(const JointTableOptions& options);

}  // namespace foretouch::internal
