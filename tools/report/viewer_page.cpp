#include "tools/report/viewer_page.h"

#include "lss/assert.h"
#include "tools/report/viewer_html.h"

namespace foretouch::tools {
namespace {

constexpr std::string_view kOpening = R"(<script type="application/json" id="foretouch-view">)";
constexpr std::string_view kClosing = "</script>";

}  // namespace

std::string_view viewerPage() {
  return {reinterpret_cast<const char*>(kViewerHtml), kViewerHtmlBytes};
}

PageParts viewerPageParts() {
  const std::string_view page = viewerPage();
  const std::size_t opening = page.find(kOpening);
  FORETOUCH_ASSERT(opening != std::string_view::npos);  // a test checks the page
  const std::size_t begin = opening + kOpening.size();
  return {page.substr(0, begin), page.substr(page.find(kClosing, begin))};
}

}  // namespace foretouch::tools
