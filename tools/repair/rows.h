// tools/repair/rows.h: the demands, as bounds that are linear around the poses at hand.
#pragma once

#include <vector>

#include "tools/repair/demands.h"
#include "tools/repair/least_change.h"
#include "tools/repair/levers.h"

namespace foretouch::tools {

/// The owner of a row: rows that push against each other show what cannot be mended.
struct RowOwner {
  FaultKind kind = FaultKind::Scene;
  LinkId link = -1, other = -1;  ///< For Limit the knob.
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
