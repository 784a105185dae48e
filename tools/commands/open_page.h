// tools/commands/open_page.h: offers to open a page in the browser of whoever sits there.
#pragma once

#include <string>

namespace foretouch::tools {

/// Asks on a terminal whether to open the page, and opens it by xdg-open. Nothing where stdin and
/// stdout are no terminal, there is no desktop or no xdg-open, or CI is set.
void offerToOpen(const std::string& path);

}  // namespace foretouch::tools
