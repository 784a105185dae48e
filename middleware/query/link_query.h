// middleware/query/link_query.h: the question about one link: its pairs with the scene's triangles,
// and what each pair proves at an instant. Not installed.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "articulated/motion.h"
#include "middleware/contact.h"
#include "middleware/query/link_parts.h"
#include "middleware/query/provers.h"
#include "middleware/query/work_meter.h"
#include "middleware/scene/scene.h"

namespace foretouch::internal {

/// A step never goes below this share of the tolerance, so that contact is found from outside.
inline constexpr double kFloorShare = 0.25;

/// The equal pieces into which [0,1] is cut for culling: piece k is [timeOf(k), timeOf(k+1)].
struct Pieces {
  int count = 1;  // at most kMaxPieces
  [[nodiscard]] double timeOf(int k) const { return static_cast<double>(k) / count; }
  /// The piece that holds `t`, which is in [0,1).
  [[nodiscard]] int at(double t) const;
};
inline constexpr int kMaxPieces = 32;

/// One part of the link against one triangle, on the pieces in which their boxes meet. A query
/// begins with whole LSS. At exact fidelity, when one comes within the tolerance, the query
/// replaces it by the two parts below it, from that instant on.
struct Candidate {
  TriangleId triangle = -1;
  std::int32_t lss = -1;
  std::uint32_t pieces = 0;  // bit k: piece k
  // At freeUntil the gap is at least this, by boxes, lanes or separations.
  double nearest = -std::numeric_limits<double>::infinity();
  double freeUntil = 0.0;  // proven: separation > 0 on [0, freeUntil), >= floor there unless 0
  double end = 1.0;        // the query does not look beyond
  Part part = Part::whole();
  std::int32_t laneTriangle = -1;  // the triangle's number in PartLanes, if there are any
};

/// Marks every link as answered by no query.
void leaveUnanswered(LinkId numLinks, std::vector<LinkContact>& links);

/// Proven: no contact in the whole question. The one place that writes Clear, and only to a link
/// without an answer.
inline void answerClear(LinkContact& unanswered) {
  unanswered.verdict = Verdict::Clear;
  unanswered.freeUntil = unanswered.toi = 1.0;
}
/// A new record with that answer.
[[nodiscard]] LinkContact clearContact(LinkId link);

/// Finds the pairs that may be nearer than a contact: before its instant the others are proven
/// apart, at it they need not be farther.
class Neighbours {
 public:
  /// Replaces `candidates` by pairs of whole parts at `t`, as at the start of a query: all that may
  /// be within `reach` (m, hardly more than the tolerance), and perhaps others. `posed`: the link
  /// at that instant.
  virtual void collect(double t, const PosedLink& posed, double reach,
                       std::vector<Candidate>& candidates, QueryCounters& counters) = 0;

 protected:
  ~Neighbours() = default;
};

/// The input of backtrack() for one link; all references outlive the call.
struct LinkQuery {
  LinkParts parts;
  const Scene& scene;
  Pieces pieces;
  double tolerance;
  const WorkMeter& meter;
  const LeafProver* leafProver;  // or null: advancement alone
  MotionEvaluator& evaluator;    // of parts.motion
  Neighbours& neighbours;

  [[nodiscard]] bool isExact() const { return parts.surface != nullptr; }
  /// Nothing is below it: whatever it touches, the link touches.
  [[nodiscard]] bool isSurface(std::int32_t lss, Part part) const {
    return !isExact() || part.isTriangle() || !parts.surface->hasTriangles(lss);
  }
  /// The two parts below one that is not the surface itself (one, twice, if the LSS contains a
  /// single triangle).
  [[nodiscard]] std::array<Part, 2> below(std::int32_t lss, Part part) const;
};

/// The link's states by instant. Keeps the last one: neighbouring candidates need the same.
class StateCache {
 public:
  StateCache(const LinkQuery& query, QueryCounters& counters)
      : query_(query), counters_(counters) {}
  [[nodiscard]] const PosedLink& at(double t) {
    if (t == time_) return posed_;
    if (query_.parts.skin != nullptr) {
      query_.evaluator.statesAt(t, posed_.all);
      counters_.states += posed_.all.size();
    } else {
      posed_.state = query_.evaluator.stateAt(query_.parts.link, t);
      ++counters_.states;
    }
    time_ = t;
    return posed_;
  }

 private:
  const LinkQuery& query_;
  QueryCounters& counters_;
  PosedLink posed_;
  double time_ = -1.0;
};

/// A lower bound on the separation that pairOf() would compute, from the boxes of part and
/// triangle. Its slack, thousands of roundings of the coordinates, keeps it below however either
/// side rounds.
[[nodiscard]] double leastGap(const LinkQuery& query, const Candidate& candidate,
                              const PosedLink& posed);

/// The candidate's pair at one instant, counted.
[[nodiscard]] MovingPair pairOf(const LinkQuery& query, const Candidate& candidate,
                                const PosedLink& posed, QueryCounters& counters);

/// Up to which t, from `t` on, `pair` (the candidate's pair at `t`) proves the two apart; at most
/// 1, and `t` itself if it proves nothing.
[[nodiscard]] double provenFrom(const LinkQuery& query, const Candidate& candidate,
                                const MovingPair& pair, double t, QueryCounters& counters);

/// How far to look for pairs as near as a contact: its separation, and thousands of roundings of
/// the coordinates.
[[nodiscard]] double reachOf(const LinkContact& contact);

/// The report of a pair that is in contact at `t`.
[[nodiscard]] LinkContact contactOf(const LinkQuery& query, const Candidate& candidate,
                                    const MovingPair& pair, double t);

/// The order of contacts with equal toi, as query.h states it.
[[nodiscard]] bool comesFirst(const LinkContact& x, const LinkContact& y);

}  // namespace foretouch::internal
