#include "middleware/solid/joint_ranges.h"

#include <algorithm>
#include <cmath>

#include "lss/index.h"

namespace foretouch::internal {
namespace {

constexpr double kRightAngle = 1.57079632679489662;
/// A turn counts as what it moves that is so far from the joint (m).
constexpr double kRangeLever = 0.2;
/// No coordinate is as large: the range has no end there.
constexpr double kNever = 2.0;

/// That one of a turn's two quaternions that goes the shorter way around.
Eigen::Quaterniond shorter(Eigen::Quaterniond turn) {
  if (turn.w() < 0.0) turn.coeffs() = -turn.coeffs();
  return turn;
}

/// The coordinate, a sine of half an angle, of the angle that is `by` farther.
double farther(double coordinate, double by) {
  const double half = std::asin(std::clamp(coordinate, -1.0, 1.0)) + 0.5 * by;
  if (std::abs(half) >= kRightAngle) return std::copysign(kNever, half);
  return std::sin(half);
}

/// The two ends of three coordinates: what of a row says which it is of.
constexpr int kEnds = 6;

}  // namespace

JointRanges::JointRanges(const Skeleton& skeleton)
    : parents_(skeleton.parents()), ranges_(parents_.size()) {}

void JointRanges::forget() {
  for (Range& range : ranges_) range.isAny = false;
}

void JointRanges::learn(const Pose& tracked, const std::vector<std::uint8_t>& isLost) {
  for (std::size_t j = 0; j < ranges_.size(); ++j) {
    if (parents_[j] == kNoParent || isLost[j] != 0) continue;
    Range& range = ranges_[j];
    const Eigen::Quaterniond turn(tracked.rotations[j]);
    if (!range.isAny) {
      range.isAny = true;
      range.first = turn;
      range.least = range.most = Eigen::Vector3d::Zero();
      widen(range);
      continue;
    }
    const Eigen::Vector3d seen = shorter(range.first.conjugate() * turn).vec();
    const bool isKnown =
        (seen.array() >= range.least.array()).all() && (seen.array() <= range.most.array()).all();
    if (isKnown) continue;
    range.least = range.least.cwiseMin(seen);
    range.most = range.most.cwiseMax(seen);
    widen(range);
  }
}

void JointRanges::widen(Range& range) {
  for (int i = 0; i < 3; ++i) {
    range.lowest[i] = farther(range.least[i], -kMargin);
    range.highest[i] = farther(range.most[i], kMargin);
  }
}

Eigen::Quaterniond JointRanges::turnOf(std::size_t joint,
                                       const std::vector<LinkState>& states) const {
  const Eigen::Matrix3d turn =
      states[slotOf(parents_[joint])].R_WL.transpose() * states[joint].R_WL;
  return shorter(ranges_[joint].first.conjugate() * Eigen::Quaterniond(turn));
}

void JointRanges::append(const std::vector<LinkState>& states, double reach,
                         std::vector<ContactRow>& rows) const {
  for (std::size_t j = 0; j < ranges_.size(); ++j) {
    const Range& range = ranges_[j];
    if (!range.isAny) continue;
    const Eigen::Quaterniond turn = turnOf(j, states);
    for (int end = 0; end < kEnds; ++end) {
      const int i = end / 2;
      const bool isHigh = end % 2 == 1;
      const double left =
          isHigh ? range.highest[i] - turn.vec()[i] : turn.vec()[i] - range.lowest[i];
      if (2.0 * left > reach) continue;
      ContactRow row;
      row.link = static_cast<LinkId>(j);
      row.other = parents_[j];
      row.otherLss = end;
      row.isTurn = row.isSoft = true;
      const Eigen::Vector3d axis = Eigen::Vector3d::Unit(i);
      const Eigen::Vector3d slope = turn.w() * axis + turn.vec().cross(axis);
      row.n = (isHigh ? -kRangeLever : kRangeLever) *
              (states[slotOf(row.other)].R_WL * (range.first * slope)).eval();
      row.gap = 2.0 * kRangeLever * left;
      rows.push_back(row);
    }
  }
}

double JointRanges::gapAt(const std::vector<LinkState>& states, const ContactRow& row) const {
  const Range& range = ranges_[slotOf(row.link)];
  const int i = row.otherLss / 2;
  const double at = turnOf(slotOf(row.link), states).vec()[i];
  return 2.0 * kRangeLever * (row.otherLss % 2 == 1 ? range.highest[i] - at : at - range.lowest[i]);
}

}  // namespace foretouch::internal
