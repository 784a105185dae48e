// tools/glb/appearances.h: nodes that are there for a while only. glTF cannot hide a node over time
// but by its scale, which is 0 while it is away (keys of STEP).
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

/// Animates the nodes' scales, which are set to what they are at 0 s. One that is there until
/// `endS` or longer stays.
void addAppearances(const std::vector<Appearance>& appearances, double endS, GlbContent& content,
                    GlbAnimation& animation);

}  // namespace foretouch::tools
