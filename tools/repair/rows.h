// tools/repair/rows.h: what is demanded, as bounds that are linear around the poses at hand.
#pragma once

#include <vector>

#include "tools/repair/demands.h"
#include "tools/repair/least_change.h"
#include "tools/repair/levers.h"

namespace foretouch::tools {

/// Whose a row is: what cannot be mended is told by those that push against each other.
struct RowOwner {
  FaultKind kind = FaultKind::Scene;
  LinkId link = -1, other = -1;  ///< Of Limit the knob.
  ObjectId object = -1;
  std::int32_t step = 0;
};

struct Rows {
  std::vector<Row> rows;
  std::vector<RowOwner> owners;  ///< One per row.
};

/// Rows of the total changes, around `changes`, which the stage is posed with.
[[nodiscard]] Rows rowsOf(const RepairStage& stage, const Levers& levers, const Demands& demands,
                          const Changes& changes);

}  // namespace foretouch::tools
