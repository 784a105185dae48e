// network/service/solid_counts.h: what a service's solid avatars have shown since it started, as
// plain values, and the one place where its threads count it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

#include "network/service/latency_histogram.h"
#include "network/wire/messages.h"

namespace foretouch {

struct SolidCount {
  std::int32_t avatar = 0;                             ///< Its number in messages.
  std::array<std::uint64_t, kNumSolidStates> poses{};  ///< Shown, by state.
  std::uint64_t uncertified = 0;                       ///< Of these.
  std::uint64_t queries = 0, work = 0;                 ///< As SolidCounters.
  SolidState state = SolidState::Placing;              ///< At the last pose.
  double deviation = 0.0;                              ///< The same.
};

struct SolidCounts {
  std::vector<SolidCount> avatars;  ///< Those that have shown a pose, in the service's order.
  LatencyHistogram times;           ///< Of a shown pose, the solid avatar's part of the work.
};

class SolidCounter {
 public:
  /// `avatar`: an index.
  void shown(std::size_t avatar, const SolidMessage& message);
  [[nodiscard]] SolidCounts counts() const;

 private:
  mutable std::mutex mutex_;
  std::vector<SolidCount> avatars_;  // by index
  std::vector<bool> hasShown_;
  LatencyHistogram times_;
};

}  // namespace foretouch
