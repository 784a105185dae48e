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

/// Poses that are looked at, evenly spread: each costs the meshes of the pairs in question.
constexpr std::int64_t kLooks = 24;

/// Pairs that are left out because their LSS touch, not because one moves the other.
std::vector<LinkPair> leftOutByLss(const ReplayInputs& inputs) {
  std::vector<LinkPair> pairs;
  const auto hasMesh = [&](LinkId link) { return !inputs.query.surface->triangles(link).empty(); };
  for (const LeftOutPair& pair : inputs.query.self->leftOut()) {
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

std::optional<std::string> remarkOnApartMeshes(const ReplayInputs& inputs) {
  const bool asksMeshes = inputs.query.fidelity == Fidelity::Exact && inputs.query.surface &&
                          inputs.query.self && inputs.request.pairsPath.empty();
  if (!asksMeshes) return std::nullopt;
  std::vector<LinkPair> pairs = leftOutByLss(inputs);
  if (pairs.empty()) return std::nullopt;
  QueryOptions options;
  options.fidelity = Fidelity::Exact;
  options.surface = inputs.query.surface;
  auto asking = PairRules::asking(inputs.avatar, pairs);
  if (!asking.ok()) return std::nullopt;
  options.self = std::move(asking).value();
  const auto query = Query::build(inputs.avatar, inputs.scene, options);
  if (!query.ok()) return std::nullopt;
  const std::int64_t looks = std::min(kLooks, inputs.steps.count + 1);
  for (std::int64_t i = 0; i < looks && !pairs.empty(); ++i) {
    const std::int64_t step = inputs.steps.count * i / std::max<std::int64_t>(1, looks - 1);
    const auto pose = poseAtFrame(inputs, inputs.steps.frameOf(step));
    if (!pose.ok()) return std::nullopt;  // the replay itself will say why
    dropTouching(query.value(), pose.value(), pairs);
  }
  if (pairs.empty()) return std::nullopt;
  std::vector<std::string> names;
  for (const LinkPair& pair : pairs) {
    names.push_back(inputs.avatar.skeleton().name(pair.a) + ":" +
                    inputs.avatar.skeleton().name(pair.b));
  }
  return fmt::format(
      "--self: {} left out because their LSS touch, though their meshes are apart at each of {} "
      "poses: {}; to ask about them, take them out of the rules that foretouch avatar pairs writes "
      "(-o), and give these as --pairs",
      pairs.size() == 1 ? "1 pair of own links is"
                        : fmt::format("{} pairs of own links are", pairs.size()),
      looks, firstOf(names));
}

}  // namespace foretouch::tools
