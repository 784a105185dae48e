// assets/bvh/bvh_hierarchy.h: the HIERARCHY section of a BVH file, and the two lines after MOTION.
// Internal to the reader and the writer.
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

struct BvhMotionHeader {
  std::size_t declaredFrames = 0;
  double frameTimeS = 0.0;
};

/// The two lines after MOTION, in either order; the first number of the motion is next.
[[nodiscard]] Result<BvhMotionHeader> readBvhMotionHeader(BvhScanner& scanner,
                                                          std::size_t valuesPerFrame);

}  // namespace foretouch::internal
