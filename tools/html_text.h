// tools/html_text.h: text as a page shows it.
#pragma once

#include <string>
#include <string_view>

namespace foretouch::tools {

/// Text escaped for HTML: between tags, and in quoted attributes.
[[nodiscard]] std::string inHtml(std::string_view text);

}  // namespace foretouch::tools
