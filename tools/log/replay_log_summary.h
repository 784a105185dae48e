// tools/log/replay_log_summary.h: the summary at the end of the replay of a log, for people.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "network/wire/messages.h"
#include "tools/log/replay_log.h"
#include "tools/touches/touch.h"

namespace foretouch::tools {

/// Collects answers and summarises them. Keeps one float per answer and a few numbers per link.
class LogReplaySummary {
 public:
  /// `inputs` must outlive it.
  explicit LogReplaySummary(const LogReplayInputs& inputs);

  /// `avatar` is its index in the request.
  void add(const ContactsMessage& answer, std::size_t avatar);
  /// The touches of all answers, after the last one.
  void add(const TouchCounts& touches) { touches_ = touches; }

  [[nodiscard]] std::string text(const LogReplayReport& report) const;

  /// "N of N verdicts equal the journal's, byte for byte", and the first difference; empty if the
  /// log has no verdicts.
  [[nodiscard]] static std::string comparison(const LogReplayReport& report);
  /// "N of N ... equal the journal's, byte for byte"; empty if the log has none. `answers`: the
  /// replay's.
  [[nodiscard]] static std::string compared(const JournalCheck& journal, const char* what,
                                            std::int64_t answers);

  struct Counts {
    std::int64_t contacts = 0, startsInContact = 0, undecided = 0;
  };
  [[nodiscard]] const Counts& total() const { return total_; }
  [[nodiscard]] const TouchCounts& touches() const { return touches_; }
  /// The time within which this share of the queries was answered.
  [[nodiscard]] double queryUs(double share) const;

 private:
  [[nodiscard]] std::string head() const;
  [[nodiscard]] std::string stream(const LogReplayReport& report) const;
  [[nodiscard]] std::string verdicts() const;
  [[nodiscard]] std::string byLink() const;
  [[nodiscard]] std::string cost() const;

  const LogReplayInputs& inputs_;
  Counts total_;
  TouchCounts touches_;
  std::vector<std::vector<Counts>> ofLink_;  // by avatar and link
  std::array<std::int64_t, kNumUndecidedReasons> reasons_{};
  std::int64_t withContact_ = 0;
  std::vector<float> queriesUs_;
};

}  // namespace foretouch::tools
