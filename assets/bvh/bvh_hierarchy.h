// assets/bvh/bvh_hierarchy.h: the HIERARCHY section of a BVH file. Internal to the reader.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "articulated/result.h"
#include "articulated/skeleton.h"
#include "assets/bvh/bvh_text.h"

namespace foretouch::internal {

/// One column of the motion rows.
struct BvhChannel {
  bool isRotation = false;
  int axis = 0;  ///< 0 to 2: x, y, z.
};

struct BvhHierarchy {
  RawSkeleton skeleton;                                ///< Names unique; offsets in metres.
  std::vector<std::int64_t> lines;                     ///< Per joint: where it starts.
  std::vector<std::vector<BvhChannel>> channels;       ///< Per joint, in file order.
  std::vector<std::vector<Eigen::Vector3d>> endSites;  ///< Per joint, metres.
  std::size_t numChannels = 0;
};

/// Reads up to and with the word MOTION. `scale` is metres per file unit.
[[nodiscard]] Result<BvhHierarchy> readBvhHierarchy(BvhScanner& scanner, double scale,
                                                    ClipNotes& notes);

}  // namespace foretouch::internal
