// middleware/pair/start.h: does a link's mesh touch the scene at t = 0? Not installed.
#pragma once

#include <optional>
#include <vector>

#include "middleware/pair/link_query.h"
#include "middleware/pair/part_pairs.h"

namespace foretouch::internal {

/// contactAtStart() for exact fidelity. A limb that stands in furniture cuts hundreds of triangles
/// at once, all with separation 0; testing them all would add nothing. So this tests the scene's
/// triangles deepest in the link's LSS first and reports the first one that the mesh touches, with
/// the lowest of the link's triangles that touch it. If the mesh touches none, it compares the
/// contacts within the tolerance as usual. Consumes `candidates`. With `lanes`, which hold the
/// candidates' triangles and whose span begins at 0, it first refutes pairs in lanes: the same
/// answer, sooner.
[[nodiscard]] std::optional<LinkContact> meshContactAtStart(const LinkQuery& query,
                                                            std::vector<Candidate>& candidates,
                                                            PartScratch* lanes,
                                                            QueryCounters& counters);

}  // namespace foretouch::internal
