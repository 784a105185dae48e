#include "tools/inputs/apart_meshes.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "middleware/query/query.h"
#include "tools/inputs/played_clip.h"

namespace foretouch::tools {
namespace {

/// Pairs that are left out because their LSS touch, not because one moves the other.
std::vector<LinkPair> leftOutByLss(const QueryOptions& query) {
  std::vector<LinkPair> pairs;
  const auto hasMesh = [&](LinkId link) { return !query.surface->triangles(link).empty(); };
  for (const LeftOutPair& pair : query.self->leftOut()) {
    const bool isByLss =
        pair.reason == PairReason::RestOverlap || pair.reason == PairReason::Always;
    if (isByLss && hasMesh(pair.a) && hasMesh(pair.b)) pairs.push_back({pair.a, pair.b});
  }
  return pairs;
}

/// Takes away those whose meshes touch at this pose.
void dropTouching(const Query& query, const Pose& pose, std::vector<LinkPair>& pairs) {
  Scratch scratch;
  const ChainMotion still(query.avatar().skeleton(), pose, pose);
  for (const PairContact& met : query.answer(still, scratch).pairs) {
    const auto same = [&](const LinkPair& pair) {
      return std::minmax(pair.a, pair.b) == std::minmax(met.link, met.other);
    };
    pairs.erase(std::remove_if(pairs.begin(), pairs.end(), same), pairs.end());
  }
}

}  // namespace

std::optional<std::string> remarkOnApartMeshes(const Avatar& avatar, const Scene& scene,
                                               const QueryOptions& query,
                                               const std::vector<Pose>& poses) {
  if (query.fidelity != Fidelity::Exact || !query.surface || !query.self) return std::nullopt;
  std::vector<LinkPair> pairs = leftOutByLss(query);
  auto asking = PairRules::asking(avatar, pairs);  // an error if there are none
  if (!asking.ok()) return std::nullopt;
  QueryOptions options;
  options.fidelity = Fidelity::Exact;
  options.surface = query.surface;
  options.self = std::move(asking).value();
  const auto asked = Query::build(avatar, scene, options);
  if (!asked.ok()) return std::nullopt;
  for (const Pose& pose : poses) dropTouching(asked.value(), pose, pairs);
  if (pairs.empty() || poses.empty()) return std::nullopt;
  std::vector<std::string> names;
  for (const LinkPair& pair : pairs) {
    names.push_back(avatar.skeleton().name(pair.a) + ":" + avatar.skeleton().name(pair.b));
  }
  return fmt::format(
      "--self: {} left out because their LSS touch, though their meshes are apart at each of {} "
      "poses: {}; to ask about them, take them out of the rules that foretouch avatar pairs writes "
      "(-o), and give these as --pairs",
      pairs.size() == 1 ? "1 pair of own links is"
                        : fmt::format("{} pairs of own links are", pairs.size()),
      poses.size(), firstOf(names));
}

}  // namespace foretouch::tools
