// tools/batch/batch_report.h: the same table for people: a page with the worst clips first.
#pragma once

#include <string>

#include "tools/batch/batch_table.h"

namespace foretouch::tools {

struct BatchReportPlaces {
  std::string manifest;  ///< Its name, for the title.
  std::string results;   ///< The folder of results as the page sees it, for links; "." for its own.
};

/// A page that needs no script, no network and no other file; it links to the results, and to the
/// reports of single jobs where they have been made. First what failed, then by touches, by the
/// share of steps with contact, and by number; feet by the greatest slide or depth. Pure.
[[nodiscard]] std::string batchReport(const BatchTable& table, const BatchReportPlaces& places,
                                      BatchKind kind = BatchKind::Replays);

}  // namespace foretouch::tools
