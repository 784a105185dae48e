// tools/report/swept_views.h: the sweeps of links in contact, as certified surfaces, as far as a
// document has room for them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "tools/report/report_progress.h"
#include "tools/report/view_document.h"

namespace foretouch::tools {

struct SweptRequest {
  std::size_t maxTriangles = 200'000;      ///< All surfaces together.
  std::size_t maxTrianglesOfOne = 20'000;  ///< Omits a surface that needs more.
  double errorShare = 1.0 / 8.0;           ///< Share of an LSS's radius ...
  double leastErrorM = 2e-3;               ///< ... but no finer than this.
};

/// Adds the surface of each link in contact over its whole step: first for the contacts that the
/// poses do not show, then for the others, then for links that start in contact, each in order of
/// time. Precondition: avatars with contacts have tracks. Notes omissions in `notes`.
void addSwept(const SweptRequest& request, ViewDocument& document, const ReportProgress& progress);

}  // namespace foretouch::tools
