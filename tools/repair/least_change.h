// tools/repair/least_change.h: the least smooth change of a whole clip that keeps rows of linear
// bounds: min sum over poses of |change|^2 + 3 reach^2 |first difference|^2 + 3 reach^4 |second|^2
// + reach^6 |third|^2, with |x|^2 = x.metric x over the knobs, subject to lower <= row * change <=
// upper. Why these: docs/repair.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "tools/repair/knobs.h"

namespace foretouch::tools {

/// A coefficient of a row.
struct RowTerm {
  std::int32_t pose = 0, knob = 0;
  double by = 0.0;
};

/// What the row asks of the changes, in metres or, for a limit, in the knob's unit.
struct Row {
  std::vector<RowTerm> terms;
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  /// A wish: it pulls as a spring does, and gives way to what other rows ask.
  bool isWish = false;
  /// Its push at the answer, in units of the cost per unit of the row: above 0 towards larger
  /// values. Filled in by leastChange().
  double push = 0.0;
};

struct LeastChangeOptions {
  /// Poses over which a change fades: to a half in about two of these.
  double reach = 6.0;
  /// Poses before the first row and after the last one of a run of rows that may change.
  std::int32_t margin = 60;
  /// The change goes on beyond the first pose, or the last one, unseen; else it is 0 there.
  bool isFreeBefore = true, isFreeAfter = true;
};

struct LeastChange {
  Changes changes;
  double worst = 0.0;  ///< By how much the worst row is missed.
  bool isSolved = false;
};

/// `metric`: the knobs', symmetric and positive. Rows that contradict each other are met in the
/// least squares, as nearly as can be. Only poses within the margin of a row change, and only knobs
/// that a row names. O(poses * knobs^3).
[[nodiscard]] LeastChange leastChange(const Eigen::MatrixXd& metric, std::int32_t poses,
                                      std::vector<Row>& rows, const LeastChangeOptions& options);

}  // namespace foretouch::tools
