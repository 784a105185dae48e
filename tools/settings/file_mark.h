// tools/settings/file_mark.h: tells whether a file is still the one that it was.
#pragma once

#include <string>
#include <string_view>

#include "articulated/result.h"

namespace foretouch::tools {

/// Sixteen hexadecimal digits of a file's content (XXH64): for files that somebody replaced by
/// mistake, not for those that an attacker did. Errors: what is no file, or cannot be read.
[[nodiscard]] Result<std::string> markOfFile(const std::string& path);
/// The same of a text, and of the mark of what comes before it, if any.
[[nodiscard]] std::string markOfText(std::string_view text, std::string_view before = {});

}  // namespace foretouch::tools
