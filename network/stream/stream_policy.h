// network/stream/stream_policy.h: how strict a stream of poses is.
#pragma once

#include <cstdint>

namespace foretouch {

inline constexpr std::int64_t kMostStepUs = 86'400'000'000;  ///< A day.
inline constexpr int kMostConfirmations = 1000;

struct StreamPolicy {
  /// Refuses a pose captured longer than this after the last one. 1 to kMostStepUs.
  std::int64_t maxStepUs = 10'000'000;
  /// Poses (or skeletons) in a row that begin an unexpected timeline. 1 to kMostConfirmations; at 1
  /// every odd stamp begins one.
  int confirmations = 3;
  /// True: joints that the sender's skeleton lacks keep their rest values and count as known.
  /// False: the links below them are undecided.
  bool unmatchedAtRest = false;
};

}  // namespace foretouch
