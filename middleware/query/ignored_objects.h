// middleware/query/ignored_objects.h: the objects that a query ignores, link by link. Not
// installed.
#pragma once

#include <algorithm>
#include <vector>

#include "middleware/query_options.h"

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
  [[nodiscard]] bool empty() const { return objects_.empty(); }
  [[nodiscard]] bool has(ObjectId object) const {
    return std::binary_search(objects_.begin(), objects_.end(), object);
  }

 private:
  std::vector<ObjectId> objects_;  // ascending
};

}  // namespace foretouch::internal
