// tests/reference/leaf.h: the answer of the exact leaf tests. Time t is normalised, [0,1].
#pragma once

#include <cstdint>

#include "middleware/exact/feature.h"

namespace foretouch {

/// The arithmetic that decided: each stage answers or passes on to the next.
enum class LeafStage : std::uint8_t {
  Filter,  ///< Doubles with a proved rounding bound.
  Exact,   ///< Integers.
};
[[nodiscard]] const char* toString(LeafStage stage);

/// The answer of one query. Sound: if `hits`, the first contact lies in [toiLow, toiHigh]; if not,
/// there is none on [0,1].
struct LeafAnswer {
  bool hits = false;
  double toiLow = 1.0;   ///< Proved free on [0, toiLow).
  double toiHigh = 1.0;  ///< Proved in contact at some instant of [toiLow, toiHigh]; at most
                         ///< kLeafTimeAccuracy above toiLow.
  LeafStage stage = LeafStage::Filter;
};
inline constexpr double kLeafTimeAccuracy = 0x1p-30;

/// The feature of a triangle that touches. 0..2; for an edge, from vertex i to vertex (i+1)%3.
struct Feature {
  FeatureKind kind = FeatureKind::Face;
  std::uint8_t index = 0;  ///< 0 for a face.
};

}  // namespace foretouch
