// tools/replay/results_writer.h: the lines of a results file (docs/formats.md, "Results"). Pure:
// the same answers give the same text, on any machine.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "articulated/avatar.h"
#include "middleware/query/query.h"
#include "middleware/scene/scene.h"
#include "tools/inputs/replay_inputs.h"

namespace foretouch::tools {

/// What one step is answered with. `contacts` are the links that are not clear, earliest first, and
/// of those at the same time the lowest link first.
struct StepAnswer {
  std::int64_t step = 0;
  double t0S = 0.0, t1S = 0.0;  ///< Seconds from the clip's first frame.
  std::vector<LinkContact> contacts;
  std::vector<LinkId> missedByPoses;  ///< Links in contact that touch nothing at either pose.
  QueryCounters counters;
  double latencyUs = 0.0;
};

/// The links that are not clear, in the order of StepAnswer::contacts.
[[nodiscard]] std::vector<LinkContact> notClear(const std::vector<LinkContact>& links);

/// The first line. Names neither threads nor culler: they do not change what follows.
[[nodiscard]] std::string headerLine(const ReplayInputs& inputs);

/// Formats steps. Const calls from several threads are fine.
class StepFormat {
 public:
  StepFormat(const Avatar& avatar, const Scene& scene);

  /// One line, its line break included.
  [[nodiscard]] std::string line(const StepAnswer& answer) const;

 private:
  void append(const LinkContact& contact, const StepAnswer& answer, std::string& text) const;

  Scene scene_;
  std::vector<std::string> links_, objects_;  // as JSON strings
};

}  // namespace foretouch::tools
