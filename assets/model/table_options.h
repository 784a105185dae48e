// assets/model/table_options.h: how to read a table of a robot's joint positions where it does not
// say so itself.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace foretouch {

/// In which order four numbers are a quaternion.
enum class QuaternionOrder : std::uint8_t { Xyzw, Wxyz };

struct JointTableOptions {
  /// For a table without a header: its columns' names, in order; or only the name of a layout that
  /// is known (tableLayouts()), which says units, rate and order as well. Empty: as the header
  /// says.
  std::vector<std::string> columns;
  std::optional<double> rateHz;               ///< Rows per second, of a table without times.
  std::optional<QuaternionOrder> quaternion;  ///< In arrays, whose names need not say it.
  bool isInDegrees = false;                   ///< Or as the layout has it.
  std::optional<double> metresPerUnit;        ///< Empty: metres, or as the layout has it.
};

/// The layouts of public sets of motions that are known by name: "lafan1-g1", "bones-seed-g1".
[[nodiscard]] std::vector<std::string> tableLayouts();

namespace internal {

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

}  // namespace internal
}  // namespace foretouch
