// tools/report/viewer_page.h: the page that shows view documents, from inside the program.
#pragma once

#include <string_view>

namespace foretouch::tools {

/// The whole page, without a document.
[[nodiscard]] std::string_view viewerPage();

/// The page around a document: a report is before + document + after.
struct PageParts {
  std::string_view before, after;
};
[[nodiscard]] PageParts viewerPageParts();

}  // namespace foretouch::tools
