// middleware/surface/skin_parts.h: the contents of a SkinnedSurface. Not installed.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "articulated/skin.h"
#include "lss/index.h"

namespace foretouch::internal {

struct SkinParts {
  Skin skin;
  std::vector<std::int32_t> firstOfLink;  // one more than links: link l has [l, l+1)

  [[nodiscard]] std::int32_t numTriangles(LinkId link) const {
    const auto l = slotOf(link);
    return firstOfLink[l + 1] - firstOfLink[l];
  }
  [[nodiscard]] const std::array<std::int32_t, 3>& triangle(LinkId link, std::int32_t index) const {
    const std::int32_t first = firstOfLink[slotOf(link)];
    return skin.triangles[slotOf(first + index)];
  }
};

}  // namespace foretouch::internal
