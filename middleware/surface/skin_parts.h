// middleware/surface/skin_parts.h: the contents of a SkinnedSurface. Not installed.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "articulated/avatar.h"
#include "lss/index.h"
#include "middleware/lanes/blend_lanes.h"

namespace foretouch::internal {

class BlendTable;

struct SkinParts {
  Skin skin;
  std::vector<std::int32_t> firstOfLink;  // one more than links: link l has [l, l+1)
  // The vertices in the form for lanes: vertex v has the shares [firstShare[v], firstShare[v+1]).
  std::vector<LaneShare> shares;
  std::vector<std::int32_t> firstShare;
  std::size_t mostShares = 0;                // that any vertex has
  std::uint64_t avatarIdentity = 0;          // that of the avatar that it was built for
  std::shared_ptr<const BlendTable> blends;  // that avatar's

  [[nodiscard]] std::int32_t numTriangles(LinkId link) const {
    const auto l = slotOf(link);
    return firstOfLink[l + 1] - firstOfLink[l];
  }
  [[nodiscard]] const std::array<std::int32_t, 3>& triangle(LinkId link, std::int32_t index) const {
    const std::int32_t first = firstOfLink[slotOf(link)];
    return skin.triangles[slotOf(first + index)];
  }
  [[nodiscard]] LaneBlend blend(std::int32_t vertex) const {
    const std::int32_t first = firstShare[slotOf(vertex)];
    return {shares.data() + first, firstShare[slotOf(vertex) + 1] - first};
  }
};

}  // namespace foretouch::internal
