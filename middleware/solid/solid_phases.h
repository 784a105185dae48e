// middleware/solid/solid_phases.h: on what a solid avatar's tick spends its time, for benchmarks.
// A tick that is not timed pays a comparison per phase. Not installed.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

namespace foretouch::internal {

enum class SolidPhase : std::uint8_t {
  Other,   ///< Places of links, lift, pace, what the tick reports.
  Gather,  ///< What is near in the scene, in own links and at joints' ends.
  Solve,   ///< The step: inertia, rows, pushes.
  Try,     ///< Shares of the step: what they cost, and which gaps they keep.
  Prove,   ///< Motions that are asked.
  Around,  ///< Ways around, whatever they spend it on.
};
inline constexpr std::size_t kNumSolidPhases = 6;

/// A clock that runs for one phase at a time.
class SolidPhases {
 public:
  using Clock = std::chrono::steady_clock;

  void begin() {
    times_.fill({});
    phase_ = SolidPhase::Other;
    since_ = Clock::now();
  }
  /// Returns the phase that ends. Ways around are one phase, whatever they are made of.
  SolidPhase enter(SolidPhase phase) {
    const Clock::time_point now = Clock::now();
    times_[static_cast<std::size_t>(phase_)] += now - since_;
    since_ = now;
    const SolidPhase before = phase_;
    phase_ = phase;
    return before;
  }
  [[nodiscard]] SolidPhase phase() const { return phase_; }
  /// The time since begin(), of phases that have ended.
  [[nodiscard]] double microseconds(SolidPhase phase) const {
    const auto time = times_[static_cast<std::size_t>(phase)];
    return std::chrono::duration<double, std::micro>(time).count();
  }

 private:
  std::array<Clock::duration, kNumSolidPhases> times_{};
  SolidPhase phase_ = SolidPhase::Other;
  Clock::time_point since_;
};

/// One phase, until the end of a block. `phases` may be null.
class PhaseScope {
 public:
  PhaseScope(SolidPhases* phases, SolidPhase phase)
      : phases_(phases != nullptr && phases->phase() != SolidPhase::Around ? phases : nullptr) {
    if (phases_ != nullptr) before_ = phases_->enter(phase);
  }
  ~PhaseScope() {
    if (phases_ != nullptr) phases_->enter(before_);
  }
  PhaseScope(const PhaseScope&) = delete;
  PhaseScope& operator=(const PhaseScope&) = delete;

 private:
  SolidPhases* phases_;
  SolidPhase before_ = SolidPhase::Other;
};

}  // namespace foretouch::internal
