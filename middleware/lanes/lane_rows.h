// middleware/lanes/lane_rows.h: rows of pairs, and the bounds on rounding that the kernels of pairs
// share. Constants and plain arrays only, for the reason that lss_pairs-inl.h gives. Not installed.
#pragma once

#include <cstddef>
#include <cstdint>

#include "lss/rounding.h"

namespace foretouch::internal {

/// Floats in the widest vector used.
inline constexpr std::size_t kMaxLanes = 16;

/// Where the rows of pairs begin.
struct LaneRows {
  float* coordinates[9];
  float* reach;
  float* time;
  std::int32_t* key;
};
/// Where handed-over pairs go.
struct HandedRows {
  std::int32_t* key;
  float* time;
  float* gap;
};

/// Row m: the places of the bits that are set in m, ascending, then zeros.
struct LanesOfBits {
  std::uint8_t rows[256][8];
};
constexpr LanesOfBits lanesOfBits() {
  LanesOfBits table{};
  for (unsigned bits = 0; bits < 256; ++bits) {
    unsigned count = 0;
    for (unsigned lane = 0; lane < 8; ++lane) {
      if ((bits >> lane & 1U) != 0) table.rows[bits][count++] = static_cast<std::uint8_t>(lane);
    }
  }
  return table;
}
inline constexpr LanesOfBits kLanesOfBitsTable = lanesOfBits();
inline constexpr auto& kLanesOfBits = kLanesOfBitsTable.rows;

/// Roundings of a plane's arithmetic per metre of extent, and of the vertices' own subtraction
/// (lss_pairs.md 2).
inline constexpr double kAxisPlaneRounding = 12.0 * kUnitRoundoffOfFloat;
/// The same per metre of the largest coordinate: a point's norm is at most the root of 3 of it.
inline constexpr float kRoundingOfCoordinate = static_cast<float>(1.7321 * kAxisPlaneRounding);
/// A sphere's radius has a part in the rounding of the last subtraction.
inline constexpr float kSphereInflation = 1.0F + 0x1p-20F;
/// Past the rounding of a sum of three such terms.
inline constexpr float kSumInflation = 1.0F + 0x1p-21F;

}  // namespace foretouch::internal
