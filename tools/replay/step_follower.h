// tools/replay/step_follower.h: a replay's steps as a world with one body, followed from enter to
// leave (middleware/events/world_follower.h).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "articulated/result.h"
#include "middleware/events/world_follower.h"
#include "middleware/world/world.h"
#include "tools/inputs/replay_inputs.h"

namespace foretouch::tools {

/// An instant of a replay: at `share` in [0,1] of the step.
struct StepInstant {
  std::int64_t step = 0;
  double share = 0.0;

  [[nodiscard]] double steps() const { return static_cast<double>(step) + share; }
};

class StepFollower {
 public:
  /// Whether a world asks what the replay asks: with one tolerance and fidelity, link or exact, for
  /// all links, about whatever they touch, as long as it takes.
  [[nodiscard]] static bool canFollow(const ReplayInputs& inputs);
  /// `inputs` must outlive it.
  [[nodiscard]] static Result<StepFollower> start(const ReplayInputs& inputs);

  /// Steps in order. Follows several in one go; true if it has followed to the end of this one.
  [[nodiscard]] Result<bool> add(std::int64_t step);
  /// Call after the last step.
  [[nodiscard]] Result<Done> finish();

  /// The events of the steps that were followed last, by time. Without what is ignored.
  [[nodiscard]] const std::vector<WorldEvent>& events() const { return events_; }
  /// The motion of one of these steps.
  [[nodiscard]] ChainMotion motionOf(std::int64_t step) const;
  /// An instant between two of these steps is the later one's begin.
  [[nodiscard]] StepInstant instantOf(const WorldTime& time) const;
  /// The end of the last one.
  [[nodiscard]] StepInstant end() const { return {lastStep(), 1.0}; }

 private:
  StepFollower(const ReplayInputs& inputs, World world, WorldFollower follower);
  [[nodiscard]] Result<Done> push(std::int64_t pose);
  [[nodiscard]] std::int64_t lastStep() const;
  [[nodiscard]] bool isIgnored(const WorldEvent& event) const;

  const ReplayInputs& inputs_;
  World world_;
  WorldFollower follower_;
  std::vector<Pose> poses_;     // from that of `firstPose_` on
  std::int64_t firstPose_ = 0;  // the begin of the step that is followed next
  WorldEvents followed_;
  std::vector<WorldEvent> events_;
};

}  // namespace foretouch::tools
