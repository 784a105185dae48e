// tools/report/replay_report.h: the replay of a clip as a view document.
#pragma once

#include <cstdint>
#include <vector>

#include "articulated/result.h"
#include "tools/inputs/replay_inputs.h"
#include "tools/replay/replay_touches.h"
#include "tools/replay/step_solver.h"
#include "tools/replay/summary.h"
#include "tools/report/document_parts.h"
#include "tools/report/swept_views.h"
#include "tools/report/track_builder.h"
#include "tools/report/view_document.h"

namespace foretouch::tools {

/// Collects steps, in bounded memory, and makes the document after the last one, so that the report
/// adds to no step's latency.
class ReplayReport {
 public:
  /// `inputs` must outlive it and the document.
  ReplayReport(const ReplayInputs& inputs, const ReportOptions& options);

  /// Call in order. Once there is no room, only counts steps.
  void add(const ReplayedStep& step);

  /// Call once, with the touches of all steps. `progress` may end it early: the document is then
  /// unusable.
  [[nodiscard]] Result<ViewDocument> document(const ReplaySummary& summary,
                                              const std::vector<Touch>& touches,
                                              const ReportProgress& progress);

 private:
  [[nodiscard]] std::vector<ViewRow> settings() const;
  [[nodiscard]] static std::vector<ViewRow> rowsOf(const ReplaySummary& summary);
  /// The contacts of every link with every object, if they are asked one by one.
  [[nodiscard]] const std::vector<LinkContact>& shownOf(const StepAnswer& answer) const;
  [[nodiscard]] std::vector<Touch> keptOf(const std::vector<Touch>& touches) const;
  [[nodiscard]] Result<Done> addTrack(const ReportProgress& progress);

  const ReplayInputs& inputs_;
  ReportOptions options_;
  TrackBuilder track_;
  std::int64_t mostSteps_;
  bool isFull_ = false;
  std::vector<double> latenciesUs_;  // one per kept step
  std::vector<ReportedContact> contacts_;
};

}  // namespace foretouch::tools
