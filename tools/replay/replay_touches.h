// tools/replay/replay_touches.h: the answers of a replay's steps as touches: followed from enter to
// leave where a world can ask what the replay asks, else made of the answers alone.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "articulated/result.h"
#include "tools/inputs/replay_inputs.h"
#include "tools/replay/followed_touches.h"
#include "tools/replay/results_writer.h"
#include "tools/reported_contact.h"
#include "tools/touches/touch_tracker.h"

namespace foretouch::tools {

/// Collects the touches of a replay. Keeps each: about 150 bytes.
class ReplayTouches {
 public:
  /// `inputs` must outlive it. Errors: those of World::add() for its body.
  [[nodiscard]] static Result<ReplayTouches> start(const ReplayInputs& inputs);

  /// Steps in order. Errors: those of WorldFollower::follow().
  [[nodiscard]] Result<Done> add(const StepAnswer& answer);
  /// Call after the last step.
  [[nodiscard]] Result<Done> finish();

  /// The contacts that begin touches and that the last call has found: of this step, or of some
  /// before it.
  [[nodiscard]] const std::vector<ReportedContact>& begun() const { return begun_; }
  /// True if begin and end of each touch are proven, and no object hides another.
  [[nodiscard]] bool areFollowed() const { return followed_.has_value(); }
  /// The touches after finish(), in the order of isListedBefore(); without those of the ground if
  /// they are ignored.
  [[nodiscard]] const std::vector<Touch>& listed() const { return listed_; }
  [[nodiscard]] const TouchCounts& counts() const { return counts_; }
  /// The last lines of the results: one per touch, and the counts.
  [[nodiscard]] std::string lines() const;

 private:
  explicit ReplayTouches(const ReplayInputs& inputs);
  void track(const StepAnswer& answer);
  void addRow(const LinkContact& contact, const StepAnswer& answer, bool isGround);
  void addRow(const PairContact& contact, const StepAnswer& answer);
  void list();

  const ReplayInputs& inputs_;
  std::optional<FollowedTouches> followed_;
  TouchTracker tracker_;  // where they are not followed
  TouchCounts counts_;
  std::int64_t steps_ = 0;
  std::vector<Touch> listed_;
  std::vector<ReportedContact> begun_;
  // For the step that is being added.
  TouchStep step_;
  std::vector<Touch> ended_;
  std::vector<std::size_t> begunRows_;
};

}  // namespace foretouch::tools
