// bindings/skin_triangles.h: a skin from arrays in which each triangle names its link.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "articulated/avatar.h"
#include "lss/index.h"

namespace foretouch {

struct LinkTriangle {
  std::int64_t link;
  std::array<std::int32_t, 3> vertices;
};

/// Adds the triangles by link, each link's in the order given, says how many each has, and puts the
/// shares of each vertex in order. Returns the place of the first triangle whose link is not one of
/// `ofLink`'s, if there is one: then nothing is added.
inline std::optional<std::size_t> addTriangles(const std::vector<LinkTriangle>& triangles,
                                               std::vector<std::size_t>& ofLink, Skin& skin) {
  std::vector<std::vector<std::array<std::int32_t, 3>>> perLink(ofLink.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const std::int64_t link = triangles[i].link;
    if (link < 0 || static_cast<std::size_t>(link) >= perLink.size()) return i;
    perLink[static_cast<std::size_t>(link)].push_back(triangles[i].vertices);
  }
  for (std::size_t link = 0; link < perLink.size(); ++link) {
    ofLink[link] = perLink[link].size();
    skin.triangles.insert(skin.triangles.end(), perLink[link].begin(), perLink[link].end());
  }
  for (std::vector<SkinInfluence>& vertex : skin.vertices) {
    std::stable_sort(
        vertex.begin(), vertex.end(),
        [](const SkinInfluence& x, const SkinInfluence& y) { return x.weight > y.weight; });
  }
  return std::nullopt;
}

}  // namespace foretouch
