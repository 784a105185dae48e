#include "articulated/track.h"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "articulated/chain_nodes.h"
#include "articulated/try.h"
#include "lss/assert.h"
#include "lss/index.h"
#include "lss/rounding.h"

namespace foretouch {
namespace {

constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();

/// The rounding of a joint's rotation in a part of a motion (articulated/track.md 2).
constexpr double kTurnOfPart = 4096.0 * kUnitRoundoff;
/// That of a joint's translation there and of the arms' sums, and that of the instants.
constexpr double kShiftOfPart = 8.0 * kUnitRoundoff, kInstantOfPart = 4.0 * kUnitRoundoff;

std::string microseconds(std::int64_t utimeUs) {
  return std::to_string(utimeUs) + " us";
}

bool isWhole(const TrackPiece& piece, std::int64_t beginUs, std::int64_t endUs) {
  return beginUs == piece.beginUs && endUs == piece.endUs;
}

}  // namespace

const char* toString(WhenSilent whenSilent) {
  switch (whenSilent) {
    case WhenSilent::Wait: return "wait";
    case WhenSilent::HoldStill: return "hold-still";
    case WhenSilent::Undecided: return "undecided";
  }
  return "?";
}

double TrackPiece::at(std::int64_t utimeUs) const {
  FORETOUCH_ASSERT(utimeUs >= beginUs && utimeUs <= endUs);
  if (utimeUs == endUs) return 1.0;
  return static_cast<double>(utimeUs - beginUs) / static_cast<double>(endUs - beginUs);
}

Result<Done> Track::checkedInstant(std::int64_t utimeUs) const {
  const auto refused = [](ErrorCode code, std::string message) {
    return Error::in("utime", code, std::move(message));
  };
  if (utimeUs < -kMostUtimeUs || utimeUs > kMostUtimeUs) {
    return refused(ErrorCode::OutOfRange, "expected an instant within " +
                                              microseconds(kMostUtimeUs) + " of zero, found " +
                                              microseconds(utimeUs));
  }
  if (utimeUs <= forgottenUs_) {
    return refused(ErrorCode::OutOfRange, "a knot at " + microseconds(utimeUs) +
                                              " is in the past; all before " +
                                              microseconds(forgottenUs_) + " is forgotten");
  }
  if (count_ == 0) return Done{};
  const std::int64_t last = knownUntilUs();
  if (utimeUs <= last) {
    Error error = refused(ErrorCode::OutOfRange, "expected a knot after the last one, at " +
                                                     microseconds(last) + ", found one at " +
                                                     microseconds(utimeUs));
    error.index = static_cast<std::int64_t>(count_) - 1;
    return error;
  }
  if (utimeUs - last > kLongestPieceUs) {
    return refused(ErrorCode::LimitExceeded, "expected a knot at most " +
                                                 microseconds(kLongestPieceUs) +
                                                 " after the last one, at " + microseconds(last) +
                                                 ", found one at " + microseconds(utimeUs));
  }
  return Done{};
}

Result<Done> Track::push(std::int64_t utimeUs, const Pose& pose) {
  FORETOUCH_CHECK(checkedInstant(utimeUs));
  if (count_ == kMaxKnots) {
    return Error::in("utime", ErrorCode::LimitExceeded,
                     "expected at most " + std::to_string(kMaxKnots) +
                         " knots at a time; forget those that are answered");
  }
  if (count_ == ring_.size()) grow();
  Knot& next = ring_[(first_ + count_) % ring_.size()];
  // Where each pose that comes lets go of one, as in a world that remembers a second, the ring's
  // other half needs no memory.
  Knot& before = ring_[(first_ + ring_.size() - 1) % ring_.size()];
  if (next.pose.rotations.empty() && &before != &next) std::swap(next.pose, before.pose);
  next.utimeUs = utimeUs;
  next.pose = pose;
  next.movedBy = 0.0;
  FORETOUCH_CHECK(validate(skeleton_, next.pose));
  ++count_;
  return Done{};
}

/// Doubles, so that growing costs a constant per knot.
void Track::grow() {
  constexpr std::size_t kFirstRoom = 4;
  std::vector<Knot> larger(std::max(kFirstRoom, 2 * ring_.size()));
  for (std::size_t i = 0; i < count_; ++i) {
    larger[i] = std::move(ring_[(first_ + i) % ring_.size()]);
  }
  ring_ = std::move(larger);
  first_ = 0;
}

std::size_t Track::countUntil(std::int64_t utimeUs) const {
  std::size_t low = 0, high = count_;
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    knot(middle).utimeUs <= utimeUs ? low = middle + 1 : high = middle;
  }
  return low;
}

void Track::forgetBefore(std::int64_t utimeUs) {
  forgottenUs_ = std::max(forgottenUs_, utimeUs);
  const std::size_t until = countUntil(utimeUs);
  if (until < 2) return;
  first_ = (first_ + until - 1) % ring_.size();
  count_ -= until - 1;
}

TrackPiece Track::pieceAt(std::int64_t utimeUs) const {
  const std::size_t until = countUntil(utimeUs);
  FORETOUCH_ASSERT(until > 0);
  const Knot& before = knot(until - 1);
  if (until == count_) return {before.utimeUs, kNever, &before.pose, &before.pose, true};
  const Knot& after = knot(until);
  return {before.utimeUs, after.utimeUs, &before.pose, &after.pose, false};
}

std::int64_t Track::nextKnotUs(std::int64_t utimeUs) const {
  const std::size_t until = countUntil(utimeUs);
  return until == count_ ? kNever : knot(until).utimeUs;
}

void partOf(const TrackPiece& piece, const ChainMotion& motion, std::int64_t beginUs,
            std::int64_t endUs, Pose& from, Pose& to) {
  FORETOUCH_ASSERT(piece.beginUs <= beginUs && beginUs < endUs && endUs <= piece.endUs);
  if (piece.isHeld || isWhole(piece, beginUs, endUs)) {
    from = *piece.from;
    to = *piece.to;
    return;
  }
  ChainNodes::posesAt(motion, piece.at(beginUs), piece.at(endUs), from, to);
}

double partRounding(const TrackPiece& piece, const ChainMotion& motion, std::int64_t beginUs,
                    std::int64_t endUs, double rho) {
  if (piece.isHeld || isWhole(piece, beginUs, endUs)) return 0.0;
  double worst = 0.0;
  for (LinkId link = 0; link < motion.numLinks(); ++link) {
    const ChainSums& sums = motion.sums(link);
    const MotionBounds bounds = sums.bounds();
    worst = std::max(worst, kTurnOfPart * sums.depth * (sums.armReach + rho) +
                                kShiftOfPart * (bounds.reach + rho) +
                                kInstantOfPart * bounds.speedAt(rho));
  }
  return worst * internal::kInflation;
}

}  // namespace foretouch
