// middleware/lanes/axis_parts.h: the axis of an LSS against sixteen parts of a mesh, all at rest in
// one frame: bounds on each distance. Proof: middleware/lanes/triangle_pairs.md 6. Not
// installed.
#pragma once

#include <cstddef>
#include <cstdint>

#include "middleware/lanes/pair_floats.h"

namespace foretouch::internal {

/// An LSS at one instant, seen from a link with a mesh (m).
struct StillAxis {
  float point[2][3];
  float radius;  ///< Rounded up.
  /// What places of the axis, and of a point of the mesh at distance rho from its link's origin,
  /// are off by: at most pad + padPerRho * rho. Rounded up.
  float pad, padPerRho;
};

/// Parts of one link as lanes read them, side by side; for each: LanePart (frame_lanes.h). Slots
/// beyond `count` are zero.
struct PartRows {
  alignas(64) PairFloats point[3][3] = {};  ///< [point][axis]
  alignas(64) PairFloats rho = {}, radius = {};
  std::int32_t count = 0;
  bool areAxes = true;  ///< No part is a triangle: the third point repeats the second.
};

/// How far the LSS and each part are apart, both with their radii (m).
struct GapBounds {
  alignas(64) PairFloats lower;  ///< At least; minus the radii where nothing is proven.
  alignas(64) PairFloats upper;  ///< At most: two points of them are.
};
/// Writes whole vectors.
void boundGaps(const StillAxis& axis, const PartRows& parts, GapBounds& gaps);

}  // namespace foretouch::internal
