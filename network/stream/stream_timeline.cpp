#include "network/stream/stream_timeline.h"

#include <algorithm>
#include <limits>

namespace foretouch::internal {
namespace {

/// `high` - `low`, which may be more than an int64 holds. Precondition: high >= low.
std::uint64_t distance(std::int64_t low, std::int64_t high) {
  return static_cast<std::uint64_t>(high) - static_cast<std::uint64_t>(low);
}

/// How many whole numbers lie between the two. Precondition: high > low.
std::int64_t numBetween(std::int64_t low, std::int64_t high) {
  constexpr auto kMost = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  return static_cast<std::int64_t>(std::min(distance(low, high) - 1, kMost));
}

bool mayStartOver(Reject reject) {
  return reject == Reject::StaleStamp || reject == Reject::FutureStamp ||
         reject == Reject::OldSession || reject == Reject::OutOfOrder;
}

}  // namespace

PosePlace StreamTimeline::place(const PoseStamp& stamp, Beginning beginning) {
  PosePlace place;
  place.reject = refusal(stamp, beginning);
  const bool isConfirmed = mayStartOver(place.reject) && completesRun(stamp);
  if (place.reject == Reject::OutOfOrder && stamp.utimeUs > last_.utimeUs) isContradicted_ = true;
  if (isConfirmed) place.reject = Reject::None;
  if (place.reject != Reject::None) return place;

  place.isSession = !hasLast_ || stamp.session != last_.session;
  if (isConfirmed || beginning != Beginning::None || place.isSession) {
    place.kind = StepKind::First;
    place.from = stamp;
  } else {
    place.lost = numBetween(last_.sequence, stamp.sequence);
    const bool mayMiss = place.lost > 0 || isContradicted_ || stamp.sequence >= kFirstUncounted;
    place.kind = mayMiss ? StepKind::AcrossGap : StepKind::Consecutive;
    place.from = last_;
  }
  accept(stamp);
  return place;
}

PosePlace StreamTimeline::placeOfPrevious(const PoseStamp& stamp) {
  PosePlace place;
  if (isAnswered(stamp)) {
    place.reject = Reject::Duplicate;
  } else if (!completesRun(stamp)) {
    place.reject = Reject::SkeletonMismatch;
  } else {
    place.isSession = true;
    place.from = stamp;
    accept(stamp);
  }
  return place;
}

Reject StreamTimeline::refusal(const PoseStamp& stamp, Beginning beginning) const {
  if (!hasLast_) return Reject::None;
  if (isAnswered(stamp)) return Reject::Duplicate;
  if (beginning == Beginning::Speaker) return Reject::None;
  if (stamp.session != last_.session) {
    return stamp.session < last_.session ? Reject::OldSession : Reject::None;
  }
  if (stamp.sequence <= last_.sequence) return Reject::OutOfOrder;
  if (stamp.utimeUs <= last_.utimeUs) return Reject::StaleStamp;
  // Where a timeline begins there is no step that could be too long.
  const bool isStep = beginning == Beginning::None;
  return isStep && isTooLate(last_, stamp) ? Reject::FutureStamp : Reject::None;
}

bool StreamTimeline::isAnswered(const PoseStamp& stamp) const {
  const auto kept = static_cast<std::ptrdiff_t>(std::min(numAnswered_, kAnsweredKept));
  return std::find(answered_.begin(), answered_.begin() + kept, stamp) != answered_.begin() + kept;
}

bool StreamTimeline::isTooLate(const PoseStamp& from, const PoseStamp& to) const {
  return distance(from.utimeUs, to.utimeUs) > static_cast<std::uint64_t>(policy_.maxStepUs);
}

/// Counts the refused pose into the run; a copy of the run's last one does not count.
bool StreamTimeline::completesRun(const PoseStamp& stamp) {
  if (run_ > 0 && stamp == runLast_) return false;
  const bool continues = run_ > 0 && stamp.session == runLast_.session &&
                         stamp.sequence > runLast_.sequence && stamp.utimeUs > runLast_.utimeUs &&
                         !isTooLate(runLast_, stamp);
  run_ = continues ? run_ + 1 : 1;
  runLast_ = stamp;
  return run_ >= policy_.confirmations;
}

void StreamTimeline::accept(const PoseStamp& stamp) {
  last_ = stamp;
  hasLast_ = true;
  isContradicted_ = false;
  run_ = 0;
  answered_[numAnswered_ % kAnsweredKept] = stamp;
  ++numAnswered_;
}

}  // namespace foretouch::internal
