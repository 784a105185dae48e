// tools/repair/repair.h: mends a clip: the least smooth change after which nothing touches between
// two poses, feet that rest do not slide, and joints keep their limits; in rounds, each of which
// asks the kernel again. How, and what it does not promise: docs/repair.md.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "articulated/result.h"
#include "tools/repair/faults.h"
#include "tools/repair/measures.h"
#include "tools/repair/reasons.h"
#include "tools/repair/stage.h"

namespace foretouch::tools {

struct Repair {
  Faults before, after;  ///< `after`: those of the text, as it reads back.
  Measures measures;
  std::vector<Unmended> unmended;
  /// Stances that move too far to be a slide: they were left as they are.
  std::vector<BearingStance> meant;
  std::int32_t rounds = 0;
  std::string bytes;  ///< The file.
};

/// Tries of changes that fade faster or more slowly, each of up to kMostRounds.
inline constexpr std::int32_t kMostTries = 3;

/// `progress(rounds so far)` before each round; false stops, and the answer is then of no use. The
/// stage is posed as the file reads back. Errors: those of faultsOf(), and of the file's format.
[[nodiscard]] Result<Repair> repaired(RepairStage& stage,
                                      const std::function<bool(std::int32_t)>& progress);

}  // namespace foretouch::tools
