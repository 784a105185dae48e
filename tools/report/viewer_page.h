// tools/report/viewer_page.h: the page that shows view documents, as the program carries it.
#pragma once

#include <string_view>

namespace foretouch::tools {

/// The whole page, without a document in it.
[[nodiscard]] std::string_view viewerPage();

/// The page around a document: a report is before + document + after.
struct PageParts {
  std::string_view before, after;
};
[[nodiscard]] PageParts viewerPageParts();

}  // namespace foretouch::tools
