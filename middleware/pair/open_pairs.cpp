// Which pairs of LSS PairQuery has to look at: those whose boxes meet, and that planes at the nodes
// do not keep apart throughout a slab.
#include <algorithm>

#include "lss/index.h"
#include "lss/rounding.h"
#include "middleware/pair/pair_query.h"

namespace foretouch::internal {
namespace {

/// Nodes whose closest points propose planes, one after the other, for pairs that are still open:
/// the middle closes most, the ends what meets there.
constexpr int kProposingNodes[] = {3, 0, 7};
/// Past the rounding of a sum, and of the kernel's product with it.
constexpr float kBendInflation = 1.0F + 0x1p-21F;

/// The h^2/8 of a piece, rounded up past h's own rounding.
float sagittaOf(double begin, double end) {
  const double h = end - begin;
  return floatPaddedAbove(h * h / 8.0 * kInflation);
}

}  // namespace

/// Evaluates those of the current slab. Pairs that touch at the start may need none.
void PairQuery::evaluateNodes(QueryCounters& counters) {
  if (isOneChain_) {
    one_.slabs.evaluateNodes(one_.motion, begin_, end_, plan_.origin, counters);
    return;
  }
  one_.slabs.evaluateNodes(one_.motion, begin_, end_, plan_.origin, counters, &other_.motion);
  other_.slabs.evaluateNodes(other_.motion, begin_, end_, plan_.origin, counters, &one_.motion);
}

/// The links' frames at the nodes, and the boxes and ends of all LSS, in the current slab.
void PairQuery::evaluate(QueryCounters& counters) {
  evaluateNodes(counters);
  sweepBoxes();
  turnFrames();
  const std::size_t frames = asked_.frames().size();
  one_.accelerations.assign(countOf(one_.table().size()) * frames, -1.0F);
  other_.accelerations.assign(countOf(other_.table().size()) * frames, -1.0F);
}

void PairQuery::sweepBoxes() {
  const double margin = plan_.largestTolerance();
  if (!plan_.isOfOwnLinks()) {
    SideScratch &one = one_.known, &other = other_.known;
    sweptBoxes(one_.table(), one_.motion, one_.nodes(), margin, one.boxes, &one.ends);
    sweptBoxes(other_.table(), other_.motion, other_.nodes(), margin, other.boxes, &other.ends,
               &one.ends);
    return;
  }
  SlabScratch& slab = one_.slabs.slab();
  if (slab.areBoxesOfNodes) return;
  sweptBoxes(one_.table(), one_.motion, slab.nodes, margin, slab.boxes, &slab.ends);
  slab.areBoxesOfNodes = true;
}

void PairQuery::turnFrames() {
  pair_.frames.resize(asked_.frames().size());
  for (std::size_t i = 0; i < pair_.frames.size(); ++i) {
    const LinkId link = asked_.frames()[i];
    for (std::size_t k = 0; k < 9; ++k) {
      for (std::size_t node = 0; node < kNodes; ++node) {
        pair_.frames[i].R[k][node] = link == kNoParent
                                         ? (k % 4 == 0 ? 1.0F : 0.0F)
                                         : static_cast<float>(one_.nodes().link(link).R[k][node]);
      }
    }
  }
}

const NodeEnds& PairQuery::endsOf(const Moving& side) const {
  return plan_.isOfOwnLinks() ? side.slabs.slab().ends : side.known.ends;
}

/// Collects asked pairs whose boxes meet.
void PairQuery::collectMeetingPairs() {
  MeetingPairs& meeting = pair_.meeting;
  if (plan_.isOfOwnLinks()) return collectMeeting(one_.slabs.boxes(), asked_.asked(), meeting);
  const SweptBoxes &ofOne = one_.known.boxes, &ofOther = other_.known.boxes;
  pair_.boxes.clear();
  BoxRows rows{{}, {}, ofOther.count};
  for (int k = 0; k < 3; ++k) {
    rows.lower[k] = ofOther.lower[k];
    rows.upper[k] = ofOther.upper[k];
  }
  for (std::int32_t i = 0; i < ofOne.count; ++i) {
    pair_.boxes.push_back({i,
                           {ofOne.lower[0][i], ofOne.lower[1][i], ofOne.lower[2][i]},
                           {ofOne.upper[0][i], ofOne.upper[1][i], ofOne.upper[2][i]}});
  }
  collectMeeting(pair_.boxes, rows, meeting);
  const auto end = meeting.pairs.begin() + static_cast<std::ptrdiff_t>(meeting.count);
  const auto last = std::remove_if(meeting.pairs.begin(), end, [this](const LssIndexPair& pair) {
    return !asked_.asked().has(pair.i, pair.j);
  });
  meeting.count = static_cast<std::size_t>(last - meeting.pairs.begin());
}

/// Pairs of LSS that planes do not keep apart throughout the slab.
void PairQuery::collectOpen(QueryCounters& counters) {
  const ChainNodes& nodes = one_.nodes();
  collectMeetingPairs();
  pair_.pairs.clear();
  for (std::size_t k = 0; k < pair_.meeting.count; ++k) addPlanePair(pair_.meeting.pairs[k]);
  NodePlanes planes{endsOf(one_).axes.data(), pair_.frames.data(), {}, endsOf(other_).axes.data()};
  for (int k = 0; k < kNodePieces; ++k) {
    planes.sagittas[k] = sagittaOf(nodes.instant(k), nodes.instant(k + 1));
  }
  for (const int node : kProposingNodes) {
    if (pair_.pairs.empty()) return;
    counters.laneSteps += pair_.pairs.size();
    closeByPlanes(planes, node, pair_.pairs.data(), pair_.pairs.size());
    dropClosed();
    if (node == kProposingNodes[0]) tightenBends();
  }
}

/// In their frames, pairs bend less than in W; that costs too much for those that do not need it.
void PairQuery::tightenBends() {
  for (PlanePair& pair : pair_.pairs) {
    pair.bend =
        (accelerationOf(pair.frame, one_, pair.i) + accelerationOf(pair.frame, other_, pair.j)) *
        kBendInflation;
  }
}

void PairQuery::addPlanePair(const LssIndexPair& pair) {
  const LssTable::Entry &one = one_.table()[pair.i], &other = other_.table()[pair.j];
  const auto i = slotOf(pair.i), j = slotOf(pair.j);
  const NodeEnds &ofOne = endsOf(one_), &ofOther = endsOf(other_);
  const double tolerance =
      std::min(one_.plan.of(one.link).tolerance, other_.plan.of(other.link).tolerance);
  const double extents =
      static_cast<double>(ofOne.extents[i]) + static_cast<double>(ofOther.extents[j]);
  const double roundings =
      static_cast<double>(ofOne.roundings[i]) + static_cast<double>(ofOther.roundings[j]);
  PlanePair open{pair.i, pair.j, asked_.frameOf(one.link, other.link), 0.0F, 0.0F, kEveryPiece};
  // Padding is twice what floats round by, and the kernel's sum rounds by as much again.
  constexpr double kSumInflationOfReach = 1.0 + 0x1p-21;
  const double radii = asked_.radiusShare(pair.i, pair.j) * (one.radius + other.radius);
  open.reach = floatPaddedAbove(
      (radii + kFloorShare * tolerance + kNodePlaneRounding * extents + roundings) *
      kSumInflationOfReach);
  const auto inWorld = [](const Moving& side, const LssTable::Entry& entry) {
    return side.motion.sums(entry.link).accelerationAt(std::max(entry.rhoA, entry.rhoB));
  };
  open.bend = floatPaddedAbove(inWorld(one_, one) + inWorld(other_, other)) * kBendInflation;
  pair_.pairs.push_back(open);
}

/// The acceleration of the LSS' ends in the frame; rounded up. Found when it is first needed.
float PairQuery::accelerationOf(std::int32_t frame, Moving& side, std::int32_t lss) {
  float& known = side.accelerations[slotOf(frame) * countOf(side.table().size()) + slotOf(lss)];
  if (known < 0.0F) {
    const LssTable::Entry& entry = side.table()[lss];
    const ChainSums sums = side.motion.sumsIn(asked_.frames()[slotOf(frame)], entry.link);
    known = floatPaddedAbove(sums.accelerationAt(std::max(entry.rhoA, entry.rhoB)));
  }
  return known;
}

void PairQuery::dropClosed() {
  pair_.pairs.erase(std::remove_if(pair_.pairs.begin(), pair_.pairs.end(),
                                   [](const PlanePair& pair) { return pair.open == 0; }),
                    pair_.pairs.end());
}

}  // namespace foretouch::internal
