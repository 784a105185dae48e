#include "middleware/query/self_query.h"

#include <algorithm>
#include <limits>
#include <tuple>

#include "lss/index.h"
#include "lss/rounding.h"
#include "lss/simd.h"
#include "middleware/query/backtracking.h"
#include "middleware/query/lane_cull.h"
#include "middleware/query/leaving.h"
#include "middleware/scene/scene_parts.h"
#include "tessellation/point_rounding.h"

namespace foretouch::internal {
namespace {

/// Nodes whose closest points propose planes, one after the other, for pairs that are still open:
/// the middle closes most, the ends what meets there.
constexpr int kProposingNodes[] = {3, 0, 7};
/// Past the rounding of a sum, and of the kernel's product with it.
constexpr float kBendInflation = 1.0F + 0x1p-21F;

/// The nodes are relative to the scene's middle. Where that is so far away that their places lose
/// more than this (m), a contact's points are found from the links' own states. The bound grows
/// with the chain: forty joints on end are at 2e-11 before they are anywhere.
constexpr double kStartRounding = 1e-10;

/// Per h^2/8 of a piece, rounded up past h's own rounding.
float sagittaOf(double begin, double end) {
  const double h = end - begin;
  return floatPaddedAbove(h * h / 8.0 * kInflation);
}

bool comesBefore(const PairContact& x, const PairContact& y) {
  if (isReportedBefore(x, y)) return true;
  return !isReportedBefore(y, x) && x.other < y.other;
}

}  // namespace

SelfQuery::SelfQuery(const QueryPlan& plan, const ChainMotion& motion, const WorkMeter& meter,
                     ScratchParts& scratch)
    : plan_(plan),
      self_(plan.self),
      table_(plan.table),
      motion_(motion),
      meter_(meter),
      scratch_(scratch),
      own_(scratch.self) {}

void SelfQuery::run(StepContacts& step) {
  const int slabs = slabsOf(table_, motion_, plan_.tolerances.least);
  own_.left.clear();
  for (int slab = 0; slab < slabs; ++slab) {
    begin_ = static_cast<double>(slab) / slabs;
    end_ = static_cast<double>(slab + 1) / slabs;
    evaluate(step.counters);
    collectOpen(step.counters);
    answerPairs(step);
  }
  finish(step);
}

void SelfQuery::runAmong(const FoundPairs& found, StepContacts& step) {
  stopsWhenSpent_ = meter_.isLimited();
  // Curves need the slabs.
  if (slabsOf(table_, motion_, plan_.tolerances.least) != 1) return run(step);
  own_.left.clear();
  take(found);
  answerPairs(step);
  finish(step);
}

bool SelfQuery::runAmongFrom(double begin, const FoundPairs& found, StepContacts& step) {
  if (slabsOf(table_, motion_, plan_.tolerances.least) != 1) return false;
  start_ = begin_ = begin;
  if (!areNodesFine(step.counters)) return false;
  own_.left.clear();
  take(found);
  answerPairs(step);
  finish(step);
  return true;
}

/// The first node has the places at the start, well enough to tell who touches there.
bool SelfQuery::areNodesFine(QueryCounters& counters) {
  return pointRounding(nodes(counters).bounds(), 0.0) <= kStartRounding;
}

void SelfQuery::take(const FoundPairs& found) {
  const AskedPairs& asked = self_.asked();
  MeetingPairs& meeting = own_.meeting;
  if (meeting.pairs.size() < found.numMeeting) meeting.pairs.resize(found.numMeeting);
  meeting.count = 0;
  for (std::size_t k = 0; k < found.numMeeting; ++k) {
    const LssIndexPair& pair = found.meeting[k];
    if (asked.has(pair.i, pair.j)) meeting.pairs[meeting.count++] = pair;
  }
  own_.pairs.clear();
  for (std::size_t k = 0; k < found.numOpen; ++k) {
    PlanePair pair = found.open[k];
    if (!asked.has(pair.i, pair.j)) continue;
    pair.frame = self_.frameOf(table_[pair.i].link, table_[pair.j].link);
    own_.pairs.push_back(pair);
  }
}

void SelfQuery::finish(StepContacts& step) const {
  std::sort(step.pairs.begin(), step.pairs.end(), comesBefore);
  step.arePairsAnswered = true;
}

/// Of the current slab. Pairs that touch at the start may need none.
const ChainNodes& SelfQuery::nodes(QueryCounters& counters) {
  scratch_.lanes.evaluateNodes(motion_, begin_, end_, plan_.scene.parts().origin, counters);
  return scratch_.lanes.nodes();
}

/// The links' frames at the nodes, and the boxes and ends of all LSS, in the current slab.
void SelfQuery::evaluate(QueryCounters& counters) {
  LaneScratch& lanes = scratch_.lanes;
  lanes.evaluateNodes(motion_, begin_, end_, plan_.scene.parts().origin, counters);
  SlabScratch& slab = lanes.slab();
  if (!slab.areBoxesOfNodes) {
    sweptBoxes(table_, motion_, slab.nodes, plan_.tolerances.largest, slab.boxes, &slab.ends);
    slab.areBoxesOfNodes = true;
  }
  own_.frames.resize(self_.frames().size());
  for (std::size_t i = 0; i < own_.frames.size(); ++i) {
    const LinkId link = self_.frames()[i];
    for (std::size_t k = 0; k < 9; ++k) {
      for (std::size_t node = 0; node < kNodes; ++node) {
        own_.frames[i].R[k][node] = link == kNoParent
                                        ? (k % 4 == 0 ? 1.0F : 0.0F)
                                        : static_cast<float>(slab.nodes.link(link).R[k][node]);
      }
    }
  }
  own_.accelerations.assign(countOf(table_.size()) * self_.frames().size(), -1.0F);
}

/// Pairs of LSS that planes do not keep apart throughout the slab.
void SelfQuery::collectOpen(QueryCounters& counters) {
  const ChainNodes& nodes = scratch_.lanes.nodes();
  collectMeeting(scratch_.lanes.boxes(), self_.asked(), own_.meeting);
  own_.pairs.clear();
  for (std::size_t k = 0; k < own_.meeting.count; ++k) addPlanePair(own_.meeting.pairs[k]);
  NodePlanes planes{scratch_.lanes.slab().ends.axes.data(), own_.frames.data(), {}};
  for (int k = 0; k < kNodePieces; ++k) {
    planes.sagittas[k] = sagittaOf(nodes.instant(k), nodes.instant(k + 1));
  }
  for (const int node : kProposingNodes) {
    if (own_.pairs.empty()) return;
    counters.laneSteps += own_.pairs.size();
    closeByPlanes(planes, node, own_.pairs.data(), own_.pairs.size());
    dropClosed();
    if (node == kProposingNodes[0]) tightenBends();
  }
}

/// In their frames, pairs bend less than in W; that costs too much for those that need it not.
void SelfQuery::tightenBends() {
  for (PlanePair& pair : own_.pairs) {
    pair.bend =
        (accelerationOf(pair.frame, pair.i) + accelerationOf(pair.frame, pair.j)) * kBendInflation;
  }
}

void SelfQuery::addPlanePair(const LssIndexPair& pair) {
  const LinkId a = table_[pair.i].link, b = table_[pair.j].link;
  const auto i = slotOf(pair.i), j = slotOf(pair.j);
  const NodeEnds& ends = scratch_.lanes.slab().ends;
  const double tolerance = std::min(plan_.of(a).tolerance, plan_.of(b).tolerance);
  const double extents =
      static_cast<double>(ends.extents[i]) + static_cast<double>(ends.extents[j]);
  const double roundings =
      static_cast<double>(ends.roundings[i]) + static_cast<double>(ends.roundings[j]);
  PlanePair open{pair.i, pair.j, self_.frameOf(a, b), 0.0F, 0.0F, kEveryPiece};
  // Padding is twice what floats round by, and the kernel's sum rounds by as much again.
  constexpr double kSumInflationOfReach = 1.0 + 0x1p-21;
  const double radii =
      self_.radiusShare(pair.i, pair.j) * (table_[pair.i].radius + table_[pair.j].radius);
  open.reach = floatPaddedAbove(
      (radii + kFloorShare * tolerance + kNodePlaneRounding * extents + roundings) *
      kSumInflationOfReach);
  const auto inWorld = [this](const LssTable::Entry& entry) {
    return motion_.sums(entry.link).accelerationAt(std::max(entry.rhoA, entry.rhoB));
  };
  open.bend = floatPaddedAbove(inWorld(table_[pair.i]) + inWorld(table_[pair.j])) * kBendInflation;
  own_.pairs.push_back(open);
}

/// Of the LSS' ends in the frame; rounded up. Found when it is first needed.
float SelfQuery::accelerationOf(std::int32_t frame, std::int32_t lss) {
  float& known = own_.accelerations[slotOf(frame) * countOf(table_.size()) + slotOf(lss)];
  if (known < 0.0F) {
    const LssTable::Entry& entry = table_[lss];
    const ChainSums sums = motion_.sumsIn(self_.frames()[slotOf(frame)], entry.link);
    known = floatPaddedAbove(sums.accelerationAt(std::max(entry.rhoA, entry.rhoB)));
  }
  return known;
}

void SelfQuery::dropClosed() {
  own_.pairs.erase(std::remove_if(own_.pairs.begin(), own_.pairs.end(),
                                  [](const PlanePair& pair) { return pair.open == 0; }),
                   own_.pairs.end());
}

/// By pairs of links; those that have an answer from an earlier slab keep it.
void SelfQuery::answerPairs(StepContacts& step) {
  std::vector<PlanePair>& pairs = own_.pairs;
  const auto linksOf = [this](const PlanePair& pair) {
    return std::make_tuple(table_[pair.i].link, table_[pair.j].link);
  };
  std::sort(pairs.begin(), pairs.end(), [&](const PlanePair& x, const PlanePair& y) {
    return std::tuple_cat(linksOf(x), std::make_tuple(x.i, x.j)) <
           std::tuple_cat(linksOf(y), std::make_tuple(y.i, y.j));
  });
  for (std::size_t first = 0; first < pairs.size();) {
    std::size_t next = first + 1;
    while (next < pairs.size() && linksOf(pairs[next]) == linksOf(pairs[first])) ++next;
    const auto [a, b] = linksOf(pairs[first]);
    const bool isKnown =
        begin_ > 0.0 && std::any_of(step.pairs.begin(), step.pairs.end(),
                                    [a = a, b = b](const PairContact& contact) {
                                      return contact.link == a && contact.other == b;
                                    });
    if (!isKnown) answerPair(first, next - first, step);
    first = next;
  }
}

void SelfQuery::answerPair(std::size_t first, std::size_t count, StepContacts& step) {
  const PlanePair* const pairs = own_.pairs.data() + first;
  const LinkId frame = self_.frames()[slotOf(pairs->frame)];
  one_.link = table_[pairs->i].link;
  other_.link = table_[pairs->j].link;
  if (stopsWhenSpent_ && meter_.isSpent(step.counters)) {
    const auto undone = undecidedContact(one_.link, begin_, UndecidedReason::WorkBudget);
    return keep(PairContact{undone}, kNoParent, step);
  }
  double times[kNodes];
  for (int k = 0; k < kNodes; ++k) {
    times[k] = k + 1 == kNodes ? end_ : begin_ + (end_ - begin_) * ChainNodes::time(k);
  }
  const LinkParts other = partsOf(other_, own_.boundsOfOther);
  LinkQuery query{partsOf(one_, own_.boundsOfOne),
                  plan_.scene,
                  Pieces{kNodePieces, times, end_},
                  tolerance(),
                  meter_,
                  nullptr,
                  scratch_.evaluator,
                  *this,
                  &other,
                  frame};
  const bool areMeshes = query.isExact() || other.surface != nullptr;
  const bool mayStart =
      begin_ == start_ &&
      std::any_of(pairs, pairs + count, [](const PlanePair& p) { return (p.open & 1U) != 0; });
  if (mayStart && !areMeshes && areNodesFine(step.counters)) {
    const auto contact = contactAtStart(query, step.counters);
    if (contact && !mayLeave(query, *contact, step.counters)) {
      return keep(*contact, kNoParent, step);
    }
  }
  prepareSide(one_, frame, own_.boundsOfOne);
  prepareSide(other_, frame, own_.boundsOfOther);
  PairContact contact = contactFrom(query, pairs, count, step.counters);
  if (mayLeave(query, contact, step.counters)) {
    contact = contactFrom(query, pairs, count, step.counters);
  }
  if (contact.verdict != Verdict::Clear) keep(contact, frame, step);
}

/// Of the pair at hand; null if it has not left.
const LeftPair* SelfQuery::leftPair() const {
  const auto found = std::find_if(own_.left.begin(), own_.left.end(), [this](const LeftPair& pair) {
    return pair.link == one_.link && pair.other == other_.link;
  });
  return found != own_.left.end() ? &*found : nullptr;
}

/// Of the pair at hand: the smaller one of both links, unless they began within it and left.
double SelfQuery::tolerance() const {
  const LeftPair* const left = leftPair();
  return left != nullptr ? left->tolerance
                         : std::min(plan_.of(one_.link).tolerance, plan_.of(other_.link).tolerance);
}

/// The pair began within its tolerance, and goes on with another one.
bool SelfQuery::mayLeave(LinkQuery& query, const PairContact& contact, QueryCounters& counters) {
  if (plan_.startShare == 0.0 || contact.verdict != Verdict::Contact) return false;
  if (leftPair() != nullptr) return false;
  const double separation =
      contact.toi == 0.0 ? contact.separation : startSeparation(query, counters);
  const double own = leavingTolerance(separation, query.tolerance, plan_.startShare);
  if (!(own > 0.0)) return false;
  own_.left.push_back({one_.link, other_.link, own});
  query.tolerance = own;
  return true;
}

/// Of the two links' LSS at t = 0: planes may have closed the piece that begins there.
double SelfQuery::startSeparation(const LinkQuery& query, QueryCounters& counters) {
  StateCache states(query, counters);
  double least = std::numeric_limits<double>::infinity();
  for (std::int32_t i = table_.first(one_.link); i < table_.first(one_.link + 1); ++i) {
    for (std::int32_t j = table_.first(other_.link); j < table_.first(other_.link + 1); ++j) {
      if (!self_.asked().has(i, j)) continue;
      const Candidate candidate = candidateOf({i, j}, kEveryPiece);
      least = std::min(least, pairOf(query, candidate, states.at(0.0), counters).estimate());
    }
  }
  return least;
}

/// In the query's frame.
PairContact SelfQuery::contactFrom(const LinkQuery& query, const PlanePair* pairs,
                                   std::size_t count, QueryCounters& counters) {
  scratch_.candidates.clear();
  for (std::size_t k = 0; k < count; ++k) {
    scratch_.candidates.push_back(candidateOf({pairs[k].i, pairs[k].j}, pairs[k].open));
  }
  advanceAlongCurves(query, counters);
  if (scratch_.candidates.empty()) return PairContact{clearContact(one_.link)};
  const bool areMeshes = query.isExact() || query.other->surface != nullptr;
  return areMeshes ? meshContact(query, counters) : backtrack(query, scratch_.candidates, counters);
}

/// Of the triangles of both links, or of the LSS of one that has none.
PairContact SelfQuery::meshContact(const LinkQuery& query, QueryCounters& counters) {
  // A single lane is slower than doubles.
  if (activeSimd() == Simd::Scalar) return backtrack(query, scratch_.candidates, counters);
  PartScratch& parts = scratch_.lanes.parts;
  parts.lanes.reset(begin_, end_);
  return backtrackInLanes(query, scratch_.candidates, parts, counters, this);
}

void SelfQuery::make(PartLanes& lanes, QueryCounters& counters) {
  const ChainNodes& here = nodes(counters);
  const FramePolynomials polynomials = framePolynomialsOf(one_.link, motion_, here);
  lanes.setFrame(polynomials, here.origin());
  lanes.setOther(framePolynomialsOf(other_.link, motion_, here, polynomials.origin));
}

/// At the start the first node has the places, without trigonometry. The contact of the nearest two
/// LSS, in W; nothing if none is within the tolerance.
std::optional<PairContact> SelfQuery::contactAtStart(const LinkQuery& query,
                                                     QueryCounters& counters) {
  std::optional<PairContact> best;
  collect(start_, {}, query.tolerance, scratch_.candidates, counters);
  for (const Candidate& candidate : scratch_.candidates) {
    ++counters.advancements;
    const MovingPair apart =
        movingPair(atFirstNode(one_.link, candidate.lss, candidate.radiusShare),
                   atFirstNode(other_.link, candidate.otherLss, candidate.radiusShare));
    if (apart.gapUpper > query.tolerance) continue;
    const PairContact contact = contactOf(query, candidate, apart, 0.0);
    if (!best || comesFirst(contact, *best)) best = contact;
  }
  if (!best) return best;
  best->toi = best->freeUntil = start_;
  const Eigen::Vector3d& origin = scratch_.lanes.nodes().origin();
  best->p_WScene += origin;
  best->p_WLink += origin;
  return best;
}

/// Relative to the nodes' origin.
MovingHull SelfQuery::atFirstNode(LinkId of, std::int32_t lss, double radiusShare) const {
  const LssTable::Entry& entry = table_[table_.first(of) + lss];
  const LinkNodes& link = scratch_.lanes.nodes().link(of);
  const auto placeOf = [&link](const double* p_L) {
    Eigen::Vector3d p;
    for (int i = 0; i < 3; ++i) {
      p[i] = link.p[i][0] + (link.R[3 * i][0] * p_L[0] + link.R[3 * i + 1][0] * p_L[1] +
                             link.R[3 * i + 2][0] * p_L[2]);
    }
    return p;
  };
  MovingHull hull;
  hull.hull = Hull::segment(placeOf(entry.a), placeOf(entry.b));
  hull.radius = entry.radius * radiusShare;
  hull.positionRounding.fill(
      pointRounding(scratch_.lanes.nodes().bounds(), std::max(entry.rhoA, entry.rhoB)));
  return hull;
}

void SelfQuery::prepareSide(Side& side, LinkId frame, std::vector<AxisBounds>& bounds) {
  side.bounds = motion_.sumsIn(frame, side.link).bounds();
  bounds.clear();
  for (const Lss& lss : plan_.avatar.lss(side.link)) bounds.push_back(axisBounds(lss, side.bounds));
}

LinkParts SelfQuery::partsOf(const Side& side, const std::vector<AxisBounds>& bounds) const {
  return {side.link,   plan_.avatar.lss(side.link), bounds,
          motion_,     plan_.of(side.link).surface, nullptr,
          &side.bounds};
}

Candidate SelfQuery::candidateOf(const LssIndexPair& pair, std::uint8_t pieces) const {
  Candidate candidate;
  candidate.lss = pair.i - table_.first(table_[pair.i].link);
  candidate.otherLss = pair.j - table_.first(table_[pair.j].link);
  candidate.pieces = pieces;
  candidate.freeUntil = begin_;
  candidate.radiusShare = self_.radiusShare(pair.i, pair.j);
  return candidate;
}

/// In W, with both links named.
void SelfQuery::keep(PairContact contact, LinkId frame, StepContacts& step) {
  contact.link = one_.link;
  contact.other = other_.link;
  if (contact.verdict != Verdict::Undecided && frame != kNoParent) {
    const LinkState state = scratch_.evaluator.stateAt(frame, contact.toi);
    contact.p_WScene = state.pointAt(contact.p_WScene);
    contact.p_WLink = state.pointAt(contact.p_WLink);
    contact.nhat_SL_W = state.R_WL * contact.nhat_SL_W;
  }
  step.pairs.push_back(contact);
}

/// All pairs of LSS of the two links whose boxes meet in the current slab.
void SelfQuery::collect(double t, const PosedLink& /*posed*/, double /*reach*/,
                        std::vector<Candidate>& candidates, QueryCounters& /*counters*/) {
  candidates.clear();
  const std::int32_t firstOfOne = table_.first(one_.link), firstOfOther = table_.first(other_.link);
  const auto ofOne = static_cast<std::uint32_t>(table_.first(one_.link + 1) - firstOfOne);
  const auto ofOther = static_cast<std::uint32_t>(table_.first(other_.link + 1) - firstOfOther);
  for (std::size_t k = 0; k < own_.meeting.count; ++k) {
    const LssIndexPair& pair = own_.meeting.pairs[k];
    // One comparison tells both ends of a range.
    if (static_cast<std::uint32_t>(pair.i - firstOfOne) >= ofOne ||
        static_cast<std::uint32_t>(pair.j - firstOfOther) >= ofOther) {
      continue;
    }
    candidates.push_back(candidateOf(pair, kEveryPiece));
    candidates.back().freeUntil = t;
  }
}

}  // namespace foretouch::internal
