// tools/settings/file_mark.h: checks whether a file is still the one that it was.
#pragma once

#include <string>
#include <string_view>

#include "articulated/result.h"

namespace foretouch::tools {

/// Sixteen hexadecimal digits of a file's content (XXH64): for files that were replaced by
/// mistake, not for those that an attacker replaced. Errors: not a file, or cannot be read.
[[nodiscard]] Result<std::string> markOfFile(const std::string& path);
/// The same for a text, and for the mark of what comes before it, if any.
[[nodiscard]] std::string markOfText(std::string_view text, std::string_view before = {});

}  // namespace foretouch::tools
