// tools/commands/open_page.h: offers to open a page in the user's browser.
#pragma once

#include <string>

namespace foretouch::tools {

/// Asks on a terminal whether to open the page, and opens it by xdg-open. Does nothing where stdin
/// or stdout is not a terminal, there is no desktop or no xdg-open, or CI is set.
void offerToOpen(const std::string& path);

}  // namespace foretouch::tools
