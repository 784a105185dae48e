// lss/lss_cover.h: LSS that contain triangles, and how well given ones do. Metres. Not installed.
#pragma once

#include <cstddef>
#include <vector>

#include "lss/lss.h"

namespace foretouch {

/// At most `maxLss` (>= 1, asserted) LSS of which at least one contains each triangle wholly,
/// rounding included (a test owns this). Begins with one LSS and, while that saves at least 15 % of
/// a part's volume, splits the part that saves most, in two across one of its principal axes.
/// Triangles must be finite (asserted); no triangles, no LSS. Same triangles, same LSS. About a
/// second for 37,000 triangles and four LSS.
[[nodiscard]] std::vector<Lss> coverTriangles(const std::vector<Triangle>& triangles, int maxLss);

/// How well LSS contain triangles. Each triangle counts for the LSS that it lies deepest in; the
/// volumes omit LSS without triangles.
struct CoverMeasure {
  std::size_t outside = 0;    ///< Triangles that stick out of every LSS.
  double worstOutside = 0.0;  ///< How far the worst of them does, metres; 0 if none does.
  double lssVolume = 0.0;     ///< Overlaps counted as often as they occur, m^3.
  double hullVolume = 0.0;    ///< Hulls of each LSS's triangles (hull_volume.h: from below), m^3.
};

/// O(triangles * LSS). Computed in doubles: a triangle that touches an LSS from inside may count as
/// outside by a few roundings, unless the LSS was rounded up. Without LSS every triangle is
/// outside, by an infinite distance.
[[nodiscard]] CoverMeasure measureCover(const std::vector<Lss>& lss,
                                        const std::vector<Triangle>& triangles);

}  // namespace foretouch
