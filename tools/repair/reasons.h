// tools/repair/reasons.h: what could not be mended, and why.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tools/repair/faults.h"
#include "tools/repair/rows.h"

namespace foretouch::tools {

/// Intervals one after the other that stay at fault in the same way.
struct Unmended {
  FaultKind kind = FaultKind::Scene;
  LinkId link = -1, other = -1;
  ObjectId object = -1;
  std::int32_t first = 0, last = 0;  ///< Poses between which they lie.
  double by = 0.0;                   ///< As in StepFault::by, the greatest.
  std::string reason;
};

/// Rounds of asking and changing.
inline constexpr std::int32_t kMostRounds = 20;

/// `rows`: those that pushed while everything was still asked for.
[[nodiscard]] std::vector<Unmended> unmendedOf(const RepairStage& stage, const Faults& after,
                                               const Demands& demands, const Rows& rows);

/// "LeftHand touches table", "LeftFoot slides".
[[nodiscard]] std::string faultText(const RepairStage& stage, FaultKind kind, LinkId link,
                                    LinkId other, ObjectId object);

}  // namespace foretouch::tools
