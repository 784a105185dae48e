// tools/report/viewer_html.h: viewer/dist/viewer.html, made part of the program when it is built.
#pragma once

#include <cstddef>

namespace foretouch::tools {

extern const unsigned char kViewerHtml[];
extern const std::size_t kViewerHtmlBytes;

}  // namespace foretouch::tools
