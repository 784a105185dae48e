// network/service/solid_counts.h: what a service's solid avatars have shown since it started, as
// plain values, and the one place where its threads count it. Not installed.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <mutex>
#include <vector>

#include "network/service/latency_histogram.h"
#include "network/wire/messages.h"
#include "network/wire/world_messages.h"

namespace foretouch {

struct SolidCount {
  std::int32_t avatar = 0;                             ///< Its number in messages.
  std::array<std::uint64_t, kNumSolidStates> poses{};  ///< Shown, by state.
  std::uint64_t uncertified = 0;                       ///< Those of these poses.
  std::uint64_t queries = 0, work = 0;                 ///< As SolidCounters.
  SolidState state = SolidState::Placing;              ///< At the last pose.
  double deviation = 0.0;                              ///< The same.
  /// In a moving world: ticks at which something that moves pressed against it, or crushed it.
  std::uint64_t pushed = 0, crushed = 0;
};

struct SolidCounts {
  std::vector<SolidCount> avatars;  ///< Those that have shown a pose, by number.
  LatencyHistogram times;           ///< The solid avatar's part of the work, per shown pose.
};

class SolidCounter {
 public:
  /// `pushes`: in a moving world; else null.
  void shown(const SolidMessage& message, const PushesMessage* pushes = nullptr);
  [[nodiscard]] SolidCounts counts() const;

 private:
  mutable std::mutex mutex_;
  std::map<std::int32_t, SolidCount> avatars_;
  LatencyHistogram times_;
};

}  // namespace foretouch
