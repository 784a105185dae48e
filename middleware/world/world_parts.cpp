#include "middleware/world/world_parts.h"

#include <limits>

namespace foretouch::internal {

const Episode* WorldBody::episodeAt(std::int64_t utimeUs) const {
  const Episode* found = nullptr;
  for (const Episode& episode : episodes) {
    if (episode.beginUs <= utimeUs) found = &episode;
  }
  return found;
}

std::int64_t WorldBody::nextEpisodeUs(std::int64_t utimeUs) const {
  for (const Episode& episode : episodes) {
    if (episode.beginUs > utimeUs) return episode.beginUs;
  }
  return std::numeric_limits<std::int64_t>::max();
}

bool WorldParts::isAsked(BodyId a, BodyId b) const {
  if (!options.askMeshes && !kindOf(a).avatar && !kindOf(b).avatar) return false;
  const auto row = asked[slotOf(body(a).options.group)];
  return (row >> static_cast<unsigned>(body(b).options.group) & 1U) != 0;
}

bool WorldParts::isStillAsked(BodyId id) const {
  return still && (options.askMeshes || kindOf(id).avatar) &&
         (askedStill >> static_cast<unsigned>(body(id).options.group) & 1U) != 0;
}

}  // namespace foretouch::internal
