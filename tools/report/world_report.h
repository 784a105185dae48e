// tools/report/world_report.h: the bodies of a world, and what a replay of it found, as a view
// document.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "articulated/result.h"
#include "tools/report/document_parts.h"
#include "tools/report/report_progress.h"
#include "tools/report/view_document.h"
#include "tools/world/world_summary.h"
#include "tools/world/world_touches.h"

namespace foretouch::tools {

/// Collects the contacts of windows, in bounded memory.
class WorldReport {
 public:
  /// `world` and `followed` outlive it. `followed`: as WorldTouches has it. Errors, which name the
  /// file and the body: a mesh that is too large for an LSS to hold it.
  [[nodiscard]] static Result<WorldReport> make(const LoadedWorld& world, ReportOptions options,
                                                const WorldIntervals* followed);

  /// Windows in order.
  void add(const WorldStep& step);

  /// How the bodies move, and what was found: `touches`, after finish(), and `summary` for the same
  /// windows; null if nothing was asked. The document refers to this.
  [[nodiscard]] ViewDocument document(const WorldSummary* summary, const WorldTouches* touches,
                                      const ReportProgress& progress) const;

 private:
  WorldReport(const LoadedWorld& world, ReportOptions options, const WorldIntervals* followed,
              std::vector<Avatar> shownAs)
      : world_(world),
        options_(std::move(options)),
        followed_(followed),
        shownAs_(std::move(shownAs)) {}
  void addBodies(ViewDocument& document, Eigen::AlignedBox3d& action,
                 const ReportProgress& progress) const;
  /// Returns how many contacts there is no room for.
  std::size_t addFound(const WorldTouches& touches, ViewDocument& document) const;
  void addUnresolved(ViewDocument& document) const;
  void addStays(ViewDocument& document) const;

  const LoadedWorld& world_;
  ReportOptions options_;
  const WorldIntervals* followed_;
  std::vector<Avatar> shownAs_;     // per body: itself, or what stands for the link of a mesh
  std::vector<WorldContact> kept_;  // where the world is followed, without what begins touches
  std::size_t numLeftOut_ = 0;
};

}  // namespace foretouch::tools
