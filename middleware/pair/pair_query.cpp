#include "middleware/pair/pair_query.h"

#include <algorithm>
#include <limits>

#include "lss/index.h"
#include "lss/rounding.h"
#include "lss/simd.h"
#include "middleware/pair/backtracking.h"
#include "middleware/pair/lane_cull.h"
#include "middleware/pair/leaving.h"
#include "tessellation/point_rounding.h"

namespace foretouch::internal {
namespace {

/// The nodes are relative to the scene's middle. Where that is so far away that their places lose
/// more than this (m), a contact's points are found from the links' own states. The bound grows
/// with the chain: forty joints on end are at 2e-11 before they are anywhere.
constexpr double kStartRounding = 1e-10;

bool comesBefore(const PairContact& x, const PairContact& y) {
  if (isReportedBefore(x, y)) return true;
  return !isReportedBefore(y, x) && x.other < y.other;
}

}  // namespace

PairQuery::PairQuery(const PairPlan& plan, const PairMotions& motions, const WorkMeter& meter,
                     QueryMemory& scratch)
    : plan_(plan),
      asked_(plan.asked),
      meter_(meter),
      scratch_(scratch),
      pair_(scratch.pair),
      isOneChain_(&motions.one == &motions.other),
      one_{plan.one,
           motions.one,
           scratch.evaluator,
           scratch.lanes,
           scratch.pair.one,
           scratch.pair.one.accelerations,
           0,
           {}},
      other_{plan.other,
             motions.other,
             isOneChain_ ? scratch.evaluator : scratch.otherEvaluator,
             isOneChain_ ? static_cast<SlabCache&>(scratch.lanes) : scratch.otherSlabs,
             scratch.pair.other,
             (plan.isOfOwnLinks() ? scratch.pair.one : scratch.pair.other).accelerations,
             0,
             {}} {}

/// Into how many slabs the side that needs more of them is cut.
int PairQuery::numSlabs() const {
  const double tolerance = plan_.leastTolerance();
  const int slabs = slabsOf(one_.table(), one_.motion, tolerance);
  if (plan_.isOfOwnLinks()) return slabs;
  return std::max(slabs, slabsOf(other_.table(), other_.motion, tolerance));
}

void PairQuery::run(StepContacts& step) {
  const int slabs = numSlabs();
  pair_.left.clear();
  for (int slab = 0; slab < slabs; ++slab) {
    begin_ = static_cast<double>(slab) / slabs;
    end_ = static_cast<double>(slab + 1) / slabs;
    evaluate(step.counters);
    collectOpen(step.counters);
    answerPairs(step);
  }
  finish(step);
}

void PairQuery::runAmong(const FoundPairs& found, StepContacts& step) {
  stopsWhenSpent_ = meter_.isLimited();
  // Curves need the slabs.
  if (numSlabs() != 1) return run(step);
  pair_.left.clear();
  take(found);
  answerPairs(step);
  finish(step);
}

bool PairQuery::runAmongFrom(double begin, const FoundPairs& found, StepContacts& step) {
  if (numSlabs() != 1) return false;
  start_ = begin_ = begin;
  if (!areNodesFine(step.counters)) return false;
  pair_.left.clear();
  take(found);
  answerPairs(step);
  finish(step);
  return true;
}

/// Whether the first node has the places at the start well enough to decide what touches there.
bool PairQuery::areNodesFine(QueryCounters& counters) {
  evaluateNodes(counters);
  return pointRounding(one_.nodes().bounds(), 0.0) <= kStartRounding;
}

void PairQuery::take(const FoundPairs& found) {
  const AskedPairs& asked = asked_.asked();
  MeetingPairs& meeting = pair_.meeting;
  if (meeting.pairs.size() < found.numMeeting) meeting.pairs.resize(found.numMeeting);
  meeting.count = 0;
  for (std::size_t k = 0; k < found.numMeeting; ++k) {
    const LssIndexPair& pair = found.meeting[k];
    if (asked.has(pair.i, pair.j)) meeting.pairs[meeting.count++] = pair;
  }
  pair_.pairs.clear();
  for (std::size_t k = 0; k < found.numOpen; ++k) {
    PlanePair pair = found.open[k];
    if (!asked.has(pair.i, pair.j)) continue;
    pair.frame = asked_.frameOf(one_.linkOf(pair.i), other_.linkOf(pair.j));
    pair_.pairs.push_back(pair);
  }
}

void PairQuery::finish(StepContacts& step) const {
  std::sort(step.pairs.begin(), step.pairs.end(), comesBefore);
  step.arePairsAnswered = true;
  double least = plan_.leastTolerance();
  for (const LeftPair& pair : pair_.left) least = std::min(least, pair.tolerance);
  step.provenClearance = std::min(step.provenClearance, kFloorShare * least);
}

/// Answers by pairs of links; those that have an answer from an earlier slab keep it.
void PairQuery::answerPairs(StepContacts& step) {
  std::vector<PlanePair>& pairs = pair_.pairs;
  const auto linksOf = [this](const PlanePair& pair) {
    return std::make_tuple(one_.linkOf(pair.i), other_.linkOf(pair.j));
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

void PairQuery::answerPair(std::size_t first, std::size_t count, StepContacts& step) {
  const PlanePair* const pairs = pair_.pairs.data() + first;
  const LinkId frame = asked_.frames()[slotOf(pairs->frame)];
  one_.link = one_.linkOf(pairs->i);
  other_.link = other_.linkOf(pairs->j);
  if (stopsWhenSpent_ && meter_.isSpent(step.counters)) {
    const auto undone = undecidedContact(one_.link, begin_, UndecidedReason::WorkBudget);
    return keep(PairContact{undone}, kNoParent, step);
  }
  double times[kNodes];
  for (int k = 0; k < kNodes; ++k) {
    times[k] = k + 1 == kNodes ? end_ : begin_ + (end_ - begin_) * ChainNodes::time(k);
  }
  const Side other = sideOf(other_, frame);
  LinkQuery query{sideOf(one_, frame), &other, nullptr, Pieces{kNodePieces, times, end_},
                  tolerance(),         meter_, nullptr, *this};
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
  bound(one_, frame);
  bound(other_, frame);
  PairContact contact = contactFrom(query, pairs, count, step.counters);
  if (mayLeave(query, contact, step.counters)) {
    contact = contactFrom(query, pairs, count, step.counters);
  }
  if (contact.verdict != Verdict::Clear) keep(contact, frame, step);
}

/// The pair at hand, as one that has left; null if it has not.
const LeftPair* PairQuery::leftPair() const {
  const auto found = std::find_if(
      pair_.left.begin(), pair_.left.end(),
      [this](const LeftPair& pair) { return pair.link == one_.link && pair.other == other_.link; });
  return found != pair_.left.end() ? &*found : nullptr;
}

/// The pair's tolerance: the smaller one of both links, unless they began within it and left.
double PairQuery::tolerance() const {
  const LeftPair* const left = leftPair();
  return left != nullptr
             ? left->tolerance
             : std::min(one_.plan.of(one_.link).tolerance, other_.plan.of(other_.link).tolerance);
}

/// Whether the pair began within its tolerance, and goes on with another one.
bool PairQuery::mayLeave(LinkQuery& query, const PairContact& contact, QueryCounters& counters) {
  if (plan_.startShare == 0.0 || contact.verdict != Verdict::Contact) return false;
  if (leftPair() != nullptr) return false;
  const double separation =
      contact.toi == 0.0 ? contact.separation : startSeparation(query, counters);
  const double own = leavingTolerance(separation, query.tolerance, plan_.startShare);
  if (!(own > 0.0)) return false;
  pair_.left.push_back({one_.link, other_.link, own});
  query.tolerance = own;
  return true;
}

/// The separation of the links' LSS at t = 0: planes may have closed the piece that begins there.
double PairQuery::startSeparation(const LinkQuery& query, QueryCounters& counters) {
  StateCache states(query, counters);
  double least = std::numeric_limits<double>::infinity();
  const LssTable &ones = one_.table(), &others = other_.table();
  for (std::int32_t i = ones.first(one_.link); i < ones.first(one_.link + 1); ++i) {
    for (std::int32_t j = others.first(other_.link); j < others.first(other_.link + 1); ++j) {
      if (!asked_.asked().has(i, j)) continue;
      const Candidate candidate = candidateOf({i, j}, kEveryPiece);
      least = std::min(least, pairOf(query, candidate, states.at(0.0), counters).estimate());
    }
  }
  return least;
}

/// The contact in the query's frame.
PairContact PairQuery::contactFrom(const LinkQuery& query, const PlanePair* pairs,
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

/// The contact of the triangles of both links, or of the LSS of one that has none.
PairContact PairQuery::meshContact(const LinkQuery& query, QueryCounters& counters) {
  // A single lane is slower than doubles.
  if (activeSimd() == Simd::Scalar) return backtrack(query, scratch_.candidates, counters);
  PartScratch& parts = scratch_.lanes.parts;
  parts.lanes.reset(begin_, end_);
  return backtrackInLanes(query, scratch_.candidates, parts, counters, this);
}

void PairQuery::make(PartLanes& lanes, QueryCounters& counters) {
  evaluateNodes(counters);
  const FramePolynomials polynomials = framePolynomialsOf(one_.link, one_.motion, one_.nodes());
  lanes.setFrame(polynomials, one_.nodes().origin());
  lanes.setOther(
      framePolynomialsOf(other_.link, other_.motion, other_.nodes(), polynomials.origin));
}

/// At the start the first node has the places, without trigonometry. The contact of the nearest two
/// LSS, in W; nothing if none is within the tolerance.
std::optional<PairContact> PairQuery::contactAtStart(const LinkQuery& query,
                                                     QueryCounters& counters) {
  std::optional<PairContact> best;
  collect(start_, {}, query.tolerance, scratch_.candidates, counters);
  for (const Candidate& candidate : scratch_.candidates) {
    ++counters.advancements;
    const MovingPair apart =
        movingPair(atFirstNode(one_, candidate.lss, candidate.radiusShare),
                   atFirstNode(other_, candidate.otherLss, candidate.radiusShare));
    if (apart.gapUpper > query.tolerance) continue;
    const PairContact contact = contactOf(query, candidate, apart, 0.0);
    if (!best || comesFirst(contact, *best)) best = contact;
  }
  if (!best) return best;
  best->toi = best->freeUntil = start_;
  const Eigen::Vector3d& origin = one_.nodes().origin();
  best->p_WScene += origin;
  best->p_WLink += origin;
  return best;
}

/// Relative to the nodes' origin.
MovingHull PairQuery::atFirstNode(const Moving& side, std::int32_t lss, double radiusShare) {
  const LssTable::Entry& entry = side.table()[side.table().first(side.link) + lss];
  const LinkNodes& link = side.nodes().link(side.link);
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
      pointRounding(side.nodes().bounds(), std::max(entry.rhoA, entry.rhoB)));
  return hull;
}

void PairQuery::bound(Moving& side, LinkId frame) {
  side.bounds = side.motion.sumsIn(frame, side.link).bounds();
  side.known.bounds.clear();
  for (const Lss& lss : side.plan.avatar.lss(side.link)) {
    side.known.bounds.push_back(axisBounds(lss, side.bounds));
  }
}

Side PairQuery::sideOf(const Moving& moving, LinkId frame) {
  return {moving.link,
          moving.plan.avatar.lss(moving.link),
          moving.known.bounds,
          moving.evaluator,
          moving.plan.of(moving.link).surface,
          nullptr,
          frame,
          &moving.bounds};
}

Candidate PairQuery::candidateOf(const LssIndexPair& pair, std::uint8_t pieces) const {
  Candidate candidate;
  candidate.lss = pair.i - one_.table().first(one_.linkOf(pair.i));
  candidate.otherLss = pair.j - other_.table().first(other_.linkOf(pair.j));
  candidate.pieces = pieces;
  candidate.freeUntil = begin_;
  candidate.radiusShare = asked_.radiusShare(pair.i, pair.j);
  return candidate;
}

/// Keeps it in W, with both links named.
void PairQuery::keep(PairContact contact, LinkId frame, StepContacts& step) {
  contact.link = one_.link;
  contact.other = other_.link;
  if (contact.verdict != Verdict::Undecided && frame != kNoParent) {
    const LinkState state = one_.evaluator.stateAt(frame, contact.toi);
    contact.p_WScene = state.pointAt(contact.p_WScene);
    contact.p_WLink = state.pointAt(contact.p_WLink);
    contact.nhat_SL_W = state.R_WL * contact.nhat_SL_W;
  }
  step.pairs.push_back(contact);
}

/// All pairs of LSS of the two links whose boxes meet in the current slab.
void PairQuery::collect(double t, const PosedLink& /*posed*/, double /*reach*/,
                        std::vector<Candidate>& candidates, QueryCounters& /*counters*/) {
  candidates.clear();
  const LssTable &ones = one_.table(), &others = other_.table();
  const std::int32_t firstOfOne = ones.first(one_.link), firstOfOther = others.first(other_.link);
  const auto ofOne = static_cast<std::uint32_t>(ones.first(one_.link + 1) - firstOfOne);
  const auto ofOther = static_cast<std::uint32_t>(others.first(other_.link + 1) - firstOfOther);
  for (std::size_t k = 0; k < pair_.meeting.count; ++k) {
    const LssIndexPair& pair = pair_.meeting.pairs[k];
    // One comparison checks both ends of a range.
    if (static_cast<std::uint32_t>(pair.i - firstOfOne) >= ofOne ||
        static_cast<std::uint32_t>(pair.j - firstOfOther) >= ofOther) {
      continue;
    }
    candidates.push_back(candidateOf(pair, kEveryPiece));
    candidates.back().freeUntil = t;
  }
}

}  // namespace foretouch::internal
