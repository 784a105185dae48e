// tools/man_page.h: help as a manual page.
#pragma once

#include <string>
#include <vector>

#include "tools/help_page.h"

namespace foretouch::tools {

/// "foretouch-avatar-check": the page's name, without its section.
[[nodiscard]] std::string manName(const std::string& command);

/// Roff, for man(7). `version`: "foretouch 0.1.0". `others`: the commands that the page refers to.
[[nodiscard]] std::string manPage(const HelpPage& page, const std::string& version,
                                  const std::vector<std::string>& others);

}  // namespace foretouch::tools
