#include "middleware/query/scalar_query.h"

#include <algorithm>
#include <cmath>

#include "lss/index.h"
#include "middleware/pair/backtracking.h"
#include "middleware/pair/query_memory.h"
#include "middleware/pair/query_plan.h"
#include "middleware/pair/skin_sweep.h"
#include "middleware/scene/scene_parts.h"
#include "middleware/surface/link_surface.h"

namespace foretouch::internal {
namespace {

/// Pieces are short enough that no link moves farther than this (m) in one, up to kMaxPiecesUsed.
/// Longer pieces mean more candidates that are not near, shorter ones more forward kinematics; only
/// speed depends on it.
constexpr double kPieceTravel = 0.08;
constexpr int kMaxPiecesUsed = 12;
static_assert(kMaxPiecesUsed <= kMaxPieces);

/// One query over all links of one step.
class StepQuery final : private Neighbours {
 public:
  StepQuery(const QueryPlan& plan, const Body& body, const ChainMotion& motion,
            const WorkMeter& meter, QueryMemory& scratch)
      : plan_(plan),
        body_(body),
        motion_(motion),
        scene_(plan.scene),
        scratch_(scratch),
        meter_(meter) {}

  void run(StepContacts& step) {
    scratch_.cutShort.clear();
    cutIntoPieces();
    step.counters.states += static_cast<std::uint64_t>(body_.numLinks() * (pieces_.count + 1));
    for (LinkId link = 0; link < body_.numLinks(); ++link) {
      // Equal shares, so that the last links have theirs; the others get what one leaves.
      const auto others = static_cast<std::uint64_t>(body_.numLinks() - link);
      meter_.beginPart(step.counters, meter_.left(step.counters) / others);
      step.links[slotOf(link)] = firstContactOf(link, step.counters);
      if (meter_.isLimited() && meter_.isPartSpent(step.counters))
        scratch_.cutShort.push_back(link);
    }
    for (const LinkId link : scratch_.cutShort) {
      goOn(step.links[slotOf(link)], step.counters);
    }
  }

 private:
  /// Asks again, with all that is left, for a link whose share was spent.
  void goOn(LinkContact& contact, QueryCounters& counters) {
    if (meter_.isSpent(counters)) return;
    meter_.beginPart(counters, WorkMeter::kUnlimited);
    const LinkContact again = firstContactOf(contact.link, counters);
    const bool isWhole = !meter_.isPartSpent(counters);
    if (isWhole || again.freeUntil > contact.freeUntil) contact = again;
  }

  void cutIntoPieces() {
    double travel = 0.0;
    for (LinkId link = 0; link < body_.numLinks(); ++link) {
      for (const Lss& lss : body_.lss(link)) {
        travel = std::max(travel, axisBounds(lss, motion_.bounds(link)).speed);
      }
    }
    const double wanted = std::ceil(travel / kPieceTravel);
    pieces_.count = static_cast<int>(std::min<double>(kMaxPiecesUsed, std::max(1.0, wanted)));
    // Never fewer, which would give their memory back.
    scratch_.nodes.resize(std::max(scratch_.nodes.size(), countOf(pieces_.count) + 1));
    for (int k = 0; k <= pieces_.count; ++k) {
      scratch_.evaluator.statesAt(pieces_.timeOf(k), scratch_.nodes[slotOf(k)]);
    }
  }

  LinkContact firstContactOf(LinkId link, QueryCounters& counters) {
    skin_ = plan_.of(link).skin;
    tolerance_ = plan_.of(link).tolerance;
    if (skin_ != nullptr) return firstSkinContactOf(link, counters);
    surface_ = plan_.of(link).surface;
    if (scratch_.ignored.collect(body_.ignored(), link) || body_.lss(link).empty()) {
      return clearContact(link);
    }
    const Aabb swept = sweep(link);
    scratch_.found.clear();
    plan_.culler->collect(swept, scratch_.found, counters.nodes);
    const LinkQuery query = queryOf(link);
    gather(scratch_.startBoxes, 1);
    counters.candidates += scratch_.candidates.size();
    if (const auto atStart = contactAtStart(query, scratch_.candidates, counters)) return *atStart;
    gather(scratch_.boxes, pieces_.count);
    counters.candidates += scratch_.candidates.size();
    scratch_.pairs = scratch_.candidates;
    return backtrack(query, scratch_.candidates, counters);
  }

  /// Those pairs that the search began with whose boxes, grown by the tolerance, meet then.
  void collect(double t, const PosedLink& /*posed*/, double /*reach*/,
               std::vector<Candidate>& candidates, QueryCounters& /*counters*/) override {
    const int piece = pieces_.at(t);
    candidates.clear();
    for (const Candidate& pair : scratch_.pairs) {
      if ((pair.pieces >> piece & 1u) != 0) candidates.push_back(pair);
    }
  }

  [[nodiscard]] LinkQuery queryOf(LinkId link) {
    return {{link, body_.lss(link), scratch_.axisBounds, scratch_.evaluator, surface_, skin_},
            nullptr,
            &scene_,
            pieces_,
            tolerance_,
            meter_,
            plan_.leafProver.get(),
            *this,
            &scratch_.states};
  }

