#include "middleware/world/bodies_apart.h"

#include <algorithm>

#include "lss/index.h"
#include "lss/rounding.h"

namespace foretouch::internal {
namespace {

/// Nodes whose closest points propose planes, one after the other: where most are closed, first.
constexpr int kNodesOfPlanes[] = {3, 0, 7};
/// Past the rounding of a sum in double, and of the kernel's product or sum with it in float.
constexpr double kReachInflation = 1.0 + 0x1p-21;

/// The frame W, in which planes rest.
NodeFrame worldFrame() {
  NodeFrame frame;
  for (int k = 0; k < 9; ++k) std::fill_n(frame.R[k], kNodes, k % 4 == 0 ? 1.0F : 0.0F);
  return frame;
}
const NodeFrame kWorldFrame = worldFrame();

/// The h^2/8 of the pieces between two nodes of a whole motion, rounded up.
struct Sagittas {
  float at[kNodes] = {};
  Sagittas() {
    for (int k = 0; k + 1 < kNodes; ++k) {
      const double h = ChainNodes::time(k + 1) - ChainNodes::time(k);
      at[k] = floatPaddedAbove(h * h / 8.0 * kInflation);
    }
  }
};
const Sagittas kSagittas;

/// Origin of the ends, in W.
Eigen::Vector3d originOfEnds(const SpanSweep& span) {
  return span.origin +
         Eigen::Vector3d(span.ends.origin[0], span.ends.origin[1], span.ends.origin[2]);
}

/// The fewest nodes of the span that have both instants between them.
NodeRange nodesAround(const SpanSweep& span, std::int64_t fromUs, std::int64_t toUs) {
  // Microseconds; nodes are within 1e-3 of it where their times say (ChainNodes::instant()).
  constexpr double kOff = 1e-3;
  const auto length = static_cast<double>(span.endUs - span.beginUs);
  const auto from = static_cast<double>(fromUs - span.beginUs),
             to = static_cast<double>(toUs - span.beginUs);
  NodeRange range;
  while (range.first + 1 < kNodes && length * ChainNodes::time(range.first + 1) <= from - kOff) {
    ++range.first;
  }
  while (range.last > 0 && length * ChainNodes::time(range.last - 1) >= to + kOff) --range.last;
  return range;
}

}  // namespace

Apart BodiesApart::prove(const SpanSweep& one, const SpanSweep& other, std::int64_t fromUs,
                         std::int64_t toUs, double floor, QueryCounters& counters) {
  collect(one, other);
  if (meeting_.count == 0) return Apart::ByBoxes;
  addPairs(one, other, floor);
  const bool isSameSpan = one.beginUs == other.beginUs && one.endUs == other.endUs;
  isSameSpan ? closeAtNodes(one, other, counters) : closeAtRest(one, other, fromUs, toUs, counters);
  return pairs_.empty() ? Apart::ByPlanes : Apart::Unproven;
}

/// As BodyBox::movedBy(), for all LSS at once.
void BodiesApart::moveRows(const SpanSweep& one, const Eigen::Vector3d& shift) {
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t count = one.lower[k].size();
    lower_[k].resize(count);
    upper_[k].resize(count);
    const double by = shift[static_cast<Eigen::Index>(k)];
    const float *const lower = one.lower[k].data(), *const upper = one.upper[k].data();
    float *const movedLower = lower_[k].data(), *const movedUpper = upper_[k].data();
    for (std::size_t i = 0; i < count; ++i) {
      const MovedBounds moved = movedBounds(lower[i], upper[i], by);
      movedLower[i] = moved.lower;
      movedUpper[i] = moved.upper;
    }
  }
}

