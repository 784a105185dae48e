// network/stream/stream_policy.h: how strictly a stream of poses is taken.
#pragma once

#include <cstdint>

namespace foretouch {

inline constexpr std::int64_t kMostStepUs = 86'400'000'000;  ///< A day.
inline constexpr int kMostConfirmations = 1000;

struct StreamPolicy {
  /// A pose captured longer than this after the last one is refused. 1 to kMostStepUs.
  std::int64_t maxStepUs = 10'000'000;
  /// Poses (or skeletons) in a row that make a timeline that was not expected. 1 to
  /// kMostConfirmations; at 1 every odd stamp begins one.
  int confirmations = 3;
  /// Joints of the avatar that the sender's skeleton does not have keep their rest values and count
  /// as known; otherwise the links below them are undecided.
  bool unmatchedAtRest = false;
};

}  // namespace foretouch
