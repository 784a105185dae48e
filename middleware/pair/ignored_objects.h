// middleware/pair/ignored_objects.h: the objects that a query ignores, link by link. Not
// installed.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "middleware/query_options.h"
#include "middleware/scene/flat_bvh_lanes.h"
#include "middleware/scene/scene.h"

namespace foretouch::internal {

/// The objects whose contacts with the current link the query ignores.
class IgnoredObjects {
 public:
  /// True if the link is ignored altogether.
  bool collect(const std::vector<IgnoredPair>& ignored, LinkId link) {
    objects_.clear();
    for (const IgnoredPair& pair : ignored) {
      if (pair.link != link) continue;
      if (pair.object == IgnoredPair::kEveryObject) return true;
      objects_.push_back(pair.object);
    }
    std::sort(objects_.begin(), objects_.end());
    return false;
  }
  /// Adds one more of the current link.
  void add(ObjectId object) {
    objects_.insert(std::lower_bound(objects_.begin(), objects_.end(), object), object);
  }
  [[nodiscard]] bool empty() const { return objects_.empty(); }
  [[nodiscard]] bool has(ObjectId object) const {
    return std::binary_search(objects_.begin(), objects_.end(), object);
  }
  /// Reads the triangle's object only if there is something to ignore.
  [[nodiscard]] bool has(const Scene& scene, TriangleId triangle) const {
    return !empty() && has(scene.object(triangle));
  }

 private:
  std::vector<ObjectId> objects_;  // ascending
};

/// Those of a leaf's triangles, each a bit, that are not passed over.
[[nodiscard]] inline std::uint8_t withoutIgnored(std::uint8_t triangles, const BvhLeaf& leaf,
                                                 const Scene& scene,
                                                 const IgnoredObjects& ignored) {
  if (ignored.empty()) return triangles;
  unsigned asked = triangles;
  for (unsigned slot = 0; slot < kBvhWidth; ++slot) {
    if ((asked >> slot & 1U) != 0 && ignored.has(scene, leaf.id[slot])) {
      asked &= ~(1U << slot);
    }
  }
  return static_cast<std::uint8_t>(asked);
}

}  // namespace foretouch::internal