/// Pairs of LSS whose boxes meet.
void BodiesApart::collect(const SpanSweep& one, const SpanSweep& other) {
  const Eigen::Vector3d shift = one.origin - other.origin;
  boxes_.clear();
  meeting_.count = 0;
  if (!one.box.movedBy(shift).meets(other.box)) return;
  moveRows(one, shift);
  for (std::int32_t i = 0; i < one.numLss; ++i) {
    LssBox box{i, {}, {}};
    bool meets = true;
    for (std::size_t k = 0; k < 3; ++k) {
      box.lower[k] = lower_[k][slotOf(i)];
      box.upper[k] = upper_[k][slotOf(i)];
      meets = meets && box.lower[k] <= other.box.upper[k] && other.box.lower[k] <= box.upper[k];
    }
    if (meets) boxes_.push_back(box);
  }
  if (boxes_.empty()) return;
  const BoxRows rows{{other.lower[0].data(), other.lower[1].data(), other.lower[2].data()},
                     {other.upper[0].data(), other.upper[1].data(), other.upper[2].data()},
                     other.numLss};
  collectMeeting(boxes_, rows, meeting_);
}

void BodiesApart::addPairs(const SpanSweep& one, const SpanSweep& other, double floor) {
  const Eigen::Vector3d from = originOfEnds(one), to = originOfEnds(other);
  planes_.axes = one.ends.axes.data();
  planes_.others = other.ends.axes.data();
  planes_.frames = &kWorldFrame;
  std::copy_n(kSagittas.at, kNodes, planes_.sagittas);
  double shifted = 0.0;
  for (int k = 0; k < 3; ++k) {
    planes_.shift[k] = static_cast<float>(to[k] - from[k]);
    // In double, the origins and their difference round by a few units.
    shifted += kNodePlaneRounding * std::abs(to[k] - from[k]) +
               8.0 * kUnitRoundoff * (std::abs(to[k]) + std::abs(from[k]));
  }
  pairs_.clear();
  for (std::size_t k = 0; k < meeting_.count; ++k) {
    const auto i = slotOf(meeting_.pairs[k].i), j = slotOf(meeting_.pairs[k].j);
    const double reach = static_cast<double>(one.reaches[i]) +
                         static_cast<double>(other.reaches[j]) + floor + shifted;
    PlanePair pair{meeting_.pairs[k].i, meeting_.pairs[k].j, 0, 0.0F, 0.0F, kEveryPiece};
    pair.reach = floatPaddedAbove(reach * kReachInflation);
    pair.bend =
        floatPaddedAbove((static_cast<double>(one.bends[i]) + static_cast<double>(other.bends[j])) *
                         kReachInflation);
    pairs_.push_back(pair);
  }
}

/// Both have their nodes at the same instants.
void BodiesApart::closeAtNodes(const SpanSweep&, const SpanSweep&, QueryCounters& counters) {
  for (const int node : kNodesOfPlanes) {
    if (pairs_.empty()) return;
    counters.laneSteps += pairs_.size();
    closeByPlanes(planes_, node, pairs_.data(), pairs_.size());
    dropClosed();
  }
}

/// Each has nodes of its own.
void BodiesApart::closeAtRest(const SpanSweep& one, const SpanSweep& other, std::int64_t fromUs,
                              std::int64_t toUs, QueryCounters& counters) {
  planes_.nodes = nodesAround(one, fromUs, toUs);
  planes_.otherNodes = nodesAround(other, fromUs, toUs);

  for (PlanePair& pair : pairs_) {
    const double bend =
        static_cast<double>(one.bends[slotOf(pair.i)]) * static_cast<double>(one.widestSagitta) +
        static_cast<double>(other.bends[slotOf(pair.j)]) * static_cast<double>(other.widestSagitta);
    pair.reach = floatPaddedAbove((static_cast<double>(pair.reach) + bend) * kReachInflation);
  }
  const NodeRange &own = planes_.nodes, &others = planes_.otherNodes;
  const int proposing[3][2] = {{(own.first + own.last) / 2, (others.first + others.last + 1) / 2},
                               {own.first, others.last},
                               {own.last, others.first}};
  for (const auto& nodes : proposing) {
    if (pairs_.empty()) return;
    counters.laneSteps += pairs_.size();
    closeByRestingPlanes(planes_, nodes[0], nodes[1], pairs_.data(), pairs_.size());
    dropClosed();
  }
}

void BodiesApart::dropClosed() {
  pairs_.erase(std::remove_if(pairs_.begin(), pairs_.end(),
                              [](const PlanePair& pair) { return pair.open == 0; }),
               pairs_.end());
}

}  // namespace foretouch::internal
