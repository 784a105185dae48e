// middleware/pair/skin_start.h: does a link's skin touch the scene at t = 0? Not installed.
#pragma once

#include <optional>
#include <vector>

#include "middleware/pair/link_query.h"
#include "middleware/pair/part_pairs.h"

namespace foretouch::internal {

/// contactAtStart() for pairs of clusters of a skin. Lanes refute pairs of their triangles; those
/// left go to doubles, so the answer is theirs. The span of `scratch` begins at 0.
[[nodiscard]] std::optional<LinkContact> skinContactAtStart(const LinkQuery& query,
                                                            const std::vector<Candidate>& clusters,
                                                            PartScratch& scratch,
                                                            QueryCounters& counters);

}  // namespace foretouch::internal
