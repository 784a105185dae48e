// tools/glb/world_glb.h: a replayed world as one animated GLB: the scene, all bodies in their
// in-between motion, and where touches begin (docs/formats.md, "A world as GLB").
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "articulated/result.h"
#include "tools/glb/avatar_animation.h"
#include "tools/glb/glb_content.h"
#include "tools/glb/replay_glb.h"
#include "tools/world/world_touches.h"

namespace foretouch::tools {

/// Collects the contacts that begin touches, in bounded memory.
class WorldGlb {
 public:
  /// `world` outlives it.
  WorldGlb(const LoadedWorld& world, GlbRequest request)
      : world_(world), request_(std::move(request)) {}

  /// Windows in order; `begun`: places of the contacts that begin touches in it.
  void add(const WorldStep& step, const std::vector<std::size_t>& begun);

  /// `touches`: after finish(). `header`: the results' first line. Writes the file; returns what it
  /// leaves out, one sentence each. Errors: an unwritable file, times that floats do not tell
  /// apart, more than a GLB can hold.
  [[nodiscard]] Result<std::vector<std::string>> write(const WorldTouches& touches,
                                                       const std::string& header) const;

 private:
  struct Begin {
    WorldContact contact;
    std::int64_t window = 0;
  };
  void addMarkers(const WorldTouches& touches, const Eigen::Vector3d& origin, std::size_t parent,
                  GlbContent& content, GlbAnimation& animation) const;

  const LoadedWorld& world_;
  GlbRequest request_;
  std::vector<Begin> begun_;
  std::int64_t notShown_ = 0;
};

}  // namespace foretouch::tools
