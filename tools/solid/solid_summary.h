// tools/solid/solid_summary.h: what a person reads first about shown poses.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "tools/inputs/replay_inputs.h"
#include "tools/solid/solid_player.h"

namespace foretouch::tools {

/// What many distances come to (m).
struct Deviations {
  double mean = 0.0, p90 = 0.0, most = 0.0;
};

/// Collects ticks. Keeps one float per link and tick.
class SolidSummary {
 public:
  /// `inputs` must outlive it.
  explicit SolidSummary(const ReplayInputs& inputs);

  void add(const PlayedTick& tick);

  [[nodiscard]] std::string text() const;
  /// The fields of the file's last line, JSON, without braces.
  [[nodiscard]] std::string fields() const;
  /// One line for programs: inputs, the same fields, latencies, and the files written.
  [[nodiscard]] std::string jsonLine(const std::string& output, const std::string& report) const;

  [[nodiscard]] const ReplayInputs& inputs() const { return inputs_; }
  [[nodiscard]] std::int64_t ticks() const { return ticks_; }
  [[nodiscard]] std::int64_t of(SolidState state) const {
    return ofState_[static_cast<std::size_t>(state)];
  }
  /// For all links with LSS at all ticks with a place; then for the hands' links only.
  [[nodiscard]] Deviations ofAll() const { return deviations(all_); }
  [[nodiscard]] Deviations ofHands() const { return deviations(hands_); }
  [[nodiscard]] bool hasHands() const { return !handLinks_.empty(); }
  /// Seconds in which surfaces kept it from the tracked pose: sliding, held, around.
  [[nodiscard]] double keptS() const;
  [[nodiscard]] double queriesPerTick() const;
  [[nodiscard]] std::int64_t certified() const { return certified_; }
  /// Proven lower bound on the separation on all certified ways (m); 0 without any.
  [[nodiscard]] double leastClearance() const;
  [[nodiscard]] double latencyUs(double share) const;

 private:
  [[nodiscard]] static Deviations deviations(const std::vector<float>& all);
  [[nodiscard]] std::string states() const;

  const ReplayInputs& inputs_;
  std::vector<LinkId> links_, handLinks_;
  std::int64_t ticks_ = 0, certified_ = 0, motions_ = 0;
  std::array<std::int64_t, kNumSolidStates> ofState_{};
  std::array<std::int64_t, kNumSolidLimits> ofLimit_{};
  std::vector<float> all_, hands_, latenciesUs_;
  std::uint64_t queries_ = 0;
  double clearance_ = -1.0, placingShift_ = 0.0, lift_ = 0.0, push_ = 0.0;
  bool isPlaced_ = false;
};

}  // namespace foretouch::tools
