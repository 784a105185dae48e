// network/stream/stream_timeline.h: the order of one avatar's poses: which continue a timeline,
// which begin one, which it refuses. Only integers; no value overflows. The table of rules is
// docs/streaming.md, "What is accepted". Not installed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "network/stream/stream_policy.h"
#include "network/wire/messages.h"

namespace foretouch::internal {

/// A pose's order and identity among those of its avatar.
struct PoseStamp {
  std::int64_t session = 0, sequence = 0, utimeUs = 0;

  friend bool operator==(const PoseStamp& x, const PoseStamp& y) {
    return x.session == y.session && x.sequence == y.sequence && x.utimeUs == y.utimeUs;
  }
};

/// The decision about a pose.
struct PosePlace {
  Reject reject = Reject::None;
  StepKind kind = StepKind::First;
  std::int64_t lost = 0;   ///< At most the largest int64.
  PoseStamp from;          ///< The pose before; itself for First.
  bool isSession = false;  ///< The first pose, or the first of another session.
};

/// Why a pose, if accepted, begins a timeline whatever its stamp.
enum class Beginning : std::uint8_t {
  None,      ///< It does not.
  Skeleton,  ///< The first of another skeleton, at any capture time after the last one.
  Speaker,   ///< The first of another speaker, whose numbers and clock are another's.
};

class StreamTimeline {
 public:
  explicit StreamTimeline(const StreamPolicy& policy) : policy_(policy) {}

  /// Decides; an accepted pose becomes the last one.
  [[nodiscard]] PosePlace place(const PoseStamp& stamp, Beginning beginning = Beginning::None);
  /// Decides about a pose of the skeleton that was in use before: SkeletonMismatch, unless it
  /// completes a run of refused poses; then it begins a timeline.
  [[nodiscard]] PosePlace placeOfPrevious(const PoseStamp& stamp);

  /// Remembers this many of the poses answered last, so that none is answered again.
  static constexpr std::size_t kAnsweredKept = 256;

 private:
  [[nodiscard]] Reject refusal(const PoseStamp& stamp, Beginning beginning) const;
  [[nodiscard]] bool isAnswered(const PoseStamp& stamp) const;
  [[nodiscard]] bool isTooLate(const PoseStamp& from, const PoseStamp& to) const;
  [[nodiscard]] bool completesRun(const PoseStamp& stamp);
  void accept(const PoseStamp& stamp);

  StreamPolicy policy_;
  PoseStamp last_;
  bool hasLast_ = false;
  /// A lower sequence came with a later capture time: the sender was restarted, or does not count
  /// poses.
  bool isContradicted_ = false;
  int run_ = 0;  // refused poses that continue one another, up to runLast_
  PoseStamp runLast_;
  std::array<PoseStamp, kAnsweredKept> answered_;
  std::size_t numAnswered_ = 0;  // ever; the next one's place, modulo kAnsweredKept
};

}  // namespace foretouch::internal
