// tessellation/sheet_bound.h: how far the hull of an axis at two instants leaves the sheet that the
// axis covers between them. Lengths in one unit. Proof: tessellation/swept_surface.md 4. Not
// installed.
#pragma once

#include "tessellation/swept_lss.h"

namespace foretouch {

/// An upper bound, rounded up, on the distance of any point of conv{begin.a, begin.b, end.a, end.b}
/// from the bilinear patch with these corners. Second order in the span if both ends move to the
/// same side of the axis. If the axis turns about one of its points, the hull of the bow tie is
/// wider by an amount of first order, and so is the bound.
[[nodiscard]] double hullLeavesSheetBy(const AxisEnds& begin, const AxisEnds& end);

}  // namespace foretouch
