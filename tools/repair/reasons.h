// tools/repair/reasons.h: what could not be mended, and why.
#pragma once

#include <vector>

#include "tools/repair/repair.h"
#include "tools/repair/rows.h"

namespace foretouch::tools {

/// `rows`: those that pushed while all was still asked for.
[[nodiscard]] std::vector<Unmended> unmendedOf(const Stage& stage, const Faults& after,
                                               const Demands& demands, const Rows& rows);

/// "LeftHand touches table", "LeftFoot slides".
[[nodiscard]] std::string faultText(const Stage& stage, FaultKind kind, LinkId link, LinkId other,
                                    ObjectId object);

}  // namespace foretouch::tools
