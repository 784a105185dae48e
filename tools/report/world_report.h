// tools/report/world_report.h: the bodies of a world, and what a replay of it found, as a view
// document.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "tools/report/document_parts.h"
#include "tools/report/report_progress.h"
#include "tools/report/view_document.h"
#include "tools/world/world_summary.h"
#include "tools/world/world_touches.h"

namespace foretouch::tools {

/// Collects the contacts of windows, in bounded memory.
class WorldReport {
 public:
  /// `world` outlives it.
  WorldReport(const LoadedWorld& world, ReportOptions options);

  /// Windows in order.
  void add(const WorldStep& step);

  /// How the bodies move, and what was found: `touches`, after finish(), and `summary` of the same
  /// windows; null: nobody was asked. The document refers to this.
  [[nodiscard]] ViewDocument document(const WorldSummary* summary, const WorldTouches* touches,
                                      const ReportProgress& progress) const;

 private:
  struct Kept {
    WorldContact contact;
    std::int64_t window = 0;
  };
  void addBodies(ViewDocument& document, Eigen::AlignedBox3d& action,
                 const ReportProgress& progress) const;
  void addFound(const WorldTouches& touches, ViewDocument& document) const;

  const LoadedWorld& world_;
  ReportOptions options_;
  std::vector<Avatar> shownAs_;  // per body: itself, or what stands for the link of a mesh
  std::vector<Kept> kept_;
  std::size_t numLeftOut_ = 0;
};

}  // namespace foretouch::tools
