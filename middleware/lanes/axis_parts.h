// middleware/lanes/axis_parts.h: the axis of an LSS against sixteen parts of a mesh, all at rest in
// one frame: a lower bound on each distance. Proof: middleware/lanes/triangle_pairs.md 6. Not
// installed.
#pragma once

#include <cstddef>
#include <cstdint>

#include "middleware/lanes/triangle_pairs.h"

namespace foretouch::internal {

/// An LSS at one instant, seen from a link with a mesh (m).
struct StillAxis {
  float point[2][3];
  float radius;  ///< Rounded up.
  /// What places of the axis, and of a point of the mesh at distance rho from its link's origin,
  /// are off by: at most pad + padPerRho * rho. Rounded up.
  float pad, padPerRho;
};

/// Parts of one link as lanes read them, side by side; of each: LanePart (frame_lanes.h). Slots
/// beyond `count` are zero.
struct PartRows {
  alignas(64) PairFloats point[3][3] = {};  ///< [point][axis]
  alignas(64) PairFloats rho = {}, radius = {};
  std::int32_t count = 0;
  bool areAxes = true;  ///< No part is a triangle: the third point repeats the second.
};

/// `lower` (m): the LSS and each part, both with their radii, are at least so far apart; minus the
/// radii where nothing is proven. Writes a whole vector.
void boundGaps(const StillAxis& axis, const PartRows& parts, PairFloats& lower);

}  // namespace foretouch::internal
