// tools/report/viewer_html.h: viewer/dist/viewer.html, built into the program.
#pragma once

#include <cstddef>

namespace foretouch::tools {

extern const unsigned char kViewerHtml[];
extern const std::size_t kViewerHtmlBytes;

}  // namespace foretouch::tools
