// tools/replay/replay_touches.h: the answers of a replay's steps as touches.
#pragma once

#include <string>
#include <vector>

#include "tools/inputs/replay_inputs.h"
#include "tools/replay/results_writer.h"
#include "tools/touches/touch_tracker.h"

namespace foretouch::tools {

/// Collects the touches of a replay. Keeps each: about 150 bytes.
class ReplayTouches {
 public:
  /// `inputs` must outlive it.
  explicit ReplayTouches(const ReplayInputs& inputs);

  /// Steps in order. Returns the contacts that begin touches; valid until the next call.
  const std::vector<TouchRow>& add(const StepAnswer& answer);
  /// After the last step.
  void finish();

  /// After finish(), in the order of isListedBefore(); without those of the ground if they are
  /// ignored.
  [[nodiscard]] const std::vector<Touch>& listed() const { return listed_; }
  [[nodiscard]] const TouchCounts& counts() const { return counts_; }
  /// The last lines of the results: one a touch, and the counts.
  [[nodiscard]] std::string lines() const;

 private:
  void addRow(const LinkContact& contact, const StepAnswer& answer, bool isGround);
  void addRow(const PairContact& contact, const StepAnswer& answer);
  void list();

  const ReplayInputs& inputs_;
  TouchTracker tracker_;
  TouchCounts counts_;
  std::int64_t steps_ = 0;
  std::vector<Touch> listed_;
  // Of the step that is being added.
  TouchStep step_;
  std::vector<Touch> ended_;
  std::vector<std::size_t> begun_;
  std::vector<TouchRow> begunRows_;
};

}  // namespace foretouch::tools
