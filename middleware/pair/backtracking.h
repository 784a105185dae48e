// middleware/pair/backtracking.h: the first contact of one link, by conservative advancement on
// the true curved motion. Scalar and plain: the reference for the faster forms. Not installed.
//
// At time t a plane with unit normal n separates LSS and triangle. It keeps doing so until an end e
// of the axis has crossed it, and e approaches it by at most s*(-n.v_e) + A_e*s^2/2 within s. So no
// contact before the first s where clearance_e - radius + s*(n.v_e) - A_e*s^2/2 falls to the floor,
// tolerance/4. Proof with rounding: docs/guarantees.md 5. After [Mirtich96] and, for the directed
// bound, [Tang09] C2A Lemma 4.1; here each end has its own clearance, speed and acceleration.
#pragma once

#include <optional>
#include <vector>

#include "middleware/pair/link_query.h"

namespace foretouch::internal {

/// The link's contact at t = 0, which is its first; nothing if none was found there (within the
/// budget). `candidates`: all pairs whose boxes, grown by the tolerance, meet at t = 0. These few
/// pairs settle a limb inside furniture, whatever it sweeps afterwards. Consumes `candidates` (used
/// as a heap).
[[nodiscard]] std::optional<LinkContact> contactAtStart(const LinkQuery& query,
                                                        std::vector<Candidate>& candidates,
                                                        QueryCounters& counters);

/// What is reported in place of `contact`, a Contact: the nearest at its instant. Replaces
/// `candidates`.
[[nodiscard]] LinkContact nearestContact(const LinkQuery& query, const LinkContact& contact,
                                         std::vector<Candidate>& candidates,
                                         QueryCounters& counters);

/// The link's first contact on [0,1], with the scene or with the query's other link. Consumes
/// `candidates` (used as a heap).
[[nodiscard]] PairContact backtrack(const LinkQuery& query, std::vector<Candidate>& candidates,
                                    QueryCounters& counters);

}  // namespace foretouch::internal
