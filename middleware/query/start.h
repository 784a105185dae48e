// middleware/query/start.h: does a link's mesh touch the scene at t = 0? Not installed.
#pragma once

#include <optional>
#include <vector>

#include "middleware/query/lane_backtracking.h"
#include "middleware/query/link_query.h"

namespace foretouch::internal {

/// contactAtStart() for exact fidelity. A limb that stands in furniture cuts hundreds of triangles
/// at once, all with separation 0, and looking at all of them would tell nobody anything: scene
/// triangles are asked in the order of how deep they are in the link's LSS, and the first one that
/// the mesh touches is reported, with the lowest of the link's triangles that touch it. Where none
/// is touched, the contacts within the tolerance are compared as usual. Consumes `candidates`.
/// With `lanes`, which know the candidates' triangles and whose span begins at 0, these refute what
/// they can first: the same answer, sooner.
[[nodiscard]] std::optional<LinkContact> meshContactAtStart(const LinkQuery& query,
                                                            std::vector<Candidate>& candidates,
                                                            PartScratch* lanes,
                                                            QueryCounters& counters);

}  // namespace foretouch::internal
