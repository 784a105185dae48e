// tools/settings/near_names.h: which existing names a misspelt one may have meant.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace foretouch::tools {

/// "; did you mean 'LeftHand', 'LeftFoot'?", with at most three names, nearest first, within an
/// edit distance of one and a quarter of the word's length, letter case apart; empty where none is
/// that near. Names longer than 64 bytes are not compared, so a hostile list costs little.
[[nodiscard]] std::string didYouMean(std::string_view word, const std::vector<std::string>& names);

}  // namespace foretouch::tools
