// tools/glb/appearances.h: nodes that are visible only for a while. glTF can hide a node over time
// only by its scale, which is 0 while it is hidden (keys of STEP).
#pragma once

#include <cstddef>
#include <vector>

#include "tools/glb/avatar_animation.h"
#include "tools/glb/glb_content.h"

namespace foretouch::tools {

struct Appearance {
  std::size_t node = 0;
  double fromS = 0.0, untilS = 0.0;
};

/// Animates the nodes' scales, and sets them to their value at 0 s. A node visible until `endS` or
/// longer stays.
void addAppearances(const std::vector<Appearance>& appearances, double endS, GlbContent& content,
                    GlbAnimation& animation);

}  // namespace foretouch::tools
