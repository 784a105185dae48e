// middleware/backtracking.h: the first contact of one link, by conservative advancement on the true
// curved motion. Scalar and plain: the reference that faster forms are held against. Not installed.
//
// At time t a plane with unit normal n separates LSS and triangle. It keeps doing so until an end e
// of the axis has crossed it, and e approaches it by at most s*(-n.v_e) + A_e*s^2/2 within s. So no
// contact before the first s where clearance_e - radius + s*(n.v_e) - A_e*s^2/2 falls to the floor,
// tolerance/4. Proof with rounding: docs/guarantees.md 5. After [Mirtich96] and, for the directed
// bound, [Tang09] C2A Lemma 4.1; here each end has its own clearance, speed and acceleration.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/motion.h"
#include "middleware/query.h"
#include "middleware/scene.h"
#include "tessellation/swept_lss.h"

namespace foretouch::internal {

/// The equal pieces into which [0,1] is cut for culling: piece k is [timeOf(k), timeOf(k+1)].
struct Pieces {
  int count = 1;  // at most kMaxPieces
  [[nodiscard]] double timeOf(int k) const { return static_cast<double>(k) / count; }
  /// The piece that holds `t`, which is in [0,1).
  [[nodiscard]] int at(double t) const;
};
inline constexpr int kMaxPieces = 32;

/// One LSS of the link against one triangle, on the pieces in which their boxes meet.
struct Candidate {
  TriangleId triangle = -1;
  std::int32_t lss = -1;
  std::uint32_t pieces = 0;  // bit k: piece k
  double nearest = 0.0;      // among ties: the gap is not smaller, as boxes tell
  double freeUntil = 0.0;    // proven: separation > 0 on [0, freeUntil), >= floor there unless 0
};

/// What backtrack() needs to know of one link; all references outlive the call.
struct LinkQuery {
  LinkId link;
  const std::vector<Lss>& lss;
  const std::vector<AxisBounds>& axisBounds;  // one an LSS
  const ChainMotion& motion;
  const Scene& scene;
  Pieces pieces;
  double tolerance;
  std::uint64_t maxAdvancements;
};

/// The link's contact at t = 0, which ends the matter, or a verdict of Clear that says only that
/// none was found there (within the budget). `candidates`: all pairs whose boxes, grown by the
/// tolerance, meet at t = 0. A limb inside furniture is answered by these few, whatever it sweeps
/// afterwards. Consumes `candidates` (used as a heap).
[[nodiscard]] LinkContact contactAtStart(const LinkQuery& query, std::vector<Candidate>& candidates,
                                         QueryCounters& counters);

/// The link's first contact on [0,1]. Consumes `candidates` (used as a heap).
[[nodiscard]] LinkContact backtrack(const LinkQuery& query, std::vector<Candidate>& candidates,
                                    QueryCounters& counters);

/// Largest s >= 0, rounded down, such that clearance + s*speed - acceleration*s^2/2 >= 0 on all of
/// [0, s]; infinity where it never falls below. `clearance` > 0, `acceleration` >= 0; `speed` is
/// the rate at which the clearance grows (negative: closing). Exposed for its test.
[[nodiscard]] double safeStep(double clearance, double speed, double acceleration);

}  // namespace foretouch::internal
