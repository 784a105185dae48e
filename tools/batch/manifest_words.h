// tools/batch/manifest_words.h: a line's words, and the files that a pattern stands for.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "articulated/result.h"

namespace foretouch::tools {

/// Words as a shell separates them: at blanks, but for those in 'quotes' or in "quotes", in which a
/// backslash keeps the character behind it. A word that begins with # ends the line. Errors do not
/// name the place.
[[nodiscard]] Result<std::vector<std::string>> wordsOfLine(std::string_view line);

/// True if the word has one of * ? [.
[[nodiscard]] bool isPattern(std::string_view word);

/// The files in `folder` that a pattern stands for, in the order of their bytes, as the pattern
/// spells them; empty if there are none. Errors: more than `most`.
[[nodiscard]] Result<std::vector<std::string>> filesLike(const std::string& pattern,
                                                         const std::string& folder,
                                                         std::size_t most);

}  // namespace foretouch::tools
