// network/service/person_counts.h: what a service has said of persons since it started, as plain
// values, and the one place where its threads count it. Not installed.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <mutex>
#include <vector>

#include "network/service/latency_histogram.h"
#include "network/wire/messages.h"

namespace foretouch {

inline constexpr std::size_t kNumBracketVerdicts = 4;

struct PersonCount {
  std::int32_t avatar = 0;  ///< Its number in messages.
  /// Links, times steps, by verdict.
  std::array<std::uint64_t, kNumBracketVerdicts> links{};
  std::uint64_t broken = 0;  ///< Claims that poses showed to be wrong, link by link.
};

struct PersonCounts {
  std::vector<PersonCount> avatars;  ///< Those of whose persons something was said, by number.
  LatencyHistogram times;            ///< The person's part of the work, per message.
};

class PersonCounter {
 public:
  void said(const PersonMessage& message);
  [[nodiscard]] PersonCounts counts() const;

 private:
  mutable std::mutex mutex_;
  std::map<std::int32_t, PersonCount> avatars_;
  LatencyHistogram times_;
};

}  // namespace foretouch
