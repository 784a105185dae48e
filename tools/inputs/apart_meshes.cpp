#include "tools/inputs/apart_meshes.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "lss/index.h"
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

/// Takes away the pairs whose meshes touch at this pose.
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

/// The pairs whose meshes are apart at every pose; none if they cannot be asked.
std::vector<LinkPair> apartAt(const std::vector<Pose>& poses, const Avatar& avatar,
                              const Scene& scene, const AvatarSurface& surface,
                              std::vector<LinkPair> pairs) {
  auto asking = PairRules::asking(avatar, pairs);  // an error if there are none
  if (!asking.ok() || poses.empty()) return {};
  QueryOptions options;
  options.fidelity = Fidelity::Exact;
  options.surface = surface;
  options.self = std::move(asking).value();
  const auto asked = Query::build(avatar, scene, options);
  if (!asked.ok()) return {};
  for (const Pose& pose : poses) dropTouching(asked.value(), pose, pairs);
  return pairs;
}

std::string pairName(const LinkPair& pair, const Avatar& avatar) {
  return avatar.skeleton().name(pair.a) + ":" + avatar.skeleton().name(pair.b);
}

std::string counted(std::size_t pairs, const char* one, const char* several) {
  return pairs == 1 ? one : fmt::format("{} {}", pairs, several);
}

}  // namespace

std::optional<std::string> remarkOnApartMeshes(const Avatar& avatar, const Scene& scene,
                                               const QueryOptions& query,
                                               const std::vector<Pose>& poses) {
  if (query.fidelity != Fidelity::Exact || !query.surface || !query.self) return std::nullopt;
  const auto pairs = apartAt(poses, avatar, scene, *query.surface, leftOutByLss(query));
  if (pairs.empty()) return std::nullopt;
  std::vector<std::string> names;
  for (const LinkPair& pair : pairs) names.push_back(pairName(pair, avatar));
  return fmt::format(
      "--self: {} left out because their LSS touch, though their meshes are apart at each of {} "
      "poses: {}; to ask about them, take them out of the rules that foretouch avatar pairs writes "
      "(-o), and give these as --pairs",
      counted(pairs.size(), "1 pair of own links is", "pairs of own links are"), poses.size(),
      firstOf(names));
}

std::optional<std::string> hintOnThickPairs(const Avatar& avatar, const Scene& scene,
                                            std::vector<std::vector<Triangle>> meshes,
                                            const std::vector<StartingPair>& pairs,
                                            std::int64_t steps, const std::vector<Pose>& poses,
                                            const std::string& rules) {
  std::vector<LinkPair> thick;
  for (const StartingPair& one : pairs) {
    const bool haveMeshes =
        !meshes[slotOf(one.pair.a)].empty() && !meshes[slotOf(one.pair.b)].empty();
    if (haveMeshes) thick.push_back(one.pair);
  }
  const auto surface = AvatarSurface::build(avatar, std::move(meshes));
  if (!surface.ok()) return std::nullopt;  // exact fidelity says why
  thick = apartAt(poses, avatar, scene, surface.value(), std::move(thick));
  if (thick.empty()) return std::nullopt;
  std::string leftOut;
  std::int64_t starts = 0;
  for (const LinkPair& pair : thick) {
    leftOut += (leftOut.empty() ? "" : ",") + pairName(pair, avatar);
    for (const StartingPair& one : pairs) {
      if (one.pair.a == pair.a && one.pair.b == pair.b) starts = std::max(starts, one.starts);
    }
  }
  return fmt::format(
      "--self: {} by LSS in up to {} of {} steps, though their meshes are apart at each of {} "
      "poses; leave them out: {} --leave-out '{}' -o own.pairs.json, then --pairs own.pairs.json; "
      "or "
      "ask the meshes: --fidelity exact",
      counted(thick.size(), "1 pair of own links starts in contact",
              "pairs of own links start in contact"),
      starts, steps, poses.size(), rules, leftOut);
}

}  // namespace foretouch::tools
