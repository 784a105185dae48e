// middleware/query/lane_link.h: the first contact of one link in a span of its motion, the fast
// way: certified polynomials, advancement of clusters and of triangles in lanes; and the scalar
// code, in doubles, for the pairs that lanes could not decide. Not installed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "middleware/pair/backtracking.h"
#include "middleware/pair/query_memory.h"
#include "middleware/pair/query_plan.h"
#include "middleware/pair/work_meter.h"
#include "middleware/query/body.h"
#include "middleware/scene/flat_bvh.h"

namespace foretouch::internal {

/// Works on what LaneCull left in the scratch for the same span. All references outlive it.
class LaneLink final : private Neighbours {
 public:
  static constexpr float kBegin = -1.0F, kEnd = 1.0F;  ///< Bounds of u, the time of a span.

  LaneLink(const QueryPlan& plan, const Body& body, const LssTable& table,
           const ChainMotion& motion, const WorkMeter& meter, QueryMemory& scratch);

  void beginSpan(double begin, double end) {
    begin_ = begin;
    end_ = end;
  }
  /// Looks for nothing later than `limit`. Undecided for want of work: free until the span's begin
  /// or later.
  [[nodiscard]] LinkContact answer(LinkId link, float limit, QueryCounters& counters);
  /// For a span that begins with the step: the nearest contact at t = 0, if the link begins within
  /// its tolerance, else Clear, which says nothing of later.
  [[nodiscard]] LinkContact answerAtStart(LinkId link, QueryCounters& counters);

  [[nodiscard]] double timeOf(float u) const;
  [[nodiscard]] float lanesTimeOf(double t) const;

 private:
  /// Whether a contact counts at any time up to a limit, or at the step's beginning alone.
  enum class Ask : std::uint8_t { Along, AtStart };
  /// Certain contacts of lanes lower the limit: then the scalar code has to find one until there.
  struct Answer {
    LinkContact contact;
    float limit;
  };

  void prepare(LinkId link);
  void useTolerance(double tolerance);
  [[nodiscard]] double toleranceOf(LinkId link) const;
  [[nodiscard]] bool hasTriangles() const;
  [[nodiscard]] Answer answerBefore(LinkId link, Ask ask, float limit, QueryCounters& counters);
  [[nodiscard]] LinkContact scalarAnswer(LinkId link, Ask ask, QueryCounters& counters);
  [[nodiscard]] LinkContact undone(LinkId link) const;
  [[nodiscard]] LinkContact surfaceContact(const LinkQuery& query, Ask ask,
                                           QueryCounters& counters);
  [[nodiscard]] LinkContact skinContact(const LinkQuery& query, Ask ask, QueryCounters& counters);
  [[nodiscard]] AxisEnds endsOf(std::int32_t lss, const PosedLink& posed) const;
  [[nodiscard]] double radiusOf(std::int32_t lss) const;
  void prepareScalar(LinkId link);
  void collect(double t, const PosedLink& posed, double reach, std::vector<Candidate>& candidates,
               QueryCounters& counters) override;
  [[nodiscard]] std::optional<float> advanceLss(std::int32_t lss, float limit,
                                                QueryCounters& counters);
  void sortClusters();
  [[nodiscard]] std::size_t collectParts(std::size_t begin, std::size_t done, float limit);
  void addCandidates(std::int32_t lssOfLink);
  void addCandidate(TriangleId triangle, std::int32_t lssOfLink, float gap, double freeUntil);

  const QueryPlan& plan_;
  const Body& body_;
  const LssTable& table_;
  const ChainMotion& motion_;
  const Scene& scene_;
  const WorkMeter& meter_;
  QueryMemory& scratch_;
  LaneScratch& lanes_;
  const FlatBvh& bvh_;
  double tolerance_ = 0.0;  // of the current link
  LaneTolerances tolerances_{};
  LinkId link_ = 0;                 // the current one
  double begin_ = 0.0, end_ = 1.0;  // of the current span
};

}  // namespace foretouch::internal
