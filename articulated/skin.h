// articulated/skin.h: a surface whose vertices follow a blend of several links. Metres.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "articulated/skeleton.h"

namespace foretouch {

/// One link's share of a vertex, which is at the sum of weight * (link's pose applied to p_L), the
/// weights summing to one.
struct SkinInfluence {
  LinkId link = 0;
  double weight = 0.0;                            ///< > 0
  Eigen::Vector3d p_L = Eigen::Vector3d::Zero();  ///< The vertex in the link's frame, at bind time.
};
struct Skin {
  std::vector<std::vector<SkinInfluence>> vertices;  ///< Never empty lists; largest weight first.
  std::vector<std::array<std::int32_t, 3>> triangles;
};

}  // namespace foretouch
