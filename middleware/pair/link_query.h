// middleware/pair/link_query.h: the question about a link and what it may meet: pairs of parts of
// both sides, and what each pair proves at an instant. Not installed.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "articulated/motion.h"
#include "middleware/contact.h"
#include "middleware/pair/provers.h"
#include "middleware/pair/side.h"
#include "middleware/pair/work_meter.h"
#include "middleware/scene/scene.h"

namespace foretouch::internal {

/// A step never goes below this share of the tolerance, so that contact is found from outside.
inline constexpr double kFloorShare = 0.25;

/// The pieces into which a span of t is cut for culling: piece k is [timeOf(k), timeOf(k+1)].
struct Pieces {
  int count = 1;                  // at most kMaxPieces
  const double* times = nullptr;  // count + 1, ascending; null: equal pieces of [0,1]
  double end = 1.0;               // the query does not look beyond
  [[nodiscard]] double timeOf(int k) const {
    return times != nullptr ? times[k] : static_cast<double>(k) / count;
  }
  /// The piece that holds `t`, which is in [0,1).
  [[nodiscard]] int at(double t) const { return count == 1 ? 0 : amongSeveral(t); }
  [[nodiscard]] int amongSeveral(double t) const;
};
inline constexpr int kMaxPieces = 32;

/// One part of the link against one triangle of the scene, or against one part of another link, on
/// the pieces in which they may be near. A query begins with whole LSS. At exact fidelity, when one
/// comes within the tolerance, the query replaces it by the two parts below it, from that instant
/// on.
struct Candidate {
  TriangleId triangle = -1;
  std::int32_t lss = -1;
  std::int32_t otherLss = -1;  // of the other link; then there is no triangle of the scene
  std::uint32_t pieces = 0;    // bit k: piece k
  // At freeUntil the gap is at least this, by boxes, lanes or separations.
  double nearest = -std::numeric_limits<double>::infinity();
  double freeUntil = 0.0;  // proven: separation > 0 on [0, freeUntil), >= floor there unless 0
  Part part = Part::whole(), otherPart = Part::whole();
  double radiusShare = 1.0;        // of the two LSS' radii, what counts (PairRadius)
  std::int32_t laneTriangle = -1;  // the triangle's number in PartLanes, if there are any
};

/// The earliest instant from `t` on in a piece of the candidate's; infinity if none before their
/// end.
[[nodiscard]] double nextPossible(const Pieces& pieces, const Candidate& candidate, double t);

/// Whether no query has answered the link.
[[nodiscard]] inline bool isUnanswered(const LinkContact& contact) {
  return contact.verdict == Verdict::Undecided && contact.reason == UndecidedReason::None;
}
/// Nothing is answered yet.
void beginAnswer(StepContacts& step);
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

/// The input of backtrack() for one link against another one, or against a scene at rest; all that
/// it refers to outlives the call. Both sides are seen from one frame, in which they have their
/// bounds.
struct LinkQuery {
  Side one;
  const Side* other;   // null: the scene
  const Scene* scene;  // null: the other link
  Pieces pieces;
  double tolerance;
  const WorkMeter& meter;
  const LeafProver* leafProver;  // or null: advancement alone
  Neighbours& neighbours;
  std::vector<LinkState>* states = nullptr;  // memory for those of all links, if there is a skin

  [[nodiscard]] bool isExact() const { return one.surface != nullptr; }
  /// Whether nothing is below either part: whatever they touch, the link touches.
  [[nodiscard]] bool isSurface(const Candidate& candidate) const {
    return one.isSurface(candidate.lss, candidate.part) &&
           (other == nullptr || other->isSurface(candidate.otherLss, candidate.otherPart));
  }
  /// The candidates that replace one that is not of surfaces: the part with the larger radius gives
  /// way to the two below it, which may be one.
  struct Below {
    std::array<Candidate, 2> candidates;
    std::size_t count;
  };
  [[nodiscard]] Below below(const Candidate& candidate) const;
};

/// The link's states by instant. Keeps the last one: neighbouring candidates need the same.
class StateCache {
 public:
  StateCache(const LinkQuery& query, QueryCounters& counters)
      : query_(query), counters_(counters) {}
  [[nodiscard]] const PosedLink& at(double t) {
    if (t == time_) return posed_;
    if (query_.one.skin != nullptr) {
      query_.one.evaluator.statesAt(t, *query_.states);
      posed_.all = query_.states;
      counters_.states += query_.states->size();
    } else {
      posed_.state = query_.one.stateAt(t);
      ++counters_.states;
    }
    if (query_.other != nullptr) {
      posed_.other = query_.other->stateAt(t);
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

/// The candidate's parts, as the pair sees them.
[[nodiscard]] MovingHull oneSideOf(const LinkQuery& query, const Candidate& candidate,
                                   const PosedLink& posed);
[[nodiscard]] MovingHull otherSideOf(const LinkQuery& query, const Candidate& candidate,
                                     const PosedLink& posed);
/// The other side's triangle, of the scene or of the other link's mesh; -1 for an LSS.
[[nodiscard]] TriangleId otherTriangle(const LinkQuery& query, const Candidate& candidate);

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

/// Scene to link. If part and triangle meet, their difference has no direction: then the normal of
/// the features; zero if these have none either.
[[nodiscard]] Eigen::Vector3d contactNormal(const Separation& axes);

/// The report of a pair that is in contact at `t`.
[[nodiscard]] PairContact contactOf(const LinkQuery& query, const Candidate& candidate,
                                    const MovingPair& pair, double t);

/// The order of contacts with equal toi, as query.h states it.
[[nodiscard]] bool comesFirst(const LinkContact& x, const LinkContact& y);
[[nodiscard]] bool comesFirst(const PairContact& x, const PairContact& y);

}  // namespace foretouch::internal
