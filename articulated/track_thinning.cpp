// Lets go of knots that hardly matter. Proof: articulated/track.md 3.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "articulated/track.h"
#include "lss/index.h"
#include "lss/rounding.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using Eigen::Vector4d;

/// The rounding of a computed difference of two quaternions on their arcs, and of two translations,
/// per metre of the arm (track.md 3).
constexpr double kOffTurn = 256.0 * kUnitRoundoff, kOffShift = 16.0 * kUnitRoundoff;
/// Half turns (rad) below which an arc and its chord are the same to some roundoffs.
constexpr double kFlatArc = 1e-7;
/// No two unit quaternions are farther apart.
constexpr double kMostApart = 2.0;
/// Dropped: no motion begins here.
constexpr double kDropped = -1.0;

/// Summed in the order of the motion's definition (motion.h).
double dot(const Vector4d& a, const Vector4d& b) {
  return a.w() * b.w() + a.x() * b.x() + a.y() * b.y() + a.z() * b.z();
}

/// The angle between two unit quaternions at most a right angle apart: half the turn.
double halfTurn(const Vector4d& from, const Vector4d& to) {
  return 2.0 * std::asin(std::min(1.0, 0.5 * (to - from).norm()));
}

/// The quaternion at `t` on the arc between two that are `half` apart.
Vector4d onArc(const Vector4d& from, const Vector4d& to, double half, double t) {
  if (half < kFlatArc) return from + t * (to - from);
  return (std::sin((1.0 - t) * half) * from + std::sin(t * half) * to) / std::sin(half);
}

/// How far one joint is off, at any instant, if what is between two knots is dropped.
struct JointOff {
  double turn = 0.0;   ///< No point at distance 1 from the joint is farther away for it.
  double shift = 0.0;  ///< How far off its translation is (m).
  double arm = 0.0;    ///< No translation is longer (m).
};

template <typename KnotAt>
JointOff offOf(const KnotAt& knot, std::size_t joint, std::size_t from, std::size_t to) {
  const auto &first = knot(from), &last = knot(to);
  const auto lengthUs = static_cast<double>(last.utimeUs - first.utimeUs);
  const Vector4d begin = first.pose.rotations[joint].coeffs();
  const Vector4d given = last.pose.rotations[joint].coeffs();
  const Vector4d end = dot(begin, given) < 0.0 ? Vector4d(-given) : given;
  const double half = halfTurn(begin, end);
  const Vector3d& start = first.pose.translations[joint];
  const Vector3d drift = last.pose.translations[joint] - start;
  JointOff off{0.0, 0.0, start.norm()};
  Vector4d before = begin;
  double offBefore = 0.0, atBefore = 0.0;
  for (std::size_t i = from + 1; i <= to; ++i) {
    const auto& next = knot(i);
    const double at = static_cast<double>(next.utimeUs - first.utimeUs) / lengthUs;
    Vector4d here = next.pose.rotations[joint].coeffs();
    const double side = dot(before, here);
    if (side == 0.0) off.turn = kMostApart;  // either way round
    if (side < 0.0) here = -here;
    const double offHere = (here - onArc(begin, end, half, at)).norm();
    const double own = halfTurn(before, here), thin = half * (at - atBefore);
    const double bend = 0.125 * std::abs(own * own - thin * thin);
    off.turn =
        std::max(off.turn, (std::max(offBefore, offHere) + bend) / (1.0 - 0.125 * own * own));
    const Vector3d& translation = next.pose.translations[joint];
    off.shift = std::max(off.shift, (translation - (start + at * drift)).norm());
    off.arm = std::max(off.arm, translation.norm());
    before = here;
    offBefore = offHere;
    atBefore = at;
  }
  off.turn = 2.0 * (off.turn + kOffTurn);
  off.shift += kOffShift * off.arm;
  return off;
}

}  // namespace

/// How far any point moves, at most, if the knots between the two are dropped; infinite if that may
/// be more than `most`.
double Track::movedWithout(std::size_t from, std::size_t to, const std::vector<double>& reach,
                           double most) const {
  const auto knotAt = [this](std::size_t i) -> const Knot& { return knot(i); };
  std::vector<double> turn(reach.size()), shift(reach.size());
  double worst = 0.0;
  for (std::size_t joint = 0; joint < reach.size(); ++joint) {
    const JointOff off = offOf(knotAt, joint, from, to);
    const JointId parent = skeleton_.parents()[joint];
    turn[joint] = off.turn;
    shift[joint] = off.shift;
    if (parent != kNoParent) {
      turn[joint] += turn[slotOf(parent)];
      shift[joint] += shift[slotOf(parent)] + turn[slotOf(parent)] * off.arm;
    }
    worst = std::max(worst, (shift[joint] + turn[joint] * reach[joint]) * internal::kInflation);
    if (!(worst <= most)) return std::numeric_limits<double>::infinity();
  }
  return worst;
}

/// The last knot, up to `last`, before which all after `from` may be dropped; doubles, then halves.
/// `movedBy`: how far points then are from where all knots had them.
std::size_t Track::farthestFrom(std::size_t from, std::size_t last,
                                const std::vector<double>& reach, double metres,
                                double& movedBy) const {
  movedBy = knot(from).movedBy;
  std::size_t best = from + 1;
  const auto mayEndAt = [&](std::size_t to) {
    double before = 0.0;
    for (std::size_t i = from; i < to; ++i) before = std::max(before, knot(i).movedBy);
    if (knot(to).utimeUs - knot(from).utimeUs > kLongestPieceUs || before > metres) return false;
    const double moved =
        (before + movedWithout(from, to, reach, metres - before)) * internal::kInflation;
    if (!(moved <= metres)) return false;
    movedBy = moved;
    best = to;
    return true;
  };
  std::size_t bad = from + 2;
  while (bad <= last && mayEndAt(bad)) bad = from + 2 * (bad - from);
  bad = std::min(bad, last + 1);
  while (bad - best > 1) {
    const std::size_t middle = best + (bad - best) / 2;
    if (!mayEndAt(middle)) bad = middle;
  }
  return best;
}

void Track::thinBefore(std::int64_t utimeUs, const std::vector<double>& reach, double metres) {
  FORETOUCH_ASSERT(reach.size() == countOf(skeleton_.numJoints()));
  const std::size_t until = countUntil(utimeUs);
  const std::size_t tried = metres > thinnedBy_ ? 0 : countUntil(thinnedUs_);
  const std::size_t first = tried == 0 ? 0 : tried - 1;
  if (until < first + 3) return;
  thinnedBy_ = metres;
  const auto place = [this](std::size_t i) -> Knot& { return ring_[(first_ + i) % ring_.size()]; };
  for (std::size_t from = first; from < until - 1;) {
    thinnedUs_ = knot(from).utimeUs;
    double movedBy = 0.0;
    const std::size_t to = farthestFrom(from, until - 1, reach, metres, movedBy);
    place(from).movedBy = movedBy;
    for (std::size_t i = from + 1; i < to; ++i) place(i).movedBy = kDropped;
    from = to;
  }
  // Those that are dropped end up behind the last one, where the next poses take their memory.
  std::size_t kept = first;
  for (std::size_t i = first; i < count_; ++i) {
    if (place(i).movedBy == kDropped) continue;
    if (kept != i) std::swap(place(kept), place(i));
    ++kept;
  }
  count_ = kept;
}

}  // namespace foretouch