  LinkContact firstSkinContactOf(LinkId link, QueryCounters& counters) {
    const LinkQuery query = queryOf(link);
    const std::int32_t numTriangles = query.one.skin->numTriangles(link);
    if (scratch_.ignored.collect(body_.ignored(), link)) return clearContact(link);
    sweepSkin(query.one, scratch_.nodes, pieces_, tolerance_, scratch_.startBoxes, scratch_.boxes);
    if (!isNearAnything(scratch_.boxes, counters)) return clearContact(link);
    gatherSkin(scratch_.startBoxes, 1, numTriangles, counters);
    if (const auto atStart = contactAtStart(query, scratch_.candidates, counters)) return *atStart;
    gatherSkin(scratch_.boxes, pieces_.count, numTriangles, counters);
    scratch_.pairs = scratch_.candidates;
    return backtrack(query, scratch_.candidates, counters);
  }

  bool isNearAnything(const std::vector<Aabb>& boxes, QueryCounters& counters) {
    Aabb all;
    for (const Aabb& box : boxes) all.add(box);
    scratch_.found.clear();
    plan_.culler->collect(all, scratch_.found, counters.nodes);
    return !scratch_.found.empty();
  }

  /// Pairs of the skin's triangles with the scene's, by `count` boxes per triangle of the skin.
  void gatherSkin(const std::vector<Aabb>& boxes, int count, std::int32_t numTriangles,
                  QueryCounters& counters) {
    scratch_.candidates.clear();
    for (std::int32_t i = 0; i < numTriangles; ++i) {
      const Aabb* const own = boxes.data() + static_cast<std::ptrdiff_t>(i) * count;
      Aabb all;
      for (int k = 0; k < count; ++k) all.add(own[k]);
      scratch_.found.clear();
      plan_.culler->collect(all, scratch_.found, counters.nodes);
      for (const TriangleId id : scratch_.found) {
        if (scratch_.ignored.has(scene_, id)) continue;
        const std::uint32_t meets = piecesMeeting(own, count, boxOf(scene_.triangle(id)));
        if (meets == 0) continue;
        addCandidate(id, 0, meets, Part::of(HierarchyChild::triangle(i)));
      }
    }
    counters.candidates += scratch_.candidates.size();
  }

  void addCandidate(TriangleId triangle, std::int32_t lss, std::uint32_t pieces, Part part) {
    Candidate candidate;
    candidate.triangle = triangle;
    candidate.lss = lss;
    candidate.pieces = pieces;
    candidate.part = part;
    scratch_.candidates.push_back(candidate);
  }

  /// Bit k: the k-th of `count` boxes meets `box`.
  [[nodiscard]] static std::uint32_t piecesMeeting(const Aabb* boxes, int count, const Aabb& box) {
    std::uint32_t meets = 0;
    for (int k = 0; k < count; ++k) {
      meets |= static_cast<std::uint32_t>(boxes[k].overlaps(box)) << k;
    }
    return meets;
  }

  /// Boxes of every LSS of the link at the start and on every piece, grown by the tolerance;
  /// returns their union.
  Aabb sweep(LinkId link) {
    Aabb all;
    scratch_.axisBounds.clear();
    scratch_.startBoxes.clear();
    scratch_.boxes.clear();
    for (const Lss& lss : body_.lss(link)) {
      const AxisBounds bounds = axisBounds(lss, motion_.bounds(link));
      scratch_.axisBounds.push_back(bounds);
      AxisEnds begin = axisEnds(lss, nodeState(0, link));
      scratch_.startBoxes.push_back(sweptBox(lss, bounds, begin, begin, 0.0, tolerance_));
      for (int k = 0; k < pieces_.count; ++k) {
        const AxisEnds end = axisEnds(lss, nodeState(k + 1, link));
        const double span = pieces_.timeOf(k + 1) - pieces_.timeOf(k);
        scratch_.boxes.push_back(sweptBox(lss, bounds, begin, end, span, tolerance_));
        all.add(scratch_.boxes.back());
        begin = end;
      }
    }
    return all;
  }

  [[nodiscard]] const LinkState& nodeState(int k, LinkId link) const {
    return scratch_.nodes[slotOf(k)][slotOf(link)];
  }

  /// The candidates among the triangles found, by `count` boxes per LSS. This double-precision test
  /// makes every culler's answer the same.
  void gather(const std::vector<Aabb>& boxes, int count) {
    scratch_.candidates.clear();
    const auto numLss = static_cast<std::int32_t>(scratch_.axisBounds.size());
    for (const TriangleId id : scratch_.found) {
      if (scratch_.ignored.has(scene_, id)) continue;
      const Aabb box = boxOf(scene_.triangle(id));
      for (std::int32_t lss = 0; lss < numLss; ++lss) {
        const std::uint32_t meets = piecesMeeting(boxes.data() + lss * count, count, box);
        if (meets != 0) {
          addCandidate(id, lss, meets, Part::whole());
        }
      }
    }
  }

  const QueryPlan& plan_;
  const Body& body_;
  const ChainMotion& motion_;
  const Scene& scene_;
  QueryMemory& scratch_;
  WorkMeter meter_;
  double tolerance_ = 0.0;  // of the current link
  // The current link's; null at other fidelities.
  const LinkSurface* surface_ = nullptr;
  const SkinParts* skin_ = nullptr;
  Pieces pieces_;
};

}  // namespace

void scalarQuery(const QueryPlan& plan, const Body& body, const ChainMotion& motion,
                 const WorkMeter& meter, QueryMemory& scratch, StepContacts& step) {
  StepQuery(plan, body, motion, meter, scratch).run(step);
}

}  // namespace foretouch::internal
