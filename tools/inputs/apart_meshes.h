// tools/inputs/apart_meshes.h: own links whose LSS always touch, though their meshes do not: those
// that are not asked about because of it, and those that flood an answer.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/pair_rules.h"
#include "articulated/skeleton.h"
#include "middleware/query_options.h"
#include "middleware/scene/scene.h"

namespace foretouch::tools {

/// For a query at exact fidelity with derived pair rules: which pairs these are, by `poses` of the
/// avatar, and how to ask about them. Nothing if there are none, or if it is not such a query.
[[nodiscard]] std::optional<std::string> remarkOnApartMeshes(const Avatar& avatar,
                                                             const Scene& scene,
                                                             const QueryOptions& query,
                                                             const std::vector<Pose>& poses);

/// Two own links that start in contact in so many steps.
struct StartingPair {
  LinkPair pair;
  std::int64_t starts = 0;
};

/// For an answer at link fidelity: which of these pairs, that start in contact in nearly all of
/// `steps`, have meshes that are apart at each of `poses`. `meshes`: per link; empty if it has
/// none. `rules`: the command that writes pair rules for it, without what they leave out.
[[nodiscard]] std::optional<std::string> hintOnThickPairs(const Avatar& avatar, const Scene& scene,
                                                          std::vector<std::vector<Triangle>> meshes,
                                                          const std::vector<StartingPair>& pairs,
                                                          std::int64_t steps,
                                                          const std::vector<Pose>& poses,
                                                          const std::string& rules);

}  // namespace foretouch::tools
