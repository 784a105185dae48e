// lss/lss_cover.h: LSS that contain triangles, and how well some do. Metres.
#pragma once

#include <cstddef>
#include <vector>

#include "lss/lss.h"
#include "lss/triangle.h"

namespace foretouch {

/// At most `maxLss` (>= 1, asserted) LSS of which at least one contains each triangle wholly,
/// rounding included (a test owns this). One LSS to begin with; the part whose split saves most
/// volume is split in two across one of its principal axes, while that saves at least 15 % of the
/// part's. Triangles must be finite (asserted); no triangles, no LSS. Same triangles, same LSS.
/// About a second for 37,000 triangles and four LSS.
[[nodiscard]] std::vector<Lss> coverTriangles(const std::vector<Triangle>& triangles, int maxLss);

/// How LSS contain triangles. Each triangle counts for the LSS that it lies deepest in; LSS that no
/// triangle counts for are left out of the volumes.
struct CoverMeasure {
  std::size_t outside = 0;    ///< Triangles that stick out of every LSS.
  double worstOutside = 0.0;  ///< How far the worst of them does, metres; 0 where none does.
  double lssVolume = 0.0;     ///< Overlaps counted as often as they occur, m^3.
  double hullVolume = 0.0;    ///< Of each LSS's triangles (lss/hull_volume.h: from below), m^3.
};

/// O(triangles * LSS). Computed in doubles: a triangle that touches an LSS from inside may be
/// counted as outside by a few roundings if its maker did not round up. Without LSS every triangle
/// is outside, by an infinite distance.
[[nodiscard]] CoverMeasure measureCover(const std::vector<Lss>& lss,
                                        const std::vector<Triangle>& triangles);

}  // namespace foretouch
