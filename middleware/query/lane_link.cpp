#include "middleware/query/lane_link.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "lss/assert.h"
#include "lss/index.h"
#include "lss/rounding.h"
#include "lss/simd.h"
#include "middleware/pair/lane_backtracking.h"
#include "middleware/pair/lane_nearest.h"
#include "middleware/pair/skin_start.h"
#include "middleware/pair/start.h"
#include "middleware/scene/scene_parts.h"
#include "middleware/surface/link_surface.h"

namespace foretouch::internal {
namespace {

/// Lanes report certain contact within this share of the tolerance. The scalar code must agree; its
/// rounding is far below the rest.
constexpr double kCertainShare = 1.0 - 0x1p-10;
/// Past what doubles take for within the tolerance.
constexpr double kBeyond = 1.0 + 0x1p-10;
/// No pair is certainly in contact.
constexpr float kNeverCertain = -1.0F;
/// Steps of a cluster before its triangles: if the cluster is done by then, up to eight triangles
/// need no steps.
constexpr int kClusterRounds = 6;
/// Leaves whose triangles advance together. The first that touch save the others most of their
/// steps.
constexpr std::size_t kPartsAtOnce = 4;
/// Equal parts of a slab by which we sort clusters by time.
constexpr std::size_t kTimeBins = 32;

FloatBox sweptBox(const SweptBoxes& boxes, std::int32_t lss) {
  FloatBox box;
  for (int axis = 0; axis < 3; ++axis) {
    box.lower[axis] = boxes.lower[axis][lss];
    box.upper[axis] = boxes.upper[axis][lss];
  }
  return box;
}

}  // namespace

LaneLink::LaneLink(const QueryPlan& plan, const Body& body, const LssTable& table,
                   const ChainMotion& motion, const WorkMeter& meter, QueryMemory& scratch)
    : plan_(plan),
      body_(body),
      table_(table),
      motion_(motion),
      scene_(plan.scene),
      meter_(meter),
      scratch_(scratch),
      lanes_(scratch.lanes),
      bvh_(plan.scene.parts().bvh) {
  useTolerance(plan.tolerances.least);
}

void LaneLink::useTolerance(double tolerance) {
  tolerance_ = tolerance;
  tolerances_.floor = floatAbove(kFloorShare * tolerance);
  tolerances_.handOver = floatBelow(kHandOverShare * tolerance);
}

double LaneLink::toleranceOf(LinkId link) const {
  const double own = lanes_.tolerances.empty() ? 0.0 : lanes_.tolerances[slotOf(link)];
  return own > 0.0 ? own : plan_.of(link).tolerance;
}

LinkContact LaneLink::undone(LinkId link) const {
  return undecidedContact(link, begin_, UndecidedReason::WorkBudget);
}

void LaneLink::prepare(LinkId link) {
  link_ = link;
  scratch_.ignored.collect(body_.ignored(), link);
  for (const IgnoredPair& pair : lanes_.touched) {
    if (pair.link == link) scratch_.ignored.add(pair.object);
  }
  if (!plan_.margins.empty() || !lanes_.tolerances.empty()) useTolerance(toleranceOf(link));
}

bool LaneLink::hasTriangles() const {
  return plan_.of(link_).surface != nullptr || plan_.of(link_).skin != nullptr;
}

LinkContact LaneLink::answerAtStart(LinkId link, QueryCounters& counters) {
  prepare(link);
  tolerances_.contact = kNeverCertain;
  // Nothing that may be within the tolerance goes on.
  tolerances_.handOver = floatAbove(kBeyond * tolerance_);
  const LinkContact contact = answerBefore(link, Ask::AtStart, kBegin, counters).contact;
  useTolerance(tolerance_);
  return contact;
}

LinkContact LaneLink::answer(LinkId link, float limit, QueryCounters& counters) {
  prepare(link);
  // A triangle that touches an LSS may still miss the triangles in it.
  tolerances_.contact = hasTriangles() ? kNeverCertain : floatBelow(kCertainShare * tolerance_);
  if (hasTriangles() && begin_ == 0.0) {
    // The triangles that a link inside furniture touches at once settle it, whatever it sweeps
    // afterwards.
    const LinkContact atStart = answerBefore(link, Ask::AtStart, kBegin, counters).contact;
    if (atStart.verdict != Verdict::Clear || limit == kBegin) return atStart;
  }
  const auto [contact, until] = answerBefore(link, Ask::Along, limit, counters);
  const bool isBelieved = until == limit;
  if (isBelieved || (contact.verdict != Verdict::Clear && contact.freeUntil <= timeOf(until))) {
    return contact;
  }
  // Lanes dropped pairs later than a contact that the scalar code then did not find. Both are
  // proved, so this does not happen; if it did, we must still miss nothing.
  tolerances_.contact = kNeverCertain;
  return answerBefore(link, Ask::Along, limit, counters).contact;
}

LaneLink::Answer LaneLink::answerBefore(LinkId link, Ask ask, float limit,
                                        QueryCounters& counters) {
  scratch_.candidates.clear();
  const std::int32_t firstLss = table_.first(link);
  for (std::int32_t lss = firstLss; lss < table_.first(link + 1); ++lss) {
    lanes_.handed.count = 0;
    const std::optional<float> lowered = advanceLss(lss, limit, counters);
    if (!lowered) return {undone(link), limit};
    limit = *lowered;
    addCandidates(lss - firstLss);
  }
  const double latest = timeOf(limit);
  auto& candidates = scratch_.candidates;
  candidates.erase(std::remove_if(candidates.begin(), candidates.end(),
                                  [&](const Candidate& c) { return c.freeUntil > latest; }),
                   candidates.end());
  return {candidates.empty() ? clearContact(link) : scalarAnswer(link, ask, counters), limit};
}

/// The contact of the pairs that lanes left.
LinkContact LaneLink::scalarAnswer(LinkId link, Ask ask, QueryCounters& counters) {
  prepareScalar(link);
  const LinkPlan& asked = plan_.of(link);
  const LinkQuery query{
      {link, body_.lss(link), scratch_.axisBounds, scratch_.evaluator, asked.surface, asked.skin},
      nullptr,
      &scene_,
      Pieces{1, nullptr, end_},
      tolerance_,
      meter_,
      plan_.leafProver.get(),
      *this,
      &scratch_.states};
  if (asked.skin != nullptr) return skinContact(query, ask, counters);
  if (asked.surface != nullptr) return surfaceContact(query, ask, counters);
  if (ask == Ask::Along) return backtrack(query, scratch_.candidates, counters);
  const auto contact = contactAtStart(query, scratch_.candidates, counters);
  return contact ? *contact : clearContact(link);
}

/// At exact fidelity: the contact of the link's triangles, by the LSS candidates' times.
LinkContact LaneLink::surfaceContact(const LinkQuery& query, Ask ask, QueryCounters& counters) {
  PartScratch& parts = lanes_.parts;
  // A single lane is slower than doubles, which need fewer evaluations.
  const bool inLanes = activeSimd() != Simd::Scalar;
  if (inLanes) {
    const FramePolynomials polynomials =
        framePolynomialsOf(query.one.link, motion_, lanes_.nodes());
    parts.lanes.reset(polynomials, scene_.parts().origin, begin_, end_);
  }
  if (ask == Ask::AtStart) {
    if (inLanes) {
      for (Candidate& candidate : scratch_.candidates) {
        candidate.laneTriangle = parts.lanes.add(scene_.triangle(candidate.triangle));
      }
    }
    const auto contact =
        meshContactAtStart(query, scratch_.candidates, inLanes ? &parts : nullptr, counters);
    if (!contact) return clearContact(query.one.link);
    if (contact->verdict != Verdict::Contact) return *contact;
    return inLanes ? nearestInLanes(query, *contact, scratch_.candidates, parts, counters)
                   : nearestContact(query, *contact, scratch_.candidates, counters);
  }
  return inLanes ? backtrackInLanes(query, scratch_.candidates, parts, counters)
                 : backtrack(query, scratch_.candidates, counters);
}

/// The same at skinned fidelity, by the clusters' candidates.
LinkContact LaneLink::skinContact(const LinkQuery& query, Ask ask, QueryCounters& counters) {
  PartScratch& parts = lanes_.parts;
  parts.lanes.reset(parts.skin.beginLink(query.one.link), scene_.parts().origin, begin_, end_);
  if (ask == Ask::Along) return backtrackInLanes(query, scratch_.candidates, parts, counters);
  const auto contact = skinContactAtStart(query, scratch_.candidates, parts, counters);
  return contact ? *contact : clearContact(query.one.link);
}

void LaneLink::prepareScalar(LinkId link) {
  scratch_.axisBounds.clear();
  for (const Lss& lss : body_.lss(link)) {
    scratch_.axisBounds.push_back(axisBounds(lss, motion_.bounds(link)));
  }
}

/// From the pairs of the current slab: they include all that are within the tolerance at any
/// instant of it.
void LaneLink::collect(double t, const PosedLink& posed, double reach,
                       std::vector<Candidate>& candidates, QueryCounters& counters) {
  FORETOUCH_ASSERT(&candidates == &scratch_.candidates);
  candidates.clear();
  const std::int32_t first = table_.first(link_);
  for (std::int32_t lss = first; lss < table_.first(link_ + 1); ++lss) {
    const HitRange hits{lanes_.first[slotOf(lss)], lanes_.first[slotOf(lss) + 1]};
    if (hits.begin == hits.end) continue;
    if (meter_.isLimited() && meter_.isPartSpent(counters)) break;
    findNear(scene_, endsOf(lss, posed), radiusOf(lss), reach, hits, lanes_, lanes_.near, counters);
    const NearTriangles& near = lanes_.near;
    for (std::size_t k = 0; k < near.count; ++k) {
      if (scratch_.ignored.has(scene_, near.id[k])) continue;
      addCandidate(near.id[k], lss - first, near.gap[k], t);
    }
  }
}

/// The ends of one of the current link's LSS, or of one around a cluster of its skin.
AxisEnds LaneLink::endsOf(std::int32_t lss, const PosedLink& posed) const {
  if (plan_.of(link_).skin != nullptr) return lanes_.parts.skin.endsAt(lss, *posed.all);
  return axisEnds(body_.lss(link_)[slotOf(lss - table_.first(link_))], posed.state);
}

double LaneLink::radiusOf(std::int32_t lss) const {
  return plan_.blends ? lanes_.parts.skin.radius(lss) : table_[lss].radius;
}

/// Advances the LSS's pairs through the slab; `handed` gets those that lanes leave. Returns
/// the limit, lowered by certain contacts; nothing if the work was spent before all were done.
std::optional<float> LaneLink::advanceLss(std::int32_t lss, float limit, QueryCounters& counters) {
  const auto begin = lanes_.first[slotOf(lss)];
  const auto end = lanes_.first[slotOf(lss) + 1];
  if (begin == end) return limit;
  if (meter_.isLimited() && meter_.isPartSpent(counters)) return std::nullopt;
  const LssTable::Entry& entry = table_[lss];
  const LssPolynomials polynomials = plan_.blends ? lanes_.parts.skin.polynomials(lss)
                                                  : polynomialsOf(entry, motion_, lanes_.nodes());
  const LaneLss lane = laneLss(polynomials, entry.radius);
  float origin[3];
  for (int k = 0; k < 3; ++k) origin[k] = static_cast<float>(polynomials.origin[k]);
  lanes_.pairs.setSpheres(lane, bvh_.clusters(), lanes_.leaf.data() + begin, end - begin, origin,
                          kBegin);
  lanes_.clusters.count = 0;
  counters.clusterSteps +=
      lanes_.pairs.advanceSpheres(lane, tolerances_, kClusterRounds, limit, lanes_.clusters);
  sortClusters();
  std::size_t done = 0;
  while (done < lanes_.clusters.count) {
    if (meter_.isLimited() && meter_.isPartSpent(counters)) return std::nullopt;
    done = collectParts(begin, done, limit);
    lanes_.pairs.addTriangles(lane, lanes_.leafParts.data(), lanes_.leafParts.size(),
                              sweptBox(lanes_.boxes(), lss), origin, bvh_.vertexRounding());
    counters.candidates += lanes_.pairs.count();
    counters.laneSteps += lanes_.pairs.advanceTriangles(lane, tolerances_, limit, lanes_.handed);
  }
  return limit;
}

/// Sorts clusters by the earliest time still unproven, so that an early contact lets us skip the
/// later ones. No order if one batch takes them all.
void LaneLink::sortClusters() {
  HandedOver& clusters = lanes_.clusters;
  const std::size_t count = clusters.count;
  lanes_.order.resize(count);
  if (count <= kPartsAtOnce) {
    std::iota(lanes_.order.begin(), lanes_.order.end(), 0U);
    return;
  }
  std::array<std::uint32_t, kTimeBins + 1> first{};
  const auto binOf = [&](std::size_t i) {
    const float share = 0.5F * (clusters.time[i] + 1.0F);
    return std::min(static_cast<std::size_t>(share * kTimeBins), kTimeBins - 1);
  };
  for (std::size_t i = 0; i < count; ++i) ++first[binOf(i) + 1];
  for (std::size_t bin = 0; bin < kTimeBins; ++bin) first[bin + 1] += first[bin];
  for (std::size_t i = 0; i < count; ++i)
    lanes_.order[first[binOf(i)]++] = static_cast<std::uint32_t>(i);
}

/// Collects the triangles of the next clusters that are not proven clear, each from its first
/// unproven time. Returns where to continue.
std::size_t LaneLink::collectParts(std::size_t begin, std::size_t done, float limit) {
  lanes_.leafParts.clear();
  for (; done < lanes_.clusters.count && lanes_.leafParts.size() < kPartsAtOnce; ++done) {
    const std::uint32_t i = lanes_.order[done];
    if (lanes_.clusters.time[i] > limit) continue;
    const std::size_t hit = begin + static_cast<std::size_t>(lanes_.clusters.key[i]);
    const BvhLeaf& leaf = bvh_.leaf(static_cast<std::uint32_t>(lanes_.leaf[hit]));
    const std::uint8_t asked =
        withoutIgnored(lanes_.triangles[hit], leaf, scene_, scratch_.ignored);
    if (asked != 0) lanes_.leafParts.push_back({&leaf, asked, lanes_.clusters.time[i]});
  }
  return done;
}

void LaneLink::addCandidates(std::int32_t lssOfLink) {
  const HandedOver& handed = lanes_.handed;
  for (std::size_t i = 0; i < handed.count; ++i) {
    addCandidate(handed.key[i], lssOfLink, handed.gap[i], timeOf(handed.time[i]));
  }
}

void LaneLink::addCandidate(TriangleId triangle, std::int32_t lssOfLink, float gap,
                            double freeUntil) {
  Candidate candidate;
  candidate.triangle = triangle;
  candidate.lss = lssOfLink;
  candidate.pieces = 1;
  candidate.nearest = gap;
  candidate.freeUntil = freeUntil;
  scratch_.candidates.push_back(candidate);
}

/// Rounded up.
float LaneLink::lanesTimeOf(double t) const {
  return std::min(kEnd, floatAbove(2.0 * (t - begin_) / (end_ - begin_) - 1.0));
}

/// A slab's bounds are multiples of a power of two and u is a float, so only u + 1 rounds, for the
/// least u; kTimeRounding of the lanes covers that.
double LaneLink::timeOf(float u) const {
  return begin_ + 0.5 * (static_cast<double>(u) + 1.0) * (end_ - begin_);
}

}  // namespace foretouch::internal
