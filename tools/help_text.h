// tools/help_text.h: help as a terminal shows it.
#pragma once

#include <cstddef>
#include <string>

#include "tools/help_page.h"

namespace foretouch::tools {

/// The columns for text on stdout: those of its terminal within 60 and 100; 80 without a terminal.
[[nodiscard]] std::size_t textColumns();

/// No line is longer than `columns`, unless one word is.
[[nodiscard]] std::string helpText(const HelpPage& page, std::size_t columns);

/// Words up to the next column, then the next line, which begins with `indent` blanks. `used`: the
/// columns of the first line that are taken already. Ends without a line break.
[[nodiscard]] std::string wrapped(const std::string& text, std::size_t columns, std::size_t indent,
                                  std::size_t used);

}  // namespace foretouch::tools
